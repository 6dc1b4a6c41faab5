// The primitives of glTF meshes as triangle meshes.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "gltf/document.h"
#include "gltf/notes.h"
#include "mesh.h"

namespace bdpt_tool::gltf {

// `texture` is the one that the mesh's uv serves: its set and its transform are applied. uv_lightmap is always
// TEXCOORD_1 as it is. In both, v runs up as the library has it: 1 - v of the file, so that v = 1 is an image's top
// row. No mesh for what has no triangles or no positions, of which `notes` tells.
std::optional<TriangleMesh> read_primitive(const Document& document, const Primitive& primitive,
                                           const TextureUse& texture, const Location& where, const std::string& place,
                                           Notes& notes);

}  // namespace bdpt_tool::gltf
