// A camera for files that have none.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene_description.h"

namespace bdpt_tool::gltf {

// Sees all of the scene from its front, +z, a little from the right and from above, with 45 degrees.
CameraDescription framing_camera(const SceneDescription& scene);

}  // namespace bdpt_tool::gltf
