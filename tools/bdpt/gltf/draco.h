// KHR_draco_mesh_compression: triangles and attributes of a primitive, packed by Draco.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "error.h"
#include "gltf/document.h"

namespace bdpt_tool::gltf {

// Whether the program was built with Draco's library.
extern const bool kReadsDraco;

// For tinygltf, which refuses indices without data of their own: those of packed primitives become a member of the
// extension. `json` has been checked.
std::string with_packed_indices_apart(std::string_view json);

// Replaces indices and attributes of `primitive` by accessors of what `data` holds, which must be as many numbers of
// the same kind. `ids` are Draco's names of the attributes. Throws an Error that begins with `at`.
void unpack_draco(std::span<const unsigned char> data, const std::map<std::string, int>& ids, const Location& where,
                  const std::string& at, Document& document, Primitive& primitive);

}  // namespace bdpt_tool::gltf
