// SPDX-License-Identifier: Apache-2.0
#include "pbrt/lights.h"

namespace bdpt_tool {
namespace {

Rgb to_rgb(const Vec3& v) { return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}; }
Vec3 to_vec3(const Rgb& v) { return {v[0], v[1], v[2]}; }

// The value of a light, scaled.
Rgb emission(const ParamList& params, const std::string& name) {
  Rgb value = params.get_rgb(name, {1, 1, 1}, true);
  const float scale = params.get_float("scale", 1);
  for (float& x : value) {
    x *= scale;
    if (x < 0) params.fail("a light cannot be negative");
  }
  return value;
}

void refuse_photometry(const ParamList& params) {
  params.refuse("power", "is not known yet; give the value in rgb and \"float scale\"");
  params.refuse("illuminance", "is not known yet; give \"rgb L\" and \"float scale\"");
}

void spot(const ParamList& params, const Transform& to_world, LightDescription& light) {
  const Vec3 from = to_vec3(params.get_point("from", {0, 0, 0}));
  const Vec3 to = to_vec3(params.get_point("to", {0, 0, 1}));
  const Vec3 axis = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  if (length(axis) == 0) params.fail("\"from\" and \"to\" are the same point");
  light.type = BDPT_LIGHT_SPOT;
  light.position = to_rgb(to_world.point(from));
  light.direction = to_rgb(normalized(to_world.vector(normalized(axis))));
  light.value = emission(params, "I");
  light.cone_angle = params.get_float("coneangle", 30);
  light.cone_falloff = params.get_float("conedeltaangle", 5);
  if (!(light.cone_angle > 0 && light.cone_angle < 180)) params.fail("coneangle must be between 0 and 180 degrees");
  if (!(light.cone_falloff >= 0 && light.cone_falloff <= light.cone_angle)) {
    params.fail("conedeltaangle must be between 0 and coneangle");
  }
}

}  // namespace

AreaLight convert_area_light(const std::string& type, const ParamList& params, Diagnostics& diagnostics) {
  if (type != "diffuse") params.fail("the area light '" + type + "' is not known; use diffuse");
  params.refuse("filename", "is not known yet: area lights emit one radiance");
  refuse_photometry(params);
  AreaLight light;
  light.radiance = emission(params, "L");
  light.two_sided = params.get_bool("twosided", false);
  params.warn_unused(diagnostics);
  return light;
}

LightDescription convert_light(const std::string& type, const ParamList& params, const Transform& to_world,
                               Diagnostics& diagnostics) {
  LightDescription light;
  light.where = params.where();
  refuse_photometry(params);
  if (type == "point") {
    light.type = BDPT_LIGHT_POINT;
    light.position = to_rgb(to_world.point(to_vec3(params.get_point("from", {0, 0, 0}))));
    light.value = emission(params, "I");
  } else if (type == "spot") {
    spot(params, to_world, light);
  } else if (type == "infinite") {
    params.refuse("filename", "is not known yet: an infinite light has one radiance; give \"rgb L\"");
    params.refuse("portal", "is not known yet; remove it");
    light.type = BDPT_LIGHT_ENVIRONMENT;
    light.value = emission(params, "L");
  } else {
    params.fail("the light '" + type + "' is not known yet; use point, spot, infinite, or an area light");
  }
  params.warn_unused(diagnostics);
  return light;
}

}  // namespace bdpt_tool
