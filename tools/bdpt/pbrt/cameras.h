// The directive Camera.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pbrt/params.h"
#include "scene_description.h"
#include "scene_folder.h"
#include "transform.h"

namespace bdpt_tool {

// `world_to_camera` is the transform where Camera stands in the file; files are found in `folder`.
void read_camera(const std::string& type, const ParamList& params, const Transform& world_to_camera,
                 const SceneFolder& folder, SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace bdpt_tool
