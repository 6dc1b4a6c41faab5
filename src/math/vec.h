// Vectors, colours and frames on Imath.
#pragma once

#include <Imath/ImathVec.h>

#include <algorithm>
#include <cmath>

namespace bdpt {

using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;
inline constexpr float kTwoPi = 6.28318530717958647693f;

inline float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float absdot(const Vec3& a, const Vec3& b) { return std::fabs(dot(a, b)); }
inline Vec3 cross(const Vec3& a, const Vec3& b) { return a.cross(b); }
inline float length_squared(const Vec3& a) { return dot(a, a); }
inline float length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 unit(const Vec3& a) { return a * (1.0f / std::sqrt(dot(a, a))); }
inline float sqr(float x) { return x * x; }
// std::sqrt that takes the small negatives of rounding for zero.
inline float safe_sqrt(float x) { return std::sqrt(std::max(0.0f, x)); }

// Linear RGB. A type of its own, so that a colour is never taken for a direction.
struct Rgb {
  float r = 0, g = 0, b = 0;
  Rgb() = default;
  explicit Rgb(float v) : r(v), g(v), b(v) {}
  Rgb(float r_, float g_, float b_) : r(r_), g(g_), b(b_) {}
  Rgb& operator+=(const Rgb& o) {
    r += o.r, g += o.g, b += o.b;
    return *this;
  }
  Rgb& operator*=(const Rgb& o) {
    r *= o.r, g *= o.g, b *= o.b;
    return *this;
  }
  Rgb& operator*=(float v) {
    r *= v, g *= v, b *= v;
    return *this;
  }
};
inline Rgb operator+(Rgb a, const Rgb& b) { return a += b; }
inline Rgb operator-(const Rgb& a, const Rgb& b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
inline Rgb operator*(Rgb a, const Rgb& b) { return a *= b; }
inline Rgb operator*(Rgb a, float v) { return a *= v; }
inline Rgb operator*(float v, Rgb a) { return a *= v; }
inline bool is_black(const Rgb& a) { return a.r == 0 && a.g == 0 && a.b == 0; }
inline bool is_finite(const Rgb& a) { return std::isfinite(a.r + a.g + a.b); }

// The one norm by which colour enters scalar decisions (roulette, choice of lights): the largest channel.
inline float norm(const Rgb& a) { return std::max(a.r, std::max(a.g, a.b)); }

// An orthonormal frame round n, after Duff et al. (2017); local z is n.
struct Frame {
  Vec3 t, b, n;
  Frame() = default;
  explicit Frame(const Vec3& normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float c = n.x * n.y * a;
    t = Vec3(1.0f + sign * n.x * n.x * a, sign * c, -sign * n.x);
    b = Vec3(c, sign + n.y * n.y * a, -n.y);
  }
  // With its first axis along the part of tangent that is orthogonal to normal; any where there is none.
  Frame(const Vec3& normal, const Vec3& tangent) : n(normal) {
    const Vec3 v = tangent - n * dot(n, tangent);
    const float l2 = length_squared(v);
    if (l2 < 1e-12f * length_squared(tangent) || !(l2 > 0)) {
      *this = Frame(normal);
      return;
    }
    t = v * (1.0f / std::sqrt(l2));
    b = cross(n, t);
  }
  Vec3 to_local(const Vec3& v) const { return {dot(v, t), dot(v, b), dot(v, n)}; }
  Vec3 to_world(const Vec3& v) const { return t * v.x + b * v.y + n * v.z; }
};

}  // namespace bdpt
