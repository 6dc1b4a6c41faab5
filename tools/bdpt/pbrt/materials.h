// Turns the materials of a pbrt scene into the library's.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pbrt/params.h"
#include "pbrt/textures.h"
#include "scene_description.h"

namespace bdpt_tool {

// `type` is "diffuse", "conductor" or "dielectric"; any other is an Error.
MaterialDescription convert_material(const std::string& type, const ParamList& params, TextureTable& textures,
                                     Diagnostics& diagnostics);

}  // namespace bdpt_tool
