// Reads PLY meshes: ASCII and both binary encodings, triangles and quads.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "error.h"
#include "mesh.h"

namespace bdpt_tool {

// `path` names the file in errors. Vertex properties x y z, nx ny nz, and u v or s t are used, others are skipped.
TriangleMesh parse_ply(std::string_view data, const std::string& path);

// `from` is the place in a scene that names the file.
TriangleMesh read_ply(const std::string& path, const Location& from = {});

}  // namespace bdpt_tool
