// Reads a glTF 2.0 file, .gltf or .glb.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "error.h"
#include "scene_read.h"

namespace bdpt_tool {

// Each primitive of a mesh becomes a shape, shared by all nodes that use the mesh; an instance is named after its node,
// with "/0", "/1", ... for the primitives where there are several. Candela become W/sr, and emission W/(m² sr), one to
// one. Throws an Error where the file is damaged, breaks the format's rules or requires what is not known; what is left
// out or only come near to is warned of, once for each kind.
SceneDescription read_gltf_scene(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace bdpt_tool
