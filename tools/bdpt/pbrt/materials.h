// The materials of a pbrt scene.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pbrt/params.h"
#include "pbrt/textures.h"
#include "scene_description.h"

namespace bdpt_tool {

// `type` is any of pbrt's but "mix", which directives_world.cpp makes, and those that scatter below the surface.
MaterialDescription convert_material(const std::string& type, const ParamList& params, TextureTable& textures,
                                     Diagnostics& diagnostics);

}  // namespace bdpt_tool
