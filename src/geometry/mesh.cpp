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

}  // namespace bdpt
