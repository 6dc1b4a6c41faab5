// Turns the lights of a pbrt scene into the library's. A radiance in rgb is what a pixel that sees it shows.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pbrt/params.h"
#include "scene_description.h"
#include "scene_folder.h"
#include "transform.h"

namespace bdpt_tool {

struct AreaLight {
  Rgb radiance = {};
  int texture = -1;  // times the radiance
  bool two_sided = false;
};

// Pictures of lights become textures of the scene.
AreaLight convert_area_light(const std::string& type, const ParamList& params, const SceneFolder& folder,
                             SceneDescription& scene, Diagnostics& diagnostics);
LightDescription convert_light(const std::string& type, const ParamList& params, const Transform& to_world,
                               const SceneFolder& folder, SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace bdpt_tool
