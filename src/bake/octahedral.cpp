#include "bake/octahedral.h"

namespace bdpt {

namespace {

using Imath::V2d;
using Imath::V3d;

// To the octahedron's surface; what is linear on a face of it is straight on the square.
V3d unfold(const V2d& p) {
  const double x = std::fabs(p.x), y = std::fabs(p.y), z = 1 - x - y;
  if (z >= 0) return {p.x, p.y, z};
  return {std::copysign(1 - y, p.x), std::copysign(1 - x, p.y), z};
}

// Of a triangle seen from the origin (Van Oosterom and Strackee 1983).
double solid_angle(const V3d& a, const V3d& b, const V3d& c) {
  const double x = a.length(), y = b.length(), z = c.length();
  const double below = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
  return 2 * std::atan2(std::fabs(a.dot(b.cross(c))), below);
}

// Of a square with a corner at p that lies within a quarter of the square, and is cut by no fold but along its
// diagonal.
double solid_angle(const V2d& p, double side) {
  const V2d q(p.x + side, p.y), r(p.x, p.y + side), s(p.x + side, p.y + side);
  const bool rising = (p.x + side / 2) * (p.y + side / 2) < 0;  // the fold's direction there
  const V2d &from = rising ? p : q, &to = rising ? s : r, &one = rising ? q : p, &other = rising ? r : s;
  // On the fold both halves have the same points.
  return solid_angle(unfold(from), unfold(to), unfold(one)) + solid_angle(unfold(from), unfold(to), unfold(other));
}

}  // namespace

Vec2 to_octahedron(const Vec3& w) {
  const float scale = 1 / (std::fabs(w.x) + std::fabs(w.y) + std::fabs(w.z));
  const Vec2 p(w.x * scale, w.y * scale);
  if (w.z >= 0) return p;
  return {std::copysign(1 - std::fabs(p.y), w.x), std::copysign(1 - std::fabs(p.x), w.y)};
}

Vec3 from_octahedron(const Vec2& p) {
  const V3d w = unfold(V2d(double(p.x), double(p.y)));
  return Vec3(w / w.length());
}

Octahedron::Octahedron(int n) : size(n) {
  // Quarters of texels: the axes and the folds run along their sides and diagonals, whatever n is.
  const double side = 1 / double(n);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const V2d corner(2 * x * side - 1, 2 * y * side - 1);
      double angle = 0;
      for (const V2d& quarter : {V2d(0, 0), V2d(side, 0), V2d(0, side), V2d(side, side)})
        angle += solid_angle(corner + quarter, side);
      angles.push_back(float(angle));
      directions.push_back(from_octahedron({float(corner.x + side), float(corner.y + side)}));
    }
}

int Octahedron::texel(const Vec3& w) const {
  const Vec2 p = to_octahedron(w);
  const auto place = [&](float v) { return std::clamp(int((v + 1) * 0.5f * float(size)), 0, size - 1); };
  return place(p.y) * size + place(p.x);
}

}  // namespace bdpt
