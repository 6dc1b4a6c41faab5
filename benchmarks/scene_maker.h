// Scenes built in code, as the readers of scene files would leave them.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "scene_description.h"

namespace bdpt_benchmark {

using bdpt_tool::Rgb;
using Point = std::array<float, 3>;

class SceneMaker {
 public:
  // Each adds a material and returns its number. The front alone emits.
  int diffuse(const Rgb& reflectance) { return material(BDPT_MATERIAL_DIFFUSE, reflectance); }
  int emitter(const Rgb& radiance) { return material(BDPT_MATERIAL_DIFFUSE, {0, 0, 0}, radiance); }
  int mirror(float reflectance = 0.95f) {
    return material(BDPT_MATERIAL_MIRROR, {reflectance, reflectance, reflectance});
  }
  int glass() { return material(BDPT_MATERIAL_DIELECTRIC, {1, 1, 1}); }
  int metal(const Rgb& eta, const Rgb& k, float roughness);

  // The front is the side from which a, b, c, d turn counter-clockwise.
  void quad(const Point& a, const Point& b, const Point& c, const Point& d, int material);
  // The same with a lightmap all of whose texels lie on it.
  void mapped_quad(const Point& a, const Point& b, const Point& c, const Point& d, int material);
  // Closed, its fronts outward or inward.
  void box(const Point& low, const Point& high, int material, bool inward = false);
  // A box turned about the vertical through its middle.
  void turned_box(const Point& middle, const Point& half, float degrees, int material);
  void sphere(const Point& center, float radius, int material);
  void mesh(bdpt_tool::TriangleMesh mesh, int material);
  // Shines along `direction` into a cone of so many degrees, with an edge of a tenth of it.
  void spot(const Point& position, const Point& direction, const Rgb& intensity, float cone_angle);
  void point(const Point& position, const Rgb& intensity);

  // Level unless from and to say otherwise; vertical where the image is square.
  void camera(const Point& from, const Point& to, float fov_short_axis);
  void image(std::uint32_t width, std::uint32_t height);

  bdpt_tool::SceneDescription finish(const char* name) &&;

 private:
  int material(bdpt_material_type type, const Rgb& reflectance, const Rgb& emission = {});
  int material(const bdpt_tool::MaterialDescription& material);
  template <class Geometry>
  void add(Geometry geometry, int material, const Point& at);

  bdpt_tool::SceneDescription scene_;
};

}  // namespace bdpt_benchmark
