// The directive Camera.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pbrt/params.h"
#include "scene_description.h"
#include "transform.h"

namespace bdpt_tool {

// `world_to_camera` is the transform where Camera stands in the file; files are relative to `folder`.
void read_camera(const std::string& type, const ParamList& params, const Transform& world_to_camera,
                 const std::string& folder, SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace bdpt_tool
