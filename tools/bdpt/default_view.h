// A camera and a light for files that have none.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "notes.h"
#include "scene_description.h"

namespace bdpt_tool {

// Sees all of the scene from its front, +z, a little from the right and from above, with 45 degrees.
CameraDescription framing_camera(const SceneDescription& scene);

// Whether nothing shines but what is unlit, beside something that wants to be lit: then `white_environment` helps.
bool is_dark(const SceneDescription& scene);
LightDescription white_environment();

// Adds both where they are missing, and tells of it. `has_camera`: the scene has one already.
void complete(SceneDescription& scene, bool has_camera, Notes& notes);

}  // namespace bdpt_tool
