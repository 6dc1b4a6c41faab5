// SPDX-License-Identifier: Apache-2.0
#include "transform.h"

#include <cmath>
#include <numbers>

namespace bdpt_tool {

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double length(const Vec3& v) { return std::sqrt(dot(v, v)); }

Vec3 normalized(const Vec3& v) {
  const double l = length(v);
  return {v[0] / l, v[1] / l, v[2] / l};
}

Vec3 Transform::vector(const Vec3& v) const {
  Vec3 result;
  for (int i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

Vec3 Transform::point(const Vec3& p) const {
  Vec3 result = vector(p);
  for (int i = 0; i < 3; ++i) result[i] += m[i][3];
  return result;
}

double Transform::determinant() const {
  return dot({m[0][0], m[0][1], m[0][2]}, cross({m[1][0], m[1][1], m[1][2]}, {m[2][0], m[2][1], m[2][2]}));
}

bool Transform::is_finite() const {
  for (const auto& row : m) {
    for (double x : row) {
      if (!std::isfinite(static_cast<float>(x))) return false;
    }
  }
  return true;
}

bool Transform::is_invertible() const {
  const double d = determinant();
  return std::isfinite(d) && d != 0 && std::isfinite(1 / d);
}

Transform Transform::inverse() const {
  const Vec3 r0 = {m[0][0], m[0][1], m[0][2]}, r1 = {m[1][0], m[1][1], m[1][2]}, r2 = {m[2][0], m[2][1], m[2][2]};
  const Vec3 columns[3] = {cross(r1, r2), cross(r2, r0), cross(r0, r1)};
  const double d = determinant();
  Transform result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.m[i][j] = columns[j][i] / d;
  }
  const Vec3 t = result.vector({m[0][3], m[1][3], m[2][3]});
  for (int i = 0; i < 3; ++i) result.m[i][3] = -t[i];
  return result;
}

std::array<float, 12> Transform::rows() const {
  std::array<float, 12> rows;
  for (int i = 0; i < 12; ++i) rows[i] = static_cast<float>(m[i / 4][i % 4]);
  return rows;
}

Transform operator*(const Transform& a, const Transform& b) {
  Transform result;
  for (int column = 0; column < 4; ++column) {
    const Vec3 v = {b.m[0][column], b.m[1][column], b.m[2][column]};
    const Vec3 image = column == 3 ? a.point(v) : a.vector(v);
    for (int row = 0; row < 3; ++row) result.m[row][column] = image[row];
  }
  return result;
}

Transform translation(double x, double y, double z) { return {{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}}}; }

Transform scaling(double x, double y, double z) { return {{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}}}; }

Transform rotation(double degrees, const Vec3& axis) {
  const double angle = degrees * std::numbers::pi / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec3 a = normalized(axis);
  Transform result;
  for (int column = 0; column < 3; ++column) {
    Vec3 unit = {};
    unit[column] = 1;
    const Vec3 sideways = cross(a, unit);  // Rodrigues' formula
    for (int row = 0; row < 3; ++row) {
      result.m[row][column] = c * unit[row] + s * sideways[row] + (1 - c) * a[column] * a[row];
    }
  }
  return result;
}

Transform look_at(const Vec3& eye, const Vec3& target, const Vec3& up) {
  const Vec3 z = normalized({target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]});
  const Vec3 x = normalized(cross(normalized(up), z));
  const Vec3 y = cross(z, x);
  const Transform camera_to_world = {
      {{x[0], y[0], z[0], eye[0]}, {x[1], y[1], z[1], eye[1]}, {x[2], y[2], z[2], eye[2]}}};
  return camera_to_world.inverse();
}

double uniform_scale(const Transform& t) {
  Vec3 column[3];
  for (int i = 0; i < 3; ++i) column[i] = {t.m[0][i], t.m[1][i], t.m[2][i]};
  const double scale = length(column[0]);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(length(column[i]) - scale) > 1e-4 * scale) return 0;
    if (std::abs(dot(column[i], column[(i + 1) % 3])) > 1e-4 * scale * scale) return 0;
  }
  return scale;
}

}  // namespace bdpt_tool
