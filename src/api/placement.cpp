#include "api/placement.h"

#include <Imath/ImathVec.h>

#include <algorithm>
#include <limits>

namespace bdpt {
namespace {

using Vec3d = Imath::V3d;

// Columns count as orthogonal and of equal length within this.
constexpr double kTolerance = 1e-3;
// The smallest determinant, relative to the columns' lengths: below, rounding has the say.
constexpr double kSingular = 1e-6;

Vec3d column(const Transform& t, int i) { return {t.m[i], t.m[4 + i], t.m[8 + i]}; }

// The inverse of the linear part is the cofactors over the determinant; its rows are these.
bool has_finite_inverse(const Transform& t, double determinant) {
  const Vec3d a = column(t, 0), b = column(t, 1), c = column(t, 2);
  const Vec3d rows[3] = {b.cross(c), c.cross(a), a.cross(b)};
  for (const Vec3d& row : rows)
    for (int i = 0; i < 3; ++i)
      if (!(std::fabs(row[i] / determinant) <= std::numeric_limits<float>::max())) return false;
  return true;
}

}  // namespace

bool is_zero(const float m[12]) {
  return std::all_of(m, m + 12, [](float v) { return v == 0; });
}

Transform read_transform(const Subject& subject, const float m[12], const char* field) {
  if (is_zero(m)) return {};
  subject.check_finite(field, m, 12);
  Transform transform;
  std::copy(m, m + 12, transform.m);
  const double determinant = column(transform, 0).dot(column(transform, 1).cross(column(transform, 2)));
  const double lengths = column(transform, 0).length() * column(transform, 1).length() * column(transform, 2).length();
  if (!(std::fabs(determinant) > kSingular * lengths) || !has_finite_inverse(transform, determinant))
    subject.refuse(field, "is singular (determinant ", determinant,
                   "): give an invertible 3x4 matrix, row by row, "
                   "or twelve zeros for the identity");
  return transform;
}

double uniform_scale(const Transform& transform) {
  const Vec3d a = column(transform, 0), b = column(transform, 1), c = column(transform, 2);
  const double la = a.length(), lb = b.length(), lc = c.length();
  const double scale = std::cbrt(la * lb * lc);
  for (const double l : {la, lb, lc})
    if (!(std::fabs(l - scale) <= kTolerance * scale)) return 0;
  const double limit = kTolerance * scale * scale;
  return std::fabs(a.dot(b)) <= limit && std::fabs(b.dot(c)) <= limit && std::fabs(c.dot(a)) <= limit ? scale : 0;
}

Transform without_scale(const Transform& transform) {
  // Gram-Schmidt, from z, along which a camera looks.
  const Vec3d z = column(transform, 2).normalized();
  const Vec3d y = (column(transform, 1) - z * z.dot(column(transform, 1))).normalized();
  Vec3d x = y.cross(z);
  if (x.dot(column(transform, 0)) < 0) x = -x;
  Transform result = transform;
  const Vec3d columns[3] = {x, y, z};
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < 3; ++i) result.m[4 * row + i] = static_cast<float>(columns[i][row]);
  return result;
}

}  // namespace bdpt
