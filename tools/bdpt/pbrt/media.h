// The media of a pbrt scene: homogeneous ones.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pbrt/params.h"
#include "scene_description.h"

namespace bdpt_tool {

MediumDescription convert_medium(const std::string& name, const ParamList& params, Diagnostics& diagnostics);

}  // namespace bdpt_tool
