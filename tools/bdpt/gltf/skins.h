// Skins: meshes that follow joints.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "error.h"
#include "gltf/document.h"
#include "mesh.h"
#include "transform.h"

namespace bdpt_tool::gltf {

// For each joint of a skin, its transform to the world times the inverse bind matrix. `to_world` is of all nodes.
std::vector<Transform> joint_matrices(const Document& document, int skin, const std::vector<Transform>& to_world,
                                      const Location& where);

// What each vertex follows: four joints to a set, and how much.
struct Influences {
  std::vector<float> joints, weights;
};

// Moves positions, normals and tangents. Throws an Error that begins with `place` for joints that do not exist.
void bend(TriangleMesh& mesh, const std::vector<Influences>& influences, const std::vector<Transform>& joints,
          const Location& where, const std::string& place);

}  // namespace bdpt_tool::gltf
