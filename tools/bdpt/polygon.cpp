// SPDX-License-Identifier: Apache-2.0
#include "polygon.h"

#include <array>
#include <cmath>

#include "transform.h"

namespace bdpt_tool {
namespace {

using Point = std::array<double, 2>;

// Twice the area, positive where a, b, c turn to the left.
double area(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

class Polygon {
 public:
  Polygon(const std::vector<float>& positions, const std::vector<std::uint32_t>& corners) {
    std::vector<Vec3> points;
    for (const std::uint32_t corner : corners) {
      const float* p = &positions[3 * std::size_t{corner}];
      points.push_back({double{p[0]}, double{p[1]}, double{p[2]}});
    }
    flatten(points);
  }

  // The corners of the triangles, by their place in the polygon.
  std::vector<std::size_t> cut() {
    for (std::size_t i = 0; i < points_.size(); ++i) rest_.push_back(i);
    std::vector<std::size_t> triangles;
    while (rest_.size() > 3) {
      const std::size_t ear = find_ear();
      add(ear, triangles);
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    add(1, triangles);
    return triangles;
  }

 private:
  // Onto the plane that the normal, by Newell's sum, is most at right angles to.
  void flatten(const std::vector<Vec3>& points) {
    Vec3 normal = {};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 &a = points[i], &b = points[(i + 1) % points.size()];
      for (std::size_t k = 0; k < 3; ++k) {
        normal[k] += (a[(k + 1) % 3] - b[(k + 1) % 3]) * (a[(k + 2) % 3] + b[(k + 2) % 3]);
      }
    }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    }
    const double sign = normal[axis] < 0 ? -1 : 1;
    for (const Vec3& p : points) points_.push_back({p[(axis + 1) % 3], sign * p[(axis + 2) % 3]});
  }

  const Point& at(std::size_t i) const { return points_[rest_[i % rest_.size()]]; }

  // A corner to the left with no other in its triangle; if there is none, the one that turns most to the left.
  std::size_t find_ear() const {
    std::size_t widest = 0;
    double most = -1;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      const double turn = area(at(i + rest_.size() - 1), at(i), at(i + 1));
      if (turn > 0 && is_empty(i)) return i;
      if (turn > most) {
        most = turn;
        widest = i;
      }
    }
    return widest;
  }

  bool is_empty(std::size_t ear) const {
    const std::size_t n = rest_.size();
    const Point &a = at(ear + n - 1), &b = at(ear), &c = at(ear + 1);
    for (std::size_t k = 2; k + 1 < n; ++k) {
      const Point& p = at(ear + k);
      if (p == a || p == b || p == c) continue;
      if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
  }

  void add(std::size_t ear, std::vector<std::size_t>& triangles) const {
    const std::size_t n = rest_.size();
    triangles.insert(triangles.end(), {rest_[(ear + n - 1) % n], rest_[ear % n], rest_[(ear + 1) % n]});
  }

  std::vector<Point> points_;
  std::vector<std::size_t> rest_;
};

}  // namespace

void triangulate(const std::vector<float>& positions, const std::vector<std::uint32_t>& corners,
                 std::vector<std::uint32_t>& triangles) {
  if (corners.size() == 3) {
    triangles.insert(triangles.end(), corners.begin(), corners.end());
    return;
  }
  for (const std::size_t corner : Polygon(positions, corners).cut()) triangles.push_back(corners[corner]);
}

}  // namespace bdpt_tool
