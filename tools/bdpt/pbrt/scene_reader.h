// Reads a pbrt-v4 scene file.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "error.h"
#include "scene_read.h"

namespace bdpt_tool {

// Throws an Error with file and line where the picture would be wrong, and warns where it is only poorer.
SceneDescription read_pbrt_scene(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace bdpt_tool
