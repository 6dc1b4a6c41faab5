// Light from one direction: a Dirac at infinity, which no eye subpath meets.
#include "light/infinity.h"
#include "light/kinds.h"

namespace bdpt {

namespace {

struct Direction : InfiniteLight {
  Vec3 to_light;
};

const Vec3& to_light(const Light& light) { return static_cast<const Direction&>(*light.data).to_light; }

double power(const Light& light) { return area_of_disk(light) * double(norm(light.radiance)); }

void place(const Light& light, const PlaceNumbers&, const Vec3&, LightPoint& y0) { y0.normal = to_light(light); }

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  start.y0.normal = to_light(light);
  start_on_disk(light, u, start);
}

Rgb emitted(const Light& light, const LightPoint&, const Vec3&) { return light.radiance; }
float position_density(const Light&, const LightPoint&) { return 1; }
float direct_density(const Light&, const LightPoint&, const Vec3&) { return 1; }

}  // namespace

const LightKind kDirectionalLight =
    kind_at_infinity(false, power, start, place, emitted, position_density, direct_density);

std::unique_ptr<LightData> make_directional(const LightDesc& desc, Light& light) {
  light.kind = LightKindId::Directional;
  light.radiance = desc.irradiance;
  auto data = std::make_unique<Direction>();
  data->to_light = -desc.direction;
  data->portals = Portals(desc.portals);
  return data;
}

}  // namespace bdpt
