// What lights at a point have in common.
#pragma once

#include "light/light.h"

namespace bdpt {

inline void place_at_point(const Light& light, const PlaceNumbers&, const Vec3&, LightPoint& y0) {
  y0.p = light.center;
}
inline float position_density_of_point(const Light&, const LightPoint&) { return 1; }
inline float direct_density_of_point(const Light&, const LightPoint&, const Vec3&) { return 1; }

// Into all directions.
inline Emitter bounds_of_point(const Light& light, uint32_t) {
  Emitter e;
  e.low = e.high = light.center;
  e.intensity = norm(light.radiance);
  return e;
}

// A kind of light at a point.
constexpr LightKind kind_at_point(decltype(LightKind::power) power, decltype(LightKind::start) start,
                                  decltype(LightKind::emitted) emitted,
                                  decltype(LightKind::direction_density) direction_density,
                                  decltype(LightKind::bounds) bounds) {
  return {.has_area = false,
          .infinite = false,
          .hittable = false,
          .is_mesh = false,
          .power = power,
          .start = start,
          .place = place_at_point,
          .emitted = emitted,
          .position_density = position_density_of_point,
          .direction_density = direction_density,
          .direct_density = direct_density_of_point,
          .density_in_triangle = nullptr,
          .bounds = bounds};
}

}  // namespace bdpt
