// Affine transforms, 3x4 row-major.
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

struct Transform {
  float m[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

  Vec3 point(const Vec3& p) const {
    return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
            m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
  }
  Vec3 vector(const Vec3& v) const {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
            m[8] * v.x + m[9] * v.y + m[10] * v.z};
  }
  // The largest term that point(p) adds up: its rounding error is a few ulps of this.
  float magnitude(const Vec3& p) const {
    const auto row = [&](const float* r) {
      return std::fabs(r[0] * p.x) + std::fabs(r[1] * p.y) + std::fabs(r[2] * p.z) + std::fabs(r[3]);
    };
    return std::max({row(m), row(m + 4), row(m + 8)});
  }
  Vec3 column(int i) const { return {m[i], m[4 + i], m[8 + i]}; }
  // The transpose of the linear part: takes normals when called on the inverse.
  Vec3 transposed(const Vec3& v) const {
    return {m[0] * v.x + m[4] * v.y + m[8] * v.z, m[1] * v.x + m[5] * v.y + m[9] * v.z,
            m[2] * v.x + m[6] * v.y + m[10] * v.z};
  }
  double determinant() const {
    const double a = m[0], b = m[1], c = m[2], d = m[4], e = m[5], f = m[6], g = m[8], h = m[9], i = m[10];
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  }
  bool is_identity() const {
    const Transform one;
    for (int i = 0; i < 12; ++i)
      if (m[i] != one.m[i]) return false;
    return true;
  }
};

// The inverse; the determinant must not be zero.
inline Transform invert(const Transform& t) {
  const double det = t.determinant();
  const float* m = t.m;
  const double a = m[0], b = m[1], c = m[2], d = m[4], e = m[5], f = m[6], g = m[8], h = m[9], i = m[10];
  const double r[9] = {e * i - f * h, c * h - b * i, b * f - c * e, f * g - d * i, a * i - c * g,
                       c * d - a * f, d * h - e * g, b * g - a * h, a * e - b * d};
  Transform inverse;
  for (int row = 0; row < 3; ++row) {
    double translation = 0;
    for (int column = 0; column < 3; ++column) {
      const double v = r[3 * row + column] / det;
      inverse.m[4 * row + column] = float(v);
      translation -= v * double(m[4 * column + 3]);
    }
    inverse.m[4 * row + 3] = float(translation);
  }
  return inverse;
}

// Element by element, as Embree moves instances: every point on a straight line.
inline Transform between(const Transform& begin, const Transform& end, float time) {
  Transform t;
  for (int i = 0; i < 12; ++i) t.m[i] = begin.m[i] * (1 - time) + end.m[i] * time;
  return t;
}

}  // namespace bdpt
