// What lights on surfaces have in common: they shine from one side or both, with radiance that
// goes with a power n of the cosine: 0 is Lambertian, -1 the same intensity in all directions.
#pragma once

#include "light/light.h"
#include "sampling/warp.h"

namespace bdpt {

// cosine^n for a cosine above 0.
inline float profile(const Light& light, float cosine) {
  return light.exponent == 0 ? 1 : std::pow(cosine, light.exponent);
}

inline Rgb emitted_by_area(const Light& light, const LightPoint& y0, const Vec3& w) {
  float c = dot(y0.normal, w);
  if (light.two_sided) c = std::fabs(c);
  if (!(c > 0)) return Rgb();
  return light.exponent == 0 ? light.radiance : light.radiance * profile(light, c / length(w));
}

// (n + 2) / 2 pi cos^n, per projected solid angle.
inline float direction_density_of_area(const Light& light, const LightPoint& y0, const Vec3&, const Vec3& w) {
  float c = dot(y0.normal, w);
  if (light.two_sided) c = std::fabs(c);
  if (!(c > 0)) return 0;
  const float one_sided = light.exponent == 0 ? kInvPi : (light.exponent + 2) / kTwoPi * profile(light, c);
  return light.two_sided ? 0.5f * one_sided : one_sided;
}

// A two-sided light takes a side by the first half of the direction's first number.
inline void start_from_area(const Light& light, float v1, float v2, LightStart& start) {
  Vec3 n = start.y0.normal;
  if (light.two_sided) {
    v1 *= 2;
    if (v1 >= 1) v1 -= 1, n = -n;
  }
  Vec3 local;
  if (light.exponent == 0) {
    local = sample_cosine_hemisphere(v1, v2);
  } else {
    const float z = std::pow(1 - v1, 1 / (light.exponent + 2)), r = safe_sqrt(1 - z * z), phi = kTwoPi * v2;
    local = Vec3(r * std::cos(phi), r * std::sin(phi), z);
  }
  start.direction = Frame(n).to_world(local);
  start.origin = start.y0.p;
}

// All that leaves a surface of this area, over its radiance along the normal.
inline double reach_of_area(const Light& light, double area) {
  return 2 * double(kPi) / (double(light.exponent) + 2) * area * (light.two_sided ? 2 : 1);
}

inline double power_of_area(const Light& light) {
  return double(norm(light.radiance)) * reach_of_area(light, 1 / double(light.inverse_area));
}

}  // namespace bdpt
