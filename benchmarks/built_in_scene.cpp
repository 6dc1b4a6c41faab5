// SPDX-License-Identifier: Apache-2.0
#include "built_in_scene.h"

#include <array>
#include <utility>

namespace bdpt_benchmark {
namespace {

using bdpt_tool::Rgb;
using Point = std::array<float, 3>;

class Maker {
 public:
  bdpt_tool::SceneDescription finish() && { return std::move(scene_); }
  bdpt_tool::SceneDescription& scene() { return scene_; }

  int material(bdpt_material_type type, const Rgb& reflectance, const Rgb& emission = {}) {
    bdpt_tool::MaterialDescription material;
    material.type = type;
    material.reflectance = reflectance;
    material.emission = emission;
    scene_.materials.push_back(material);
    return static_cast<int>(scene_.materials.size()) - 1;
  }

  // The front is the side from which a, b, c, d turn counter-clockwise.
  void quad(const Point& a, const Point& b, const Point& c, const Point& d, int material) {
    bdpt_tool::TriangleMesh mesh;
    for (const Point& p : {a, b, c, d}) mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
    mesh.indices = {0, 1, 2, 0, 2, 3};
    add(std::move(mesh), material, {0, 0, 0});
  }

  void sphere(const Point& center, float radius, int material) {
    add(bdpt_tool::SphereShape{radius}, material, center);
  }

 private:
  template <class Geometry>
  void add(Geometry geometry, int material, const Point& at) {
    bdpt_tool::ShapeDescription shape;
    shape.geometry = std::move(geometry);
    scene_.shapes.push_back(std::move(shape));
    bdpt_tool::InstanceDescription instance;
    instance.shape = static_cast<int>(scene_.shapes.size()) - 1;
    instance.material = material;
    instance.transform = {1, 0, 0, at[0], 0, 1, 0, at[1], 0, 0, 1, at[2]};
    scene_.instances.push_back(instance);
  }

  bdpt_tool::SceneDescription scene_;
};

}  // namespace

bdpt_tool::SceneDescription built_in_scene() {
  Maker make;
  const int white = make.material(BDPT_MATERIAL_DIFFUSE, {0.73f, 0.73f, 0.73f});
  const int red = make.material(BDPT_MATERIAL_DIFFUSE, {0.63f, 0.06f, 0.05f});
  const int green = make.material(BDPT_MATERIAL_DIFFUSE, {0.14f, 0.45f, 0.09f});
  const int light = make.material(BDPT_MATERIAL_DIFFUSE, {0, 0, 0}, {17, 12, 4});
  const int mirror = make.material(BDPT_MATERIAL_MIRROR, {0.95f, 0.95f, 0.95f});
  const int glass = make.material(BDPT_MATERIAL_DIELECTRIC, {1, 1, 1});
  make.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, white);    // floor
  make.quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, white);    // ceiling
  make.quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, white);  // back
  make.quad({-1, 0, 1}, {-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, red);    // left
  make.quad({1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}, green);      // right
  make.quad({-0.25f, 1.98f, -0.25f}, {0.25f, 1.98f, -0.25f}, {0.25f, 1.98f, 0.25f}, {-0.25f, 1.98f, 0.25f}, light);
  make.sphere({-0.45f, 0.4f, -0.35f}, 0.4f, mirror);
  make.sphere({0.45f, 0.4f, 0.3f}, 0.4f, glass);

  bdpt_tool::SceneDescription& scene = make.scene();
  scene.path = "the built-in Cornell box";
  scene.camera.transform = {1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 6.8f};
  scene.camera.fov_short_axis = 19.5f;
  scene.film.width = scene.film.height = 1024;
  return std::move(make).finish();
}

}  // namespace bdpt_benchmark
