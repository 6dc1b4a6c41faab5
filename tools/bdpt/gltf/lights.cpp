// SPDX-License-Identifier: Apache-2.0
#include "gltf/lights.h"

#include <algorithm>

namespace bdpt_tool::gltf {
namespace {

Rgb rgb(const Vec3& v) { return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}; }

// Lights shine along their -z.
Rgb axis(const Transform& to_world, const Location& where, const std::string& place) {
  const Vec3 axis = to_world.vector({0, 0, -1});
  if (!(length(axis) > 0)) throw Error(where, place + " has no direction: the scale of its node is zero");
  return rgb(normalized(axis));
}

void set_cone(const Light& from, const Location& where, const std::string& place, LightDescription& light) {
  if (from.inner_angle >= from.outer_angle) {
    throw Error(where, place + ": innerConeAngle must be less than outerConeAngle");
  }
  light.cone_angle = static_cast<float>(from.outer_angle * kDegrees);
  light.cone_falloff = std::min(light.cone_angle, static_cast<float>((from.outer_angle - from.inner_angle) * kDegrees));
}

}  // namespace

LightDescription placed_light(const Light& from, const Transform& to_world, const Location& where,
                              const std::string& place, Notes& notes) {
  LightDescription light;
  light.where = where;
  light.label = from.name.empty() ? place : from.name;
  light.position = rgb(to_world.point({0, 0, 0}));
  for (std::size_t c = 0; c < 3; ++c) light.value[c] = static_cast<float>(from.color[c] * from.intensity);
  if (from.type == "spot") {
    light.type = BDPT_LIGHT_SPOT;
    light.direction = axis(to_world, where, place);
    set_cone(from, where, place, light);
    notes.add("the edge of a spot falls off smoothly at both its ends", place);
  } else if (from.type == "directional") {
    light.type = BDPT_LIGHT_DIRECTIONAL;
    light.direction = axis(to_world, where, place);
  } else if (from.type != "point") {
    throw Error(where, place + " is of the unknown type '" + from.type + "'");
  }
  if (from.has_range) notes.add("the range of a light is left out: it reaches everywhere", place);
  return light;
}

}  // namespace bdpt_tool::gltf
