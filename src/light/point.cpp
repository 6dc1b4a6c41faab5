// A point that sends the same intensity into all directions.
#include "light/point.h"

#include "light/kinds.h"
#include "sampling/warp.h"

namespace bdpt {

namespace {

double power(const Light& light) { return 4.0 * kPi * norm(light.radiance); }

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  start.y0.p = start.origin = light.center;
  start.direction = sample_sphere(u.v1, u.v2);
}

Rgb emitted(const Light& light, const LightPoint&, const Vec3&) { return light.radiance; }
float direction_density(const Light&, const LightPoint&, const Vec3&, const Vec3&) { return 0.25f * kInvPi; }

}  // namespace

const LightKind kPointLight = kind_at_point(power, start, emitted, direction_density, bounds_of_point);

std::unique_ptr<LightData> make_point(const LightDesc& desc, Light& light) {
  light.kind = LightKindId::Point;
  light.center = desc.position;
  light.radiance = desc.intensity;
  return nullptr;
}

}  // namespace bdpt
