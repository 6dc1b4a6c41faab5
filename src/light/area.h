// What lights on surfaces have in common: they are diffuse, on one side or both.
#pragma once

#include "light/light.h"
#include "sampling/warp.h"

namespace bdpt {

inline Rgb emitted_by_area(const Light& light, const LightPoint& y0, const Vec3& w) {
  const float c = dot(y0.normal, w);
  return c > 0 || (light.two_sided && c < 0) ? light.radiance : Rgb();
}

inline float direction_density_of_area(const Light& light, const LightPoint& y0, const Vec3& w) {
  if (light.two_sided) return 0.5f * kInvPi;
  return dot(y0.normal, w) > 0 ? kInvPi : 0;
}

// A two-sided light takes a side by the first half of the direction's first number.
inline void start_from_area(const Light& light, float v1, float v2, LightStart& start) {
  Vec3 n = start.y0.normal;
  if (light.two_sided) {
    v1 *= 2;
    if (v1 >= 1) v1 -= 1, n = -n;
  }
  start.direction = Frame(n).to_world(sample_cosine_hemisphere(v1, v2));
  start.origin = start.y0.p;
}

inline double power_of_area(const Light& light) {
  return double(norm(light.radiance)) * kPi / double(light.inverse_area) * (light.two_sided ? 2 : 1);
}

}  // namespace bdpt
