// How far off a surface a ray starts so that rounding cannot make it hit that surface again.
//
// The traced plane of a triangle is wrong by a few ulps of its largest coordinate, wherever on it the ray starts: a
// large triangle is as wrong near the origin as at its corners. (A distance that follows the point's own coordinates,
// as in Waechter and Binder 2019, is too small there.) Being relative, it is right for scenes of any size.
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

inline constexpr float kMarginUlps = 16;  // measured: 4 suffice, 2 do not

// magnitude: the largest coordinate, by absolute value, that the surface's equation is made from.
inline float margin_of(float magnitude) { return kMarginUlps * 0x1p-23f * magnitude; }

inline float largest(const Vec3& a) { return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)}); }
inline float largest(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({largest(a), largest(b), largest(c)});
}
inline float margin_of_sphere(const Vec3& center, float radius) { return margin_of(largest(center) + radius); }

// The point p of a surface moved off it, to the side toward which w points.
inline Vec3 off_surface(const Vec3& p, const Vec3& ng, float margin, const Vec3& w) {
  return p + ng * (dot(ng, w) < 0 ? -margin : margin);
}

}  // namespace bdpt
