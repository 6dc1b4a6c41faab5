// A mesh instance as the work on lightmaps sees it: in world space, and in texels of its atlas (math/uv_raster.h).
#pragma once

#include "math/uv_raster.h"

#include <array>
#include <cstdint>
#include <vector>

namespace bdpt {

using Vec3d = Imath::V3d;

struct UvMesh {
  std::vector<Vec3d> positions;                    // world
  std::vector<Vec3d> normals;                      // world, of unit length; empty = flat
  std::vector<Vec2d> texels;                       // one for each position
  std::vector<std::array<uint32_t, 3>> triangles;  // indices of the above
  Vec2d rect_low, rect_high;                       // texels: corners of the instance's rectangle in the atlas
  double handedness = 1;                           // -1 where the instance is a reflection of its mesh
  uint32_t atlas = 0;

  UvTriangle uv(size_t triangle) const {
    const auto& t = triangles[triangle];
    return {texels[t[0]], texels[t[1]], texels[t[2]]};
  }
  // Of length twice the area; points to the front.
  Vec3d area_vector(size_t triangle) const {
    const auto& t = triangles[triangle];
    return (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]) * handedness;
  }
  double world_area(size_t triangle) const { return 0.5 * area_vector(triangle).length(); }
};

// Points nearer than this, in texels, are the same: what rounding does to texture coordinates in large atlases.
inline constexpr double kTexelTolerance = 1e-3;
// A triangle smaller than this, in texels, has no area.
inline constexpr double kNoTexelArea = kTexelTolerance * kTexelTolerance;

inline bool has_no_uv_area(const UvMesh& mesh, size_t triangle) { return !(area(mesh.uv(triangle)) >= kNoTexelArea); }

// By the angle at its first corner, as the scene sees it.
inline bool has_no_world_area(const UvMesh& mesh, size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const Vec3d e1 = mesh.positions[t[1]] - mesh.positions[t[0]], e2 = mesh.positions[t[2]] - mesh.positions[t[0]];
  const double limit = 1e-24 * e1.length2() * e2.length2();
  return !(mesh.area_vector(triangle).length2() > limit);
}

}  // namespace bdpt
