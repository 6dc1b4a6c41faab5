// Scenes that are meshes alone: OBJ with its materials, and PLY.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene_read.h"

namespace bdpt_tool {

// OBJ: an instance for each group and material of it, in the file's order; PLY: one. A camera that sees all of it and,
// where nothing shines, an environment of radiance 1.
SceneDescription read_obj_scene(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics);
SceneDescription read_ply_scene(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace bdpt_tool
