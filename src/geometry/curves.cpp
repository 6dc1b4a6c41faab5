#include "geometry/curves.h"

#include "geometry/margin.h"

namespace bdpt {
namespace {

ControlPoint sum(const ControlPoint& a, float wa, const ControlPoint& b, float wb) {
  return {a.p * wa + b.p * wb, a.radius * wa + b.radius * wb};
}
ControlPoint sum(const ControlPoint& a, float wa, const ControlPoint& b, float wb, const ControlPoint& c, float wc) {
  return {a.p * wa + b.p * wb + c.p * wc, a.radius * wa + b.radius * wb + c.radius * wc};
}

// Each of the spheres whose envelope a linear segment is touches it in a circle.
bool place_linear(const ControlPoint& a, const ControlPoint& b, const Vec3& found, CurvePlace& place) {
  const Vec3 axis = b.p - a.p;
  const float l2 = length_squared(axis), dr = b.radius - a.radius, g = l2 - dr * dr;
  const float u = g > 0 ? std::clamp((dot(found - a.p, axis) + a.radius * dr) / g, 0.0f, 1.0f) : dr > 0 ? 1.0f : 0.0f;
  const ControlPoint c = sum(a, 1 - u, b, u);
  const Vec3 n = found - c.p;
  const float n2 = length_squared(n);
  if (!(n2 > 0)) return false;
  place.normal = n * (1 / std::sqrt(n2));
  place.p = c.p + place.normal * c.radius;
  place.along = axis;
  // The distance of rays from the axis is a difference of squares of the length.
  const float largest = std::max(a.radius, b.radius), r = std::max(c.radius, 0.05f * largest), l = std::sqrt(l2);
  place.margin = margin_of(2 * (l + largest) + l2 / (4 * r));
  return true;
}

struct CubicAt {
  ControlPoint c;  // and derivatives
  Vec3 d, dd;
  float dr;
};

CubicAt evaluate(const ControlPoint b[4], float u) {
  const float v = 1 - u;
  const ControlPoint a0 = sum(b[0], v, b[1], u), a1 = sum(b[1], v, b[2], u), a2 = sum(b[2], v, b[3], u);
  const ControlPoint c0 = sum(a0, v, a1, u), c1 = sum(a1, v, a2, u);
  return {sum(c0, v, c1, u), (c1.p - c0.p) * 3, (a2.p - a1.p * 2 + a0.p) * 6, (c1.radius - c0.radius) * 3};
}

// Points at the distance r(u) from c(u), in the plane across c'(u).
bool place_cubic(const ControlPoint b[4], float u, const Vec3& found, CurvePlace& place) {
  constexpr int kSteps = 3;  // of Newton's method, from where the ray query ended
  CubicAt at = evaluate(b, u);
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 r = found - at.c.p;
    const float slope = length_squared(at.d) - dot(r, at.dd);
    if (!(slope > 0)) break;
    u = std::clamp(u + dot(r, at.d) / slope, 0.0f, 1.0f);
    at = evaluate(b, u);
  }
  const float d2 = length_squared(at.d);
  Vec3 r = found - at.c.p;
  if (d2 > 0) r -= at.d * (dot(r, at.d) / d2);
  const float r2 = length_squared(r);
  if (!(r2 > 0)) return false;
  r *= 1 / std::sqrt(r2);
  // The gradient of |x - c(u(x))| - r(u(x)), with u(x) by (x - c) c' = 0. Embree's own Ng leaves out the curvature c''.
  const float slope = d2 - at.c.radius * dot(r, at.dd);
  Vec3 n = slope > 0 ? r * slope - at.d * at.dr : r;
  n *= 1 / std::sqrt(length_squared(n));
  place.normal = n;
  place.p = at.c.p + r * at.c.radius;
  place.along = at.d;
  // The errors at which Embree ends Newton's method, some times over: measured.
  float extent = 0, largest = 0;
  for (int i = 0; i < 4; ++i) {
    extent = std::max(extent, length(b[i].p - b[0].p));
    largest = std::max(largest, b[i].radius);
  }
  const float speed = std::max(std::sqrt(d2), 0.01f * extent);
  place.margin = margin_of(16 * (extent + largest) * (2 + largest + (1 + largest) / speed));
  return true;
}

}  // namespace

void to_bezier(CurveBasis basis, ControlPoint p[4]) {
  const ControlPoint a = p[0], b = p[1], c = p[2], d = p[3];
  if (basis == CurveBasis::BSpline) {
    p[0] = sum(a, 1 / 6.0f, b, 2 / 3.0f, c, 1 / 6.0f);
    p[1] = sum(b, 2 / 3.0f, c, 1 / 3.0f);
    p[2] = sum(b, 1 / 3.0f, c, 2 / 3.0f);
    p[3] = sum(b, 1 / 6.0f, c, 2 / 3.0f, d, 1 / 6.0f);
  } else if (basis == CurveBasis::CatmullRom) {
    p[0] = b;
    p[1] = sum(a, -1 / 6.0f, b, 1, c, 1 / 6.0f);
    p[2] = sum(b, 1 / 6.0f, c, 1, d, -1 / 6.0f);
    p[3] = c;
  }
}

int Curves::bezier(uint32_t segment, ControlPoint b[4]) const {
  const ControlPoint* p = &points[segments[segment].first];
  const int n = basis == CurveBasis::Linear ? 2 : 4;
  std::copy(p, p + n, b);
  to_bezier(basis, b);
  return n;
}

bool Curves::place(uint32_t segment, float u, const Vec3& found, CurvePlace& place) const {
  ControlPoint b[4];
  bezier(segment, b);
  return basis == CurveBasis::Linear ? place_linear(b[0], b[1], found, place) : place_cubic(b, u, found, place);
}

Box Curves::bounds() const {
  Box box;
  for (uint32_t i = 0; i < segments.size(); ++i) {
    ControlPoint b[4];
    const int n = bezier(i, b);
    for (int k = 0; k < n; ++k) box.grow(b[k].p, std::fabs(b[k].radius));
  }
  return box;
}

Transform in_unit(const Transform& transform, float unit) {
  Transform t = transform;
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < 3; ++i) t.m[4 * row + i] *= unit;
  return t;
}

}  // namespace bdpt
