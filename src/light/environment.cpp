// The same radiance from all directions.
#include "light/infinity.h"
#include "light/kinds.h"

namespace bdpt {

namespace {

double power(const Light& light) { return 4.0 * kPi * area_of_disk(light) * double(norm(light.radiance)); }

void place(const Light& light, const PlaceNumbers& u, const Vec3& x, LightPoint& y0) {
  double rest = u.rest;
  if (!portals_of(light).sample_direction(x, rest, u.u1, u.u2, y0.normal)) y0.normal = sample_sphere(u.u1, u.u2);
}

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  start.y0.normal = sample_sphere(u.u1, u.u2);
  start_on_disk(light, u, start);
}

Rgb emitted(const Light& light, const LightPoint&, const Vec3&) { return light.radiance; }

float position_density(const Light&, const LightPoint&) { return 0.25f * kInvPi; }
float direct_density(const Light& light, const LightPoint& y0, const Vec3& x) {
  return portals_of(light).direction_density(x, y0.normal, 0.25f * kInvPi);
}

}  // namespace

const LightKind kEnvironmentLight =
    kind_at_infinity(true, power, start, place, emitted, position_density, direct_density);

std::unique_ptr<LightData> make_environment(const LightDesc& desc, Light& light) {
  light.kind = LightKindId::Environment;
  light.radiance = desc.radiance;
  auto data = std::make_unique<InfiniteLight>();
  data->portals = Portals(desc.portals);
  return data;
}

}  // namespace bdpt
