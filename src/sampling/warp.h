// Warps of the unit square, and their densities.
#pragma once

#include "math/vec.h"

namespace bdpt {

// Sine and cosine of x in [-pi/4, pi/4], to the last bits of a float.
inline Vec2 cos_sin_octant(float x) {
  const float x2 = x * x;
  const float s = x + x * x2 * (-1.6666654611e-1f + x2 * (8.3321608736e-3f - x2 * 1.9515295891e-4f));
  const float c =
      1 - 0.5f * x2 + x2 * x2 * (4.166664568298827e-2f + x2 * (-1.388731625493765e-3f + x2 * 2.443315711809948e-5f));
  return {c, s};
}

inline Vec2 sample_disk(float u0, float u1) {  // concentric (Shirley and Chiu 1997), density 1/pi
  const float a = 2 * u0 - 1, b = 2 * u1 - 1;
  if (a == 0 && b == 0) return {0, 0};
  if (std::fabs(a) > std::fabs(b)) return cos_sin_octant((kPi / 4) * (b / a)) * a;
  const Vec2 cs = cos_sin_octant((kPi / 4) * (a / b));
  return {b * cs.y, b * cs.x};
}

inline Vec3 sample_cosine_hemisphere(float u0, float u1) {  // density cos / pi
  const Vec2 d = sample_disk(u0, u1);
  return {d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y)};
}

inline Vec3 sample_sphere(float u0, float u1) {  // density 1 / 4 pi
  const float z = 1 - 2 * u0, r = safe_sqrt(1 - z * z), phi = kTwoPi * u1;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

inline Vec3 sample_cone(float u0, float u1, float one_minus_cos) {  // density 1 / (2 pi (1 - cos))
  const float d = u0 * one_minus_cos, z = 1 - d, r = safe_sqrt(d * (2 - d)), phi = kTwoPi * u1;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

inline Vec2 sample_triangle(float u0, float u1) {  // barycentric coordinates of the second and third vertex, uniform
  // Folds the square along its diagonal (Heitz 2019): keeps strata whole, no square root.
  if (u1 > u0) {
    const float b = u0 / 2;
    return {b, u1 - b};
  }
  const float b = u1 / 2;
  return {u0 - b, b};
}

}  // namespace bdpt
