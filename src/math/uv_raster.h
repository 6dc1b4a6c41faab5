// Conservative rasterisation in texture space: every texel that shares area with a triangle, and the exact polygon they
// share.
//
// Texel (x, y) is the square [x, x+1] x [y, y+1]; row 0 is the top of the image, where v = 1.
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace bdpt {

using Vec2d = Imath::V2d;

// From texture coordinates to texels.
inline Vec2d to_texels(const Vec2d& uv, uint32_t width, uint32_t height) { return {uv.x * width, (1 - uv.y) * height}; }
inline Vec2d to_uv(const Vec2d& texels, uint32_t width, uint32_t height) {
  return {texels.x / width, 1 - texels.y / height};
}

// Texels [x0, x1) x [y0, y1).
struct TexelRect {
  int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

using UvTriangle = std::array<Vec2d, 3>;

// Twice the area of a triangle; positive where a, b, c turn from x towards y.
inline double signed_double_area(const Vec2d& a, const Vec2d& b, const Vec2d& c) { return (b - a).cross(c - a); }
inline double area(const UvTriangle& t) { return 0.5 * std::fabs(signed_double_area(t[0], t[1], t[2])); }

// A triangle cut by the four sides of a texel: convex, its corners in the triangle's order.
struct TexelPolygon {
  static constexpr int kMaxCorners = 7;
  Vec2d corners[kMaxCorners];
  int count = 0;

  TexelPolygon() = default;
  explicit TexelPolygon(const UvTriangle& triangle) : count(3) { std::copy(triangle.begin(), triangle.end(), corners); }
  double area() const {
    double twice = 0;
    for (int i = 2; i < count; ++i) twice += signed_double_area(corners[0], corners[i - 1], corners[i]);
    return 0.5 * std::fabs(twice);
  }
  // The least or greatest coordinate along an axis.
  double low(int axis) const {
    double v = corners[0][axis];
    for (int i = 1; i < count; ++i) v = std::min(v, corners[i][axis]);
    return v;
  }
  double high(int axis) const {
    double v = corners[0][axis];
    for (int i = 1; i < count; ++i) v = std::max(v, corners[i][axis]);
    return v;
  }
};

namespace uv_raster {

// Where the segment ab meets the line on which `axis` is c. The same point to the bit from either end, and never
// outside the box round the segment: a polygon stays convex along both axes, so that each line is crossed twice at
// most.
inline Vec2d cross_line(const Vec2d& a, const Vec2d& b, int axis, double c) {
  const Vec2d &low = a[axis] < b[axis] ? a : b, &high = a[axis] < b[axis] ? b : a;
  const int other = 1 - axis;
  const double t = (c - low[axis]) / (high[axis] - low[axis]);
  const auto [least, greatest] = std::minmax(a[other], b[other]);
  Vec2d point;
  point[axis] = c;
  point[other] = std::clamp(low[other] + t * (high[other] - low[other]), least, greatest);
  return point;
}

// The part of a polygon on one side of a line (Sutherland and Hodgman 1974): axis >= c for side = 1, <= c for -1.
inline TexelPolygon clip(const TexelPolygon& polygon, int axis, double c, double side) {
  TexelPolygon result;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec2d &p = polygon.corners[i], &next = polygon.corners[i + 1 == polygon.count ? 0 : i + 1];
    const double here = side * (p[axis] - c), there = side * (next[axis] - c);
    if (here >= 0) result.corners[result.count++] = p;
    if ((here > 0 && there < 0) || (here < 0 && there > 0))
      result.corners[result.count++] = cross_line(p, next, axis, c);
  }
  return result;
}

inline TexelPolygon clip_to_band(const TexelPolygon& polygon, int axis, int64_t index) {
  return clip(clip(polygon, axis, double(index), 1), axis, double(index + 1), -1);
}

// The texels [first, last) that a polygon can share area with along an axis, within [low, high).
struct Span {
  int64_t first, last;
};
inline Span span(const TexelPolygon& polygon, int axis, int64_t low, int64_t high) {
  if (polygon.count < 3) return {0, 0};
  const auto bounded = [&](double v) { return int64_t(std::clamp(v, double(low), double(high))); };
  return {bounded(std::floor(polygon.low(axis))), bounded(std::ceil(polygon.high(axis)))};
}

}  // namespace uv_raster

// What a texel shares with a triangle.
inline TexelPolygon part_in_texel(const UvTriangle& triangle, int64_t x, int64_t y) {
  return uv_raster::clip_to_band(uv_raster::clip_to_band(TexelPolygon(triangle), 1, y), 0, x);
}

// Calls visit(x, y, polygon) for each texel of bounds that shares area with the triangle (in texels, finite), row by
// row. A triangle without area shares none.
template <class Visit>
void rasterize(const UvTriangle& triangle, const TexelRect& bounds, Visit&& visit) {
  const TexelPolygon whole(triangle);
  const uv_raster::Span rows = uv_raster::span(whole, 1, bounds.y0, bounds.y1);
  for (int64_t y = rows.first; y < rows.last; ++y) {
    const TexelPolygon row = uv_raster::clip_to_band(whole, 1, y);
    const uv_raster::Span columns = uv_raster::span(row, 0, bounds.x0, bounds.x1);
    for (int64_t x = columns.first; x < columns.last; ++x) {
      const TexelPolygon polygon = uv_raster::clip_to_band(row, 0, x);
      if (polygon.count >= 3 && polygon.area() > 0) visit(x, y, polygon);
    }
  }
}

}  // namespace bdpt
