// Rough diffuse reflection that keeps energy and is reciprocal: EON of Portsmouth, Kutz and Hill (2024), which is
// Fujii's Oren-Nayar with what it loses given back. Both directions on the side z > 0.
#pragma once

#include "sampling/warp.h"

namespace bdpt {

class OrenNayar {
 public:
  explicit OrenNayar(float roughness) : r_(roughness), a_(1 / (1 + (0.5f - 2 / (3 * kPi)) * roughness)) {}

  Rgb f(const Rgb& reflectance, const Vec3& p, const Vec3& n) const {
    if (r_ == 0) return reflectance * kInvPi;
    const float s = p.x * n.x + p.y * n.y;
    const float single = a_ * std::max(1 + r_ * (s > 0 ? s / std::max(p.z, n.z) : s), 0.0f);
    const float mean = a_ * (1 + (2.0f / 3 - 28 / (15 * kPi)) * r_), loss = 1 - mean;
    const float more = std::max(1 - albedo(p.z), 0.0f) * std::max(1 - albedo(n.z), 0.0f) / loss;
    const auto channel = [&](float rho) { return rho * kInvPi * (single + rho * mean / (1 - rho * loss) * more); };
    return {channel(reflectance.r), channel(reflectance.g), channel(reflectance.b)};
  }

  // Cosine-weighted, with as much of an even distribution as keeps f cos / density small where both directions graze.
  float density(float cosine) const { return kInvPi * (cosine + 0.5f * r_ * (0.5f - cosine)); }
  Vec3 sample(float u0, float u1) const {
    const float even = 0.5f * r_;
    if (u0 >= even) return sample_cosine_hemisphere((u0 - even) / (1 - even), u1);
    const float z = 1 - u0 / even, rho = safe_sqrt(1 - z * z), phi = kTwoPi * u1;
    return {rho * std::cos(phi), rho * std::sin(phi), z};
  }

 private:
  // Of single scattering with a reflectance of 1.
  float albedo(float cosine) const {
    const float c = std::min(cosine, 1.0f), s = safe_sqrt(1 - c * c);
    const float g = s * (std::acos(c) - s * c) + (2.0f / 3) * (s * c * (1 + s + s * s) / (1 + s) - s);
    return a_ * (1 + r_ * kInvPi * g);
  }

  float r_, a_;
};

}  // namespace bdpt
