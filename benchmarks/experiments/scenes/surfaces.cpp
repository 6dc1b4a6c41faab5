// SPDX-License-Identifier: Apache-2.0
#include "scenes/surfaces.h"

#include <cmath>
#include <numbers>

namespace bdpt_experiments {
namespace {

constexpr float kTwoPi = 2 * std::numbers::pi_v<float>;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point along(const Point& a, const Point& b, float t) { return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point unit(const Point& a) {
  const float length = std::hypot(a[0], a[1], a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

Point trefoil(float t) {
  return {std::sin(t) + 2 * std::sin(2 * t), std::sin(3 * t), std::cos(t) - 2 * std::cos(2 * t)};
}

}  // namespace

bdpt_tool::TriangleMesh surface(int columns, int rows, bool closed, const std::function<Point(float, float)>& at) {
  constexpr float kStep = 1e-3f;
  bdpt_tool::TriangleMesh mesh;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const float u = float(i) / float(columns);
      // Just off the ends, where a ball's rows shrink to points.
      const float v = closed ? float(j) / float(rows) : 2 * kStep + (1 - 4 * kStep) * float(j) / float(rows - 1);
      const Point p = at(u, v), along_u = minus(at(u + kStep, v), at(u - kStep, v)),
                  along_v = minus(at(u, v + kStep), at(u, v - kStep)), n = unit(cross(along_u, along_v));
      mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
      mesh.normals.insert(mesh.normals.end(), n.begin(), n.end());
    }
  const auto index = [&](int i, int j) { return std::uint32_t(j % rows * columns + i % columns); };
  for (int j = 0; j < (closed ? rows : rows - 1); ++j)
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  return mesh;
}

bdpt_tool::TriangleMesh torus(const Point& center, float radius, float tube) {
  return surface(96, 48, true, [=](float u, float v) -> Point {
    const float a = -kTwoPi * u, b = kTwoPi * v, r = radius + tube * std::cos(b);
    return {center[0] + r * std::cos(a), center[1] + tube * std::sin(b), center[2] + r * std::sin(a)};
  });
}

bdpt_tool::TriangleMesh bumpy_ball(const Point& center, float radius) {
  return surface(160, 120, false, [=](float u, float v) -> Point {
    const float a = -kTwoPi * u, b = kTwoPi / 2 * (v - 0.5f);
    const float r = radius * (1 + 0.05f * std::cos(b) * std::sin(7 * a) * std::sin(8 * b));
    return {center[0] + r * std::cos(b) * std::cos(a), center[1] + r * std::sin(b),
            center[2] + r * std::cos(b) * std::sin(a)};
  });
}

bdpt_tool::TriangleMesh knot(const Point& center, float size, float tube) {
  return surface(240, 32, true, [=](float u, float v) -> Point {
    const float t = kTwoPi * u, b = kTwoPi * v;
    const Point tangent = unit(minus(trefoil(t + 1e-2f), trefoil(t - 1e-2f)));
    const Point side = unit(cross({0, 1, 0}, tangent)), up = cross(tangent, side);
    const Point p = along(along({}, trefoil(t), size / 3), along(along({}, side, std::cos(b)), up, std::sin(b)), tube);
    return {center[0] + p[0], center[1] + p[1], center[2] + p[2]};
  });
}

}  // namespace bdpt_experiments
