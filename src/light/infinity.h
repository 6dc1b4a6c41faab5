// What infinitely far lights have in common: their rays start evenly on a disk that covers the scene, perpendicular to
// their direction.
#pragma once

#include "light/light.h"
#include "sampling/warp.h"

namespace bdpt {

// From y0.normal.
inline void start_on_disk(const Light& light, float v1, float v2, LightStart& start) {
  const Vec3& n = start.y0.normal;
  start.direction = -n;
  const Vec2 d = sample_disk(v1, v2);
  const Frame frame(n);
  start.origin = light.center + (n + frame.t * d.x + frame.b * d.y) * light.radius;
}

inline float density_on_disk(const Light& light, const LightPoint&, const Vec3&) {
  return kInvPi / (light.radius * light.radius);
}

inline double area_of_disk(const Light& light) { return double(kPi) * light.radius * light.radius; }

// A kind of infinitely far light.
constexpr LightKind kind_at_infinity(bool hittable, decltype(LightKind::power) power, decltype(LightKind::start) start,
                                     decltype(LightKind::place) place, decltype(LightKind::emitted) emitted,
                                     decltype(LightKind::position_density) position_density,
                                     decltype(LightKind::direct_density) direct_density) {
  return {.has_area = false,
          .infinite = true,
          .hittable = hittable,
          .is_mesh = false,
          .power = power,
          .start = start,
          .place = place,
          .emitted = emitted,
          .position_density = position_density,
          .direction_density = density_on_disk,
          .direct_density = direct_density,
          .density_in_triangle = nullptr,
          .bounds = nullptr};
}

}  // namespace bdpt
