// SPDX-License-Identifier: Apache-2.0
#include "mesh.h"

#include <utility>

namespace bdpt_tool {
namespace {

bool is_zero(const float* v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

void add_triangle_normal(TriangleMesh& mesh, const std::uint32_t* triangle, std::uint32_t vertex) {
  const float* a = &mesh.positions[3 * std::size_t{triangle[0]}];
  const float* b = &mesh.positions[3 * std::size_t{triangle[1]}];
  const float* c = &mesh.positions[3 * std::size_t{triangle[2]}];
  float* normal = &mesh.normals[3 * std::size_t{vertex}];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    normal[i] += (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
  }
}

}  // namespace

void turn_over(TriangleMesh& mesh) {
  for (float& x : mesh.normals) x = -x;
  if (!mesh.normals.empty()) return;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

std::size_t repair_zero_normals(TriangleMesh& mesh) {
  if (mesh.normals.empty()) return 0;
  std::vector<bool> zero(mesh.vertex_count());
  std::size_t count = 0;
  for (std::size_t v = 0; v < zero.size(); ++v) {
    zero[v] = is_zero(&mesh.normals[3 * v]);
    count += zero[v];
  }
  if (count == 0) return 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.indices[i + corner];
      if (zero[vertex]) add_triangle_normal(mesh, &mesh.indices[i], vertex);
    }
  }
  // Vertices of no triangle, or of degenerate ones only: any direction will do.
  for (std::size_t v = 0; v < zero.size(); ++v) {
    if (is_zero(&mesh.normals[3 * v])) mesh.normals[3 * v + 2] = 1;
  }
  return count;
}

}  // namespace bdpt_tool
