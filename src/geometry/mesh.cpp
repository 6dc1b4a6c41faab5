#include "geometry/mesh.h"

#include <Imath/ImathVec.h>

#include <cmath>

namespace bdpt {

bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
  // In double, so that a small or distant triangle is not dropped for rounding, nor a huge one for overflow.
  using Vec3d = Imath::V3d;
  const Vec3d p(a), e1 = Vec3d(b) - p, e2 = Vec3d(c) - p;
  const double area_squared = e1.cross(e2).length2(), limit = 1e-24 * e1.length2() * e2.length2();
  return !(std::isfinite(area_squared) && area_squared > limit);
}

void Mesh::uv_corners(int set, uint32_t triangle, Vec2 corners[3]) const {
  const Triangle t = triangles[triangle];
  const View<Vec2>& coordinates = uv[set];
  if (coordinates.empty()) {
    corners[0] = Vec2(0, 0), corners[1] = Vec2(1, 0), corners[2] = Vec2(1, 1);
  } else {
    corners[0] = coordinates[t.a], corners[1] = coordinates[t.b], corners[2] = coordinates[t.c];
  }
}

Rgba Mesh::color(uint32_t triangle, float u, float v) const {
  const Triangle t = triangles[triangle];
  const Rgba a = colors[t.a], b = colors[t.b], c = colors[t.c];
  Rgba mean;
  for (size_t i = 0; i < 4; ++i) mean[i] = a[i] * (1 - u - v) + b[i] * u + c[i] * v;
  return mean;
}

}  // namespace bdpt
