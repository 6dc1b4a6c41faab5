// SPDX-License-Identifier: Apache-2.0
#include "scene_maker.h"

#include <cmath>
#include <numbers>

namespace bdpt_benchmark {
namespace {

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point unit(const Point& a) {
  const float length = std::hypot(a[0], a[1], a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

}  // namespace

int SceneMaker::material(const bdpt_tool::MaterialDescription& material) {
  scene_.materials.push_back(material);
  return static_cast<int>(scene_.materials.size()) - 1;
}

int SceneMaker::material(bdpt_material_type type, const Rgb& reflectance, const Rgb& emission) {
  bdpt_tool::MaterialDescription description;
  description.type = type;
  description.reflectance = reflectance;
  description.emission = emission;
  return material(description);
}

int SceneMaker::metal(const Rgb& eta, const Rgb& k, float roughness) {
  bdpt_tool::MaterialDescription description;
  description.type = BDPT_MATERIAL_CONDUCTOR;
  description.eta = eta;
  description.k = k;
  description.roughness = {roughness, roughness};
  return material(description);
}

template <class Geometry>
void SceneMaker::add(Geometry geometry, int material, const Point& at) {
  bdpt_tool::ShapeDescription shape;
  shape.geometry = std::move(geometry);
  scene_.shapes.push_back(std::move(shape));
  bdpt_tool::InstanceDescription instance;
  instance.shape = static_cast<int>(scene_.shapes.size()) - 1;
  instance.material = material;
  instance.transform = {1, 0, 0, at[0], 0, 1, 0, at[1], 0, 0, 1, at[2]};
  scene_.instances.push_back(instance);
}

void SceneMaker::quad(const Point& a, const Point& b, const Point& c, const Point& d, int material) {
  bdpt_tool::TriangleMesh mesh;
  for (const Point& p : {a, b, c, d}) mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
  mesh.indices = {0, 1, 2, 0, 2, 3};
  add(std::move(mesh), material, {0, 0, 0});
}

void SceneMaker::mapped_quad(const Point& a, const Point& b, const Point& c, const Point& d, int material) {
  quad(a, b, c, d, material);
  std::get<bdpt_tool::TriangleMesh>(scene_.shapes.back().geometry).uv_lightmap = {0, 0, 1, 0, 1, 1, 0, 1};
}

void SceneMaker::box(const Point& low, const Point& high, int material, bool inward) {
  bdpt_tool::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis) mesh.positions.push_back((i >> axis & 1 ? high : low)[axis]);
  // Corner i has bit 0 for x, bit 1 for y, bit 2 for z.
  const std::uint32_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : sides) mesh.indices.insert(mesh.indices.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
  if (inward) turn_over(mesh);
  add(std::move(mesh), material, {0, 0, 0});
}

void SceneMaker::turned_box(const Point& middle, const Point& half, float degrees, int material) {
  box({-half[0], -half[1], -half[2]}, half, material);
  const float angle = degrees * std::numbers::pi_v<float> / 180, c = std::cos(angle), s = std::sin(angle);
  scene_.instances.back().transform = {c, 0, s, middle[0], 0, 1, 0, middle[1], -s, 0, c, middle[2]};
}

void SceneMaker::sphere(const Point& center, float radius, int material) {
  add(bdpt_tool::SphereShape{radius}, material, center);
}

void SceneMaker::mesh(bdpt_tool::TriangleMesh mesh, int material) { add(std::move(mesh), material, {0, 0, 0}); }

void SceneMaker::point(const Point& position, const Rgb& intensity) {
  bdpt_tool::LightDescription light;
  light.position = position;
  light.value = intensity;
  scene_.lights.push_back(light);
}

void SceneMaker::spot(const Point& position, const Point& direction, const Rgb& intensity, float cone_angle) {
  point(position, intensity);
  bdpt_tool::LightDescription& light = scene_.lights.back();
  light.type = BDPT_LIGHT_SPOT;
  light.direction = direction;
  light.cone_angle = cone_angle;
  light.cone_falloff = cone_angle / 10;
}

void SceneMaker::camera(const Point& from, const Point& to, float fov_short_axis) {
  const Point back = unit(minus(from, to)), right = unit(cross({0, 1, 0}, back)), up = cross(back, right);
  scene_.camera.transform = {right[0], up[0],   back[0],  from[0], right[1], up[1],
                             back[1],  from[1], right[2], up[2],   back[2],  from[2]};
  scene_.camera.fov_short_axis = fov_short_axis;
}

void SceneMaker::image(std::uint32_t width, std::uint32_t height) {
  scene_.film.width = width;
  scene_.film.height = height;
}

bdpt_tool::SceneDescription SceneMaker::finish(const char* name) && {
  scene_.path = name;
  return std::move(scene_);
}

}  // namespace bdpt_benchmark
