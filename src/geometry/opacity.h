// How much of a surface is there: rays pass where it is not, as if there were no surface.
//
// Decided while rays look for what they hit, for shadow rays, too. A surface that is there in part is there or not for
// each ray, by a hash of the ray and the primitive: whatever the order in which the ray finds its hits.
#pragma once

#include "geometry/curves.h"
#include "geometry/mesh.h"
#include "geometry/texture.h"
#include "math/transform.h"

namespace bdpt {

// From a mesh's texture coordinates to a texture's.
struct UvMap {
  uint8_t set = 0;
  float m[6] = {1, 0, 0, 0, 1, 0};  // rows: u' = m0 u + m1 v + m2, v' = m3 u + m4 v + m5
  Vec2 operator()(const Vec2& uv) const { return {m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]}; }
};

struct Opacity {
  enum class Mode : uint8_t {
    Opaque,
    Mask,   // there where opacity is at least the cutoff
    Blend,  // there with the probability of opacity
  };
  Mode mode = Mode::Opaque;
  uint8_t channel = 3;  // of the texture
  float value = 1;      // times the texture, and the alpha of the mesh's colours
  float cutoff = 0.5f;
  int texture = -1;  // index into SceneDesc::textures
  UvMap uv;
  TextureSampler sampler;
};

// The same for one instance; all that a ray's query needs.
struct OpacityTest {
  Opacity opacity;
  const Texture* texture = nullptr;
  const Mesh* mesh = nullptr;      // or
  const Curves* curves = nullptr;  // or a sphere
  Transform transform, end;        // object to world, at time 0 and 1

  // At barycentric coordinates u and v of a triangle, at u of a curve's segment, or where a sphere has the normal ng,
  // of any length, in the world. chance: uniform in [0,1).
  bool is_there(uint32_t primitive, float u, float v, const Vec3& ng, float time, float chance) const {
    float value = opacity.value;
    if (mesh && !mesh->colors.empty()) value *= mesh->color(primitive, u, v)[3];
    if (texture) {
      const Vec2 uv = mesh     ? mesh->uv_at(opacity.uv.set, primitive, u, v)
                      : curves ? Vec2(curves->along(primitive, u), 0)
                               : uv_of_sphere(unit(between(transform, end, time).transposed(ng)));
      value *= texture->lookup(opacity.uv(uv), opacity.sampler)[opacity.channel];
    }
    return opacity.mode == Opacity::Mode::Mask ? value >= opacity.cutoff : chance < value;
  }
};

}  // namespace bdpt
