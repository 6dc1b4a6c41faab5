// The directive Camera.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pbrt/motion.h"
#include "pbrt/params.h"
#include "scene_description.h"
#include "scene_folder.h"

namespace bdpt_tool {

// `world_to_camera` is the transform where Camera stands in the file; files are found in `folder`. Sets `shutter`.
void read_camera(const std::string& type, const ParamList& params, const MovingTransform& world_to_camera,
                 const TimeRange& times, TimeRange& shutter, const SceneFolder& folder, SceneDescription& scene,
                 Diagnostics& diagnostics);

}  // namespace bdpt_tool
