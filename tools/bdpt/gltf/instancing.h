// EXT_mesh_gpu_instancing.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "error.h"
#include "gltf/document.h"
#include "transform.h"

namespace bdpt_tool::gltf {

// Where the copies of a node's mesh are, in the node's space. `place` names the node in errors.
std::vector<Transform> copies_of(const Document& document, const Node& node, const Location& where,
                                 const std::string& place);

}  // namespace bdpt_tool::gltf
