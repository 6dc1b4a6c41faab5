// A triangle mesh in memory, as the readers leave it.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt_tool {

struct TriangleMesh {
  std::vector<float> positions;        // 3 to a vertex
  std::vector<float> normals;          // 3 to a vertex, or empty
  std::vector<float> uv;               // 2 to a vertex, or empty; for textures
  std::vector<float> uv_lightmap;      // 2 to a vertex, or empty
  std::vector<float> tangents;         // 4 to a vertex, or empty; the last is the sign of the bitangent
  std::vector<float> colors;           // 4 to a vertex, or empty; linear, the last is alpha
  std::vector<std::uint32_t> indices;  // 3 to a triangle

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t triangle_count() const { return indices.size() / 3; }
};

// Turns the front to the other side: by the normals where there are any, else by the winding.
void turn_over(TriangleMesh& mesh);

// A normal of length zero says nothing; it is replaced by that of the triangles around the vertex.
// Returns how many were replaced.
std::size_t repair_zero_normals(TriangleMesh& mesh);

}  // namespace bdpt_tool
