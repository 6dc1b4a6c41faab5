// SPDX-License-Identifier: Apache-2.0
#include "pbrt/lights.h"

#include <cmath>
#include <filesystem>

#include "pbrt/environment.h"
#include "pbrt/light_pictures.h"

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

// The picture that a light names, linear.
Image read_picture(const ParamList& params, const SceneFolder& folder) {
  const Param& file = *params.find("filename");
  const Image image = to_linear(read_image(folder.path_of(params.get_string("filename", ""), file.where), file.where));
  for (const float x : image.pixels) {
    if (!(x >= 0 && std::isfinite(x))) params.fail(file, "has a texel that is negative or not finite");
  }
  return image;
}

// Of what shines by its picture alone.
Rgb picture_scale(const ParamList& params, const char* value) {
  if (params.has(value))
    params.fail("\"filename\" and \"" + std::string(value) +
                "\" exclude each other; scale the picture by \"float scale\"");
  return emission(params, value);
}

int add_picture(const ParamList& params, Image image, std::array<Wrap, 2> wrap, SceneDescription& scene) {
  scene.textures.push_back({.label = std::filesystem::path(params.get_string("filename", "")).filename().string(),
                            .where = params.find("filename")->where,
                            .image = std::move(image),
                            .exponent = 0,
                            .wrap = wrap,
                            .nearest = false});
  return static_cast<int>(scene.textures.size()) - 1;
}

// Squares are Clarberg's map of equal areas, as pbrt-v4 has it; others have rows of latitude, as had pbrt-v3.
void picture(const ParamList& params, const Transform& to_world, const SceneFolder& folder, SceneDescription& scene,
             LightDescription& light) {
  light.value = picture_scale(params, "L");
  const Image image = read_picture(params, folder);
  if (!to_world.is_invertible()) params.fail("the transform before it is singular");
  PlacedPicture placed = place_picture(image, to_world);
  light.transform = placed.to_world;
  light.texture = add_picture(params, std::move(placed.image), {Wrap::kRepeat, Wrap::kClamp}, scene);
}

// A light that stands at the origin of its own space, with an axis and an up there.
void place_light(const ParamList& params, const Transform& to_world, const Vec3& axis, const Vec3& up,
                 LightDescription& light) {
  if (!to_world.is_invertible()) params.fail("the transform before it is singular");
  light.position = to_rgb(to_world.point({0, 0, 0}));
  light.direction = to_rgb(normalized(to_world.vector(axis)));
  light.up = to_rgb(normalized(to_world.vector(up)));
}

// Its four corners, in the world whatever the transform.
void portal(const ParamList& params, LightDescription& light) {
  const Param* const param = params.find("portal");
  if (!param) return;
  const std::vector<float> p = params.get_tuples("portal", 3);
  if (p.size() != 12)
    params.fail(*param, "has " + std::to_string(p.size() / 3) + " points; give the corners of a rectangle");
  PortalDescription portal;
  double off = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    portal.corner[c] = p[c];
    portal.edge_u[c] = p[3 + c] - p[c];
    portal.edge_v[c] = p[9 + c] - p[c];
    off = std::max(off, std::fabs(double{p[6 + c]} - p[3 + c] - p[9 + c] + p[c]));
  }
  const double longest = std::max(length(to_vec3(portal.edge_u)), length(to_vec3(portal.edge_v)));
  if (off > 1e-3 * longest) params.fail(*param, "is no rectangle: give its corners one after another");
  light.portals.push_back(portal);
}

void projection(const ParamList& params, const Transform& to_world, const SceneFolder& folder, SceneDescription& scene,
                LightDescription& light) {
  light.type = BDPT_LIGHT_SPOT;
  if (!params.has("filename")) params.fail("\"string filename\" is missing");
  light.value = picture_scale(params, "I");
  place_light(params, to_world, {0, 0, 1}, {0, 1, 0}, light);
  ThrownPicture thrown = throw_picture(read_picture(params, folder), params.get_float("fov", 90), to_world);
  if (!(thrown.cone_angle > 0 && thrown.cone_angle <= 85))
    params.fail("fov must be above 0, and its picture's corners at most 85 degrees from the axis");
  light.cone_angle = thrown.cone_angle;
  light.cone_falloff = 0;
  light.texture = add_picture(params, std::move(thrown.image), {Wrap::kClamp, Wrap::kClamp}, scene);
}

// By a square picture of all directions, or by an IES file, whose lamps look down.
void goniometric(const ParamList& params, const Transform& to_world, const SceneFolder& folder,
                 LightDescription& light) {
  light.type = BDPT_LIGHT_POINT;
  light.value = emission(params, "I");
  const std::string file = params.get_string("filename", "");
  if (file.empty()) {
    light.position = to_rgb(to_world.point({0, 0, 0}));
    return;
  }
  if (std::filesystem::path(file).extension() == ".ies") {
    place_light(params, to_world, {0, -1, 0}, {0, 0, 1}, light);
    light.luminaire = read_ies(folder.path_of(file, params.find("filename")->where));
    return;
  }
  place_light(params, to_world, {0, 1, 0}, {1, 0, 0}, light);
  const Image image = read_picture(params, folder);
  if (image.width != image.height) params.fail(*params.find("filename"), "must be a square picture, of equal areas");
  light.luminaire = luminaire_of(image, to_world);
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

AreaLight convert_area_light(const std::string& type, const ParamList& params, const SceneFolder& folder,
                             SceneDescription& scene, Diagnostics& diagnostics) {
  if (type != "diffuse") params.fail("the area light '" + type + "' is not known; use diffuse");
  refuse_photometry(params);
  AreaLight light;
  if (params.has("filename")) {
    light.radiance = picture_scale(params, "L");
    light.texture = add_picture(params, read_picture(params, folder), {Wrap::kClamp, Wrap::kClamp}, scene);
  } else {
    light.radiance = emission(params, "L");
  }
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
    light.type = BDPT_LIGHT_ENVIRONMENT;
    portal(params, light);
    if (params.has("filename")) {
      picture(params, to_world, folder, scene, light);
    } else {
      light.value = emission(params, "L");
    }
  } else if (type == "distant") {
    light.type = BDPT_LIGHT_DIRECTIONAL;
    light.direction = direction(params, to_world);
    light.value = emission(params, "L");
  } else if (type == "projection") {
    projection(params, to_world, folder, scene, light);
  } else if (type == "goniometric") {
    goniometric(params, to_world, folder, light);
  } else {
    params.fail("the light '" + type +
                "' is not known; use point, spot, distant, infinite, projection, goniometric, or an area light");
  }
  params.warn_unused(diagnostics);
  return light;
}

}  // namespace bdpt_tool
