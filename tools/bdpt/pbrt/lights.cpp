// SPDX-License-Identifier: Apache-2.0
#include "pbrt/lights.h"

#include <cmath>
#include <filesystem>

#include "pbrt/environment.h"

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

Rgb direction(const ParamList& params, const Transform& to_world) {
  const Vec3 from = to_vec3(params.get_point("from", {0, 0, 0})), to = to_vec3(params.get_point("to", {0, 0, 1}));
  const Vec3 axis = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  if (length(axis) == 0) params.fail("\"from\" and \"to\" are the same point");
  return to_rgb(normalized(to_world.vector(normalized(axis))));
}

// Squares are Clarberg's map of equal areas, as pbrt-v4 has it; others have rows of latitude, as had pbrt-v3.
void picture(const ParamList& params, const Transform& to_world, const SceneFolder& folder, SceneDescription& scene,
             LightDescription& light) {
  if (params.has("L")) params.fail("\"filename\" and \"L\" exclude each other; scale the picture by \"float scale\"");
  const Param& file = *params.find("filename");
  const std::string path = folder.path_of(params.get_string("filename", ""), file.where);
  const Image image = to_linear(read_image(path, file.where));
  for (const float x : image.pixels) {
    if (!(x >= 0 && std::isfinite(x))) params.fail(file, "has a texel that is negative or not finite");
  }
  if (!to_world.is_invertible()) params.fail("the transform before it is singular");
  const PlacedPicture placed = place_picture(image, to_world);
  light.texture = static_cast<int>(scene.textures.size());
  light.transform = placed.to_world;
  scene.textures.push_back({.label = std::filesystem::path(path).filename().string(),
                            .where = file.where,
                            .image = placed.image,
                            .exponent = 1,
                            .wrap = {Wrap::kRepeat, Wrap::kClamp},
                            .nearest = false});
}

void spot(const ParamList& params, const Transform& to_world, LightDescription& light) {
  light.type = BDPT_LIGHT_SPOT;
  light.position = to_rgb(to_world.point(to_vec3(params.get_point("from", {0, 0, 0}))));
  light.direction = direction(params, to_world);
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
                               const SceneFolder& folder, SceneDescription& scene, Diagnostics& diagnostics) {
  LightDescription light;
  light.where = params.where();
  light.label = type;
  refuse_photometry(params);
  if (type == "point") {
    light.type = BDPT_LIGHT_POINT;
    light.position = to_rgb(to_world.point(to_vec3(params.get_point("from", {0, 0, 0}))));
    light.value = emission(params, "I");
  } else if (type == "spot") {
    spot(params, to_world, light);
  } else if (type == "infinite") {
    params.refuse("portal", "is not known yet; remove it");
    light.type = BDPT_LIGHT_ENVIRONMENT;
    light.value = emission(params, "L");
    if (params.has("filename")) picture(params, to_world, folder, scene, light);
  } else if (type == "distant") {
    light.type = kLightDirectional;
    light.direction = direction(params, to_world);
    light.value = emission(params, "L");
  } else {
    params.fail("the light '" + type + "' is not known yet; use point, spot, distant, infinite, or an area light");
  }
  params.warn_unused(diagnostics);
  return light;
}

}  // namespace bdpt_tool
