// Warps of the unit square, and their densities.
#pragma once

#include "math/vec.h"

namespace bdpt {

inline Vec2 sample_disk(float u0, float u1) {  // concentric (Shirley and Chiu 1997), density 1/pi
  const float a = 2 * u0 - 1, b = 2 * u1 - 1;
  if (a == 0 && b == 0) return {0, 0};
  float r, phi;
  if (std::fabs(a) > std::fabs(b)) {
    r = a;
    phi = (kPi / 4) * (b / a);
  } else {
    r = b;
    phi = kPi / 2 - (kPi / 4) * (a / b);
  }
  return {r * std::cos(phi), r * std::sin(phi)};
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
