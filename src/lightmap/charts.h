// Charts: triangles that hang together in texture space.
#pragma once

#include "lightmap/uv_mesh.h"

namespace bdpt {

struct Charts {
  std::vector<std::vector<uint32_t>> of_triangles;  // for each mesh and triangle: 1, 2, 3 ... in order of appearance
  uint32_t count = 0;
};

// Triangles of a mesh are of one chart if they share a vertex: the same point in the world and in the atlas, whatever
// its index. Meshes of other atlases have no charts: their triangles get 0.
Charts find_charts(const std::vector<UvMesh>& meshes, uint32_t atlas);

}  // namespace bdpt
