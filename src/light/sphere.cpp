// A sphere that shines outward, or both ways. Direct lighting takes of it what the point lit sees.
#include "geometry/margin.h"
#include "light/area.h"
#include "light/kinds.h"

namespace bdpt {

namespace {

// 1 - cos of the half-angle under which a sphere appears from a distance d > r, safe for small angles.
float one_minus_cos_cap(float radius, float d2) {
  const float sin2 = std::min(1.0f, radius * radius / d2);
  return sin2 / (1 + safe_sqrt(1 - sin2));
}

// The point where the normal is n.
void place_at(const Light& light, const Vec3& n, LightPoint& y0) {
  y0.normal = n;
  y0.p = light.center + n * light.radius;
  y0.margin = margin_of_sphere(light.center, light.radius);
}

// Whether x sees the sphere as a cap from outside. Points on the sphere itself, rounded to either side, do not. One
// function, never inlined: sampling and density must not round differently.
[[gnu::noinline]] bool sees_cap(const Light& light, const Vec3& x) {
  return length_squared(light.center - x) > light.radius * light.radius * 1.0001f;
}

void place(const Light& light, const PlaceNumbers& u, const Vec3& x, LightPoint& y0) {
  if (!sees_cap(light, x)) return place_at(light, sample_sphere(u.u1, u.u2), y0);
  const Vec3 to_center = light.center - x;
  const float d2 = length_squared(to_center);
  const Vec3 local = sample_cone(u.u1, u.u2, one_minus_cos_cap(light.radius, d2));
  const Vec3 w = Frame(to_center * (1 / std::sqrt(d2))).to_world(local);
  const float sin2 = 1 - local.z * local.z;
  const float t = std::sqrt(d2) * local.z - safe_sqrt(light.radius * light.radius - d2 * sin2);
  place_at(light, unit(x + w * t - light.center), y0);
}

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  place_at(light, sample_sphere(u.u1, u.u2), start.y0);
  start_from_area(light, u.v1, u.v2, start);
}

float position_density(const Light& light, const LightPoint&) { return light.inverse_area; }

float direct_density(const Light& light, const LightPoint& y0, const Vec3& x) {
  if (!sees_cap(light, x)) return light.inverse_area;
  const float center2 = length_squared(light.center - x);
  const Vec3 w = x - y0.p;
  const float d2 = length_squared(w);
  const float cos_y = dot(y0.normal, w) / std::sqrt(d2);
  if (!(cos_y > 0)) return 0;  // the far side is never chosen
  return cos_y / (kTwoPi * one_minus_cos_cap(light.radius, center2) * d2);
}

Emitter bounds(const Light& light, uint32_t) {
  Emitter e;
  e.low = light.center - Vec3(light.radius);
  e.high = light.center + Vec3(light.radius);
  e.intensity = double(norm(light.radiance)) * kPi * light.radius * light.radius;
  return e;
}

}  // namespace

const LightKind kSphereLight = {
    .has_area = true,
    .infinite = false,
    .hittable = true,
    .is_mesh = false,
    .power = power_of_area,
    .start = start,
    .place = place,
    .emitted = emitted_by_area,
    .position_density = position_density,
    .direction_density = direction_density_of_area,
    .direct_density = direct_density,
    .density_in_triangle = nullptr,
    .bounds = bounds,
};

}  // namespace bdpt
