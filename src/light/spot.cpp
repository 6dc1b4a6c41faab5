// A point that shines into a cone, with a smooth edge.
#include "light/spot.h"

#include "light/kinds.h"
#include "light/point.h"
#include "sampling/warp.h"

namespace bdpt {

namespace {

struct Spot : LightData {
  Vec3 axis;
  SpotCone cone;
};

const Spot& spot_of(const Light& light) { return static_cast<const Spot&>(*light.data); }

double power(const Light& light) {
  const Spot& s = spot_of(light);
  return 2.0 * kPi * norm(light.radiance) * (1 - 0.5 * (double(s.cone.cos_inner) + s.cone.cos_outer));
}

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  const Spot& s = spot_of(light);
  start.y0.p = start.origin = light.center;
  start.direction = Frame(s.axis).to_world(sample_cone(u.v1, u.v2, 1 - s.cone.cos_outer));
}

Rgb emitted(const Light& light, const LightPoint&, const Vec3& w) {
  const Spot& s = spot_of(light);
  return light.radiance * s.cone.falloff(dot(w, s.axis) / length(w));
}

float direction_density(const Light& light, const LightPoint&, const Vec3&, const Vec3& w) {
  const Spot& s = spot_of(light);
  return dot(w, s.axis) > s.cone.cos_outer ? 1 / (kTwoPi * (1 - s.cone.cos_outer)) : 0;
}

Emitter bounds(const Light& light, uint32_t) {
  const Spot& s = spot_of(light);
  Emitter e = bounds_of_point(light, 0);
  e.axis = s.axis;
  e.cos_o = s.cone.cos_inner;
  e.cos_e = std::cos(std::acos(double(s.cone.cos_outer)) - std::acos(double(s.cone.cos_inner))) -
            1e-4;  // cosines are rounded
  return e;
}

}  // namespace

const LightKind kSpotLight = kind_at_point(power, start, emitted, direction_density, bounds);

std::unique_ptr<LightData> make_spot(const LightDesc& desc, Light& light) {
  light.kind = LightKindId::Spot;
  light.center = desc.position;
  light.radiance = desc.intensity;
  auto spot = std::make_unique<Spot>();
  spot->axis = desc.direction;
  spot->cone = {desc.cos_outer, desc.cos_inner};
  return spot;
}

}  // namespace bdpt
