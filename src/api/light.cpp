#include "api/builder.h"
#include "api/check.h"
#include "api/desc.h"

#include <Imath/ImathVec.h>

#include <numbers>

using namespace bdpt;

namespace {

float cos_degrees(double angle) { return static_cast<float>(std::cos(angle * std::numbers::pi / 180)); }

void read_spot(const Subject& subject, const bdpt_light_desc& desc, LightDesc& light) {
  const Imath::V3d direction(desc.direction[0], desc.direction[1], desc.direction[2]);
  if (direction.length() == 0) subject.refuse("direction", "has length zero: give the axis of the spot, of any length");
  if (!(desc.cone_angle > 0 && desc.cone_angle < 180))
    subject.refuse("cone_angle", "is ", desc.cone_angle, ": give an angle above 0 and below 180 degrees");
  if (!(desc.cone_falloff >= 0 && desc.cone_falloff <= desc.cone_angle))
    subject.refuse("cone_falloff", "is ", desc.cone_falloff, ": give a value from 0 to cone_angle (", desc.cone_angle,
                   ")");
  light.direction = Vec3(direction / direction.length());
  light.cos_outer = cos_degrees(desc.cone_angle);
  light.cos_inner = cos_degrees(double(desc.cone_angle) - double(desc.cone_falloff));
}

LightDesc read_light(const bdpt_light_desc& desc) {
  const Subject subject("light", desc.label);
  subject.check_enum("type", desc.type, BDPT_LIGHT_ENVIRONMENT);
  subject.check_finite("position", desc.position, 3);
  subject.check_finite("direction", desc.direction, 3);
  subject.check_not_negative("intensity", desc.intensity, 3);
  subject.check_not_negative("radiance", desc.radiance, 3);
  subject.check_finite("cone_angle", desc.cone_angle);
  subject.check_finite("cone_falloff", desc.cone_falloff);
  subject.check_range("group", desc.group, 0, 63);
  LightDesc light;
  light.group = desc.group;
  light.label = subject.label();
  light.type = static_cast<LightType>(desc.type);
  light.position = to_vec3(desc.position);
  if (desc.type == BDPT_LIGHT_ENVIRONMENT)
    light.radiance = to_rgb(desc.radiance);
  else
    light.intensity = to_rgb(desc.intensity);
  if (desc.type == BDPT_LIGHT_SPOT) read_spot(subject, desc, light);
  return light;
}

}  // namespace

bdpt_result bdpt_light_add(bdpt_builder* builder, const bdpt_light_desc* desc, bdpt_light_id* light) {
  return guard(__func__, [&] {
    reset_output(light);
    bdpt_builder& b = writable(builder);
    const bdpt_light_desc d = read_struct(desc, "desc");
    require(light, "light");
    light->id = b.lights.add(read_light(d));
  });
}

bdpt_result bdpt_light_update(bdpt_builder* builder, bdpt_light_id light, const bdpt_light_desc* desc) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const bdpt_light_desc d = read_struct(desc, "desc");
    LightDesc& entry = b.lights.at(light.id, "light");
    entry = read_light(d);
  });
}

bdpt_result bdpt_light_remove(bdpt_builder* builder, bdpt_light_id light) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    b.lights.at(light.id, "light");
    b.lights.take(light.id);
  });
}
