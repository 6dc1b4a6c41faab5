// Fibres that stand on a surface: Charlie's distribution (Estevez and Kulla 2017) with Ashikhmin's visibility, as
// glTF's KHR_materials_sheen has it. Both directions on the side z > 0.
#pragma once

#include "math/vec.h"

namespace bdpt {

struct Sheen {
  float inverse;  // of alpha

  // Below 0.1 the sheen would scatter more than it receives.
  explicit Sheen(float alpha) : inverse(1 / std::max(alpha, 0.1f)) {}

  float f(const Vec3& p, const Vec3& n) const {
    const Vec3 h = p + n;
    const float h2 = length_squared(h);
    if (!(h2 > 0)) return 0;
    const float sine = safe_sqrt(1 - h.z * h.z / h2);
    const float d = (2 + inverse) * std::pow(sine, inverse) * (0.5f * kInvPi);
    return d / (4 * (p.z + n.z - p.z * n.z));
  }
};

}  // namespace bdpt
