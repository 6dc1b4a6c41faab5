// Seams: edges that are one in the world and two in the atlas.
#pragma once

#include "lightmap/uv_mesh.h"

namespace bdpt {

// One side of a seam: where an edge lies in its atlas, in texels. Both sides run the same way in the world.
struct SeamSide {
  uint32_t atlas = 0;
  Vec2d from, to;
};

struct Seam {
  SeamSide a, b;
};

struct SeamOptions {
  double position_tolerance = 0;  // world units, > 0
  double cos_angle = 1;           // of the largest angle between the normals of the two sides
};

// Edges of triangles with an area in the world and in the atlas, whose ends are within the tolerance and whose normals
// there (the triangles' own in a mesh without) are within the angle. Where more than two meet, each is joined to the
// first that fits; of those before it at most 64 are looked at.
std::vector<Seam> find_seams(const std::vector<UvMesh>& meshes, const SeamOptions& options);

}  // namespace bdpt
