// How sensors look out: over the hemisphere round a normal, a part of the directions by the cosine and the rest evenly.
// With a cosine alone no direction near the horizon would be found for measurements that do not fade there.
#pragma once

#include "sampling/warp.h"

namespace bdpt {

class HemisphereSampler {
 public:
  explicit HemisphereSampler(float cosine_part) : q_(cosine_part) {}
  // A unit direction in the frame of the normal.
  Vec3 sample(float u0, float u1) const {
    if (u0 < q_) return sample_cosine_hemisphere(u0 / q_, u1);
    const float z = std::min((u0 - q_) / (1 - q_), 0x1.fffffep-1f), r = safe_sqrt(1 - z * z), phi = kTwoPi * u1;
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  // Per projected solid angle.
  float density(float cosine) const { return q_ * kInvPi + (q_ < 1 ? (1 - q_) / (kTwoPi * cosine) : 0.0f); }

 private:
  float q_;
};

}  // namespace bdpt
