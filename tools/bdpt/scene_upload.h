// Hands a scene description over to the library.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "camera_options.h"
#include "handles.h"
#include "scene_read.h"

namespace bdpt_tool {

// Builds the scene. Instances are told their ids. The meshes move into the library, which borrows their memory. Returns
// no scene if cancelled.
Scene build_scene(bdpt_context* context, SceneDescription& description, bdpt_cancel* cancel = nullptr);

// The camera as the library takes it, for an image of this size. Its lens is the description's.
bdpt_camera_desc camera_desc(const SceneDescription& description, std::uint32_t width, std::uint32_t height,
                             Diagnostics& diagnostics, const CameraOptions& options = {});

}  // namespace bdpt_tool
