// From the colours of a scene file, which are linear Rec. 709, to those of the render.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bdpt.h"
#include "scene_description.h"

namespace bdpt_tool {

// Materials, media and lights; textures name their space when they are handed over.
void convert_colors(const bdpt_context* context, SceneDescription& description);

}  // namespace bdpt_tool
