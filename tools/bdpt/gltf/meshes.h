// The primitives of glTF meshes as triangle meshes.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gltf/document.h"
#include "mesh.h"
#include "notes.h"
#include "transform.h"

namespace bdpt_tool::gltf {

// How a mesh stands.
struct Pose {
  std::vector<double> weights;    // of the morph targets; none = 0
  std::vector<Transform> joints;  // from where each joint was when the mesh was bound to where it is; none = no skin
};

// uv is TEXCOORD_0 and uv_lightmap TEXCOORD_1, as they are but for v, which runs up as the library has it: 1 - v of the
// file, so that v = 1 is an image's top row. No mesh for what has no triangles or no positions, of which `notes` tells.
std::optional<TriangleMesh> read_primitive(const Document& document, const Primitive& primitive, const Pose& pose,
                                           const Location& where, const std::string& place, Notes& notes);

}  // namespace bdpt_tool::gltf
