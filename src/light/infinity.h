// What infinitely far lights have in common: their rays start evenly on a disk that covers the scene, perpendicular to
// their direction, or by half through portals; they cross the disk then, too, and those that would not carry nothing.
#pragma once

#include "light/light.h"
#include "light/portal.h"
#include "sampling/warp.h"

namespace bdpt {

// All of them keep at least this.
struct InfiniteLight : LightData {
  Portals portals;
};
inline const Portals& portals_of(const Light& light) { return static_cast<const InfiniteLight&>(*light.data).portals; }

// From y0.normal.
inline void start_on_disk(const Light& light, const StartNumbers& u, LightStart& start) {
  const Vec3& n = start.y0.normal;
  start.direction = -n;
  Vec3 p;
  if (portals_of(light).sample_ray(n, double(u.way), u.v1, u.v2, p)) {
    start.origin = p + n * (light.radius - dot(p - light.center, n));
    return;
  }
  const Vec2 d = sample_disk(u.v1, u.v2);
  const Frame frame(n);
  start.origin = light.center + (n + frame.t * d.x + frame.b * d.y) * light.radius;
}

inline float density_on_disk(const Light& light, const LightPoint&, const Vec3& x, const Vec3& w) {
  const float even = kInvPi / (light.radius * light.radius);
  const Portals& portals = portals_of(light);
  if (portals.empty()) return even;
  const Vec3 from = x - light.center;
  return length_squared(from - w * dot(from, w)) < light.radius * light.radius ? portals.ray_density(x, w, even) : 0;
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
