// All directions on a square: |x| + |y| + |z| = 1 projected along z, its lower half folded out over the corners
// (Cigolle et al. 2014). Texels are N x N, in rows, (-1, -1) the corner of the first.
#pragma once

#include "math/vec.h"

#include <vector>

namespace bdpt {

// In [-1,1]², of a direction of any length.
Vec2 to_octahedron(const Vec3& w);
Vec3 from_octahedron(const Vec2& p);  // unit

struct Octahedron {
  explicit Octahedron(int size = 0);
  int texel(const Vec3& w) const;

  int size;
  std::vector<Vec3> directions;  // of the texels' centres
  std::vector<float> angles;     // the solid angles of the texels
};

}  // namespace bdpt
