// The tree of nodes: where everything is.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "error.h"
#include "gltf/document.h"
#include "transform.h"

namespace bdpt_tool::gltf {

struct PlacedNode {
  int node = 0;
  Transform to_world;
};

// The nodes below the scene's roots, parents first, in the file's order. Throws an Error if a node has two parents or
// is its own ancestor, or if its transform is not finite or not affine.
std::vector<PlacedNode> place_nodes(const Document& document, const Location& where);

// The transforms of all nodes, of whatever scene, which place_nodes has found sound.
std::vector<Transform> transforms_to_world(const Document& document, const Location& where);

// Translation times rotation, by a quaternion x, y, z, w of any length but zero, times scale.
Transform compose(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                  const std::array<double, 3>& scale);

}  // namespace bdpt_tool::gltf
