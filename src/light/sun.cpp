// A disc at infinity, of the same radiance all over.
#include "light/infinity.h"
#include "light/kinds.h"

#include <numbers>

namespace bdpt {

namespace {

struct Sun : InfiniteLight {
  Vec3 to_light;
  float one_minus_cos;  // of its angular radius
  float density;        // 1 / solid angle
};

const Sun& sun_of(const Light& light) { return static_cast<const Sun&>(*light.data); }

double power(const Light& light) {
  return area_of_disk(light) * double(norm(light.radiance)) / double(sun_of(light).density);
}

void place(const Light& light, const PlaceNumbers& u, const Vec3&, LightPoint& y0) {
  const Sun& s = sun_of(light);
  y0.normal = Frame(s.to_light).to_world(sample_cone(u.u1, u.u2, s.one_minus_cos));
}

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  place(light, u, {}, start.y0);
  start_on_disk(light, u, start);
}

// By the chord between unit vectors: a cosine would be too coarse for a disc so small.
bool is_within(const Sun& s, const Vec3& w) { return length_squared(w - s.to_light) <= 2 * s.one_minus_cos; }

Rgb emitted(const Light& light, const LightPoint& y0, const Vec3&) {
  return is_within(sun_of(light), y0.normal) ? light.radiance : Rgb();
}

float position_density(const Light& light, const LightPoint& y0) {
  const Sun& s = sun_of(light);
  return is_within(s, y0.normal) ? s.density : 0;
}
float direct_density(const Light& light, const LightPoint& y0, const Vec3&) { return position_density(light, y0); }

}  // namespace

const LightKind kSunLight = kind_at_infinity(true, power, start, place, emitted, position_density, direct_density);

// The disc's irradiance, facing it, is pi sin² of its radius times its radiance.
std::unique_ptr<LightData> make_sun(const LightDesc& desc, Light& light) {
  light.kind = LightKindId::Sun;
  auto sun = std::make_unique<Sun>();
  sun->to_light = -desc.direction;
  sun->portals = Portals(desc.portals);
  const double half = std::sin(desc.angular_radius / 2), whole = std::sin(desc.angular_radius);
  sun->one_minus_cos = float(2 * half * half);
  sun->density = float(1 / (4 * std::numbers::pi * half * half));
  light.radiance = desc.irradiance * float(1 / (std::numbers::pi * whole * whole));
  return sun;
}

}  // namespace bdpt
