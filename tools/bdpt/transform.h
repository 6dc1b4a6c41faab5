// Affine transforms.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace bdpt_tool {

using Vec3 = std::array<double, 3>;

Vec3 cross(const Vec3& a, const Vec3& b);
double dot(const Vec3& a, const Vec3& b);
double length(const Vec3& v);
Vec3 normalized(const Vec3& v);

// Rows of a 3x4 matrix.
struct Transform {
  double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

  Vec3 point(const Vec3& p) const;
  Vec3 vector(const Vec3& v) const;
  double determinant() const;
  bool is_finite() const;
  bool is_invertible() const;
  Transform inverse() const;  // of an invertible one
  std::array<float, 12> rows() const;

  bool operator==(const Transform&) const = default;
};

// First b, then a.
Transform operator*(const Transform& a, const Transform& b);

Transform translation(double x, double y, double z);
Transform scaling(double x, double y, double z);
Transform rotation(double degrees, const Vec3& axis);
// World to camera, where the camera has x to the right, y up and looks along +z; `up` must not be parallel to it.
Transform look_at(const Vec3& eye, const Vec3& target, const Vec3& up);

// The factor a transform scales by in all directions; 0 if it scales differently or shears.
double uniform_scale(const Transform& transform);

}  // namespace bdpt_tool
