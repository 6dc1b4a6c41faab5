// Triangle meshes and spheres as the builder keeps them: in object space, validated, shared by all scenes that use
// them.
#pragma once

#include "geometry/rgba.h"
#include "math/vec.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace bdpt {

// A strided array of T over memory that is the library's (owned) or the host's (borrowed).
template <class T>
class View {
 public:
  View() = default;
  View(const void* data, size_t count, size_t stride)
      : data_(static_cast<const std::byte*>(data)), count_(count), stride_(stride) {}
  T operator[](size_t i) const {
    if (stride_ == sizeof(T))
      return reinterpret_cast<const T*>(data_)[i];  // nearly always, and without a multiplication
    T value;
    std::memcpy(static_cast<void*>(&value), data_ + i * stride_, sizeof(T));
    return value;
  }
  size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  size_t stride() const { return stride_; }
  const void* data() const { return data_; }

 private:
  const std::byte* data_ = nullptr;
  size_t count_ = 0;
  size_t stride_ = sizeof(T);
};

struct Triangle {
  uint32_t a, b, c;
};

// Along u, and the sign of v: the third axis is sign * normal x direction.
struct Tangent {
  Vec3 direction;
  float sign;
};

// Whatever keeps a view's memory alive: a vector of our own, or the host's release callback.
using Keeper = std::shared_ptr<const void>;

struct Mesh {
  std::string label;
  View<Vec3> positions;
  View<Triangle> triangles;       // without the degenerate ones; always 32-bit
  View<Vec3> normals;             // empty = flat
  View<Vec2> uv[2];               // empty = absent
  View<Rgba> colors;              // empty = absent
  View<Tangent> tangents;         // empty = along u of the texture coordinates, triangle by triangle
  bool positions_padded = false;  // 16 readable bytes behind the last position: Embree may read the array itself
  uint64_t degenerate = 0;        // triangles that were dropped
  uint64_t memory = 0;            // bytes that are the library's own
  uint64_t content_hash = 0;
  std::vector<Keeper> keepers;

  // At barycentric coordinates of the second and third corner. Without uv set 0 a triangle's own corners are (0,0),
  // (1,0), (1,1).
  Vec2 uv_at(int set, uint32_t triangle, float u, float v) const {
    Vec2 corners[3];
    uv_corners(set, triangle, corners);
    return corners[0] * (1 - u - v) + corners[1] * u + corners[2] * v;
  }
  void uv_corners(int set, uint32_t triangle, Vec2 corners[3]) const;
  Rgba color(uint32_t triangle, float u, float v) const;
};

struct Sphere {
  std::string label;
  Vec3 center;
  float radius = 1;
};

struct Curves;

// A shape is one of the three.
struct Shape {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const Sphere> sphere;
  std::shared_ptr<const Curves> curves = nullptr;
};

// Texture coordinates of a sphere where its normal, in object space, is this (unit): u is the angle from x towards y,
// v grows towards z.
inline Vec2 uv_of_sphere(const Vec3& normal) {
  const float turn = std::atan2(normal.y, normal.x) / kTwoPi;
  return {turn < 0 ? turn + 1 : turn, 1 - std::acos(std::clamp(normal.z, -1.0f, 1.0f)) * kInvPi};
}

// Whether a triangle has no area.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace bdpt
