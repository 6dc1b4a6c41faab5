// SPDX-License-Identifier: Apache-2.0
#include "default_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "transform.h"

namespace bdpt_tool {
namespace {

constexpr double kFieldOfView = 45;
constexpr Vec3 kTowardsCamera = {0.35, 0.25, 1};

struct Bounds {
  Vec3 low, high;

  Bounds() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const Vec3& p) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  bool empty() const { return low[0] > high[0]; }
};

Bounds bounds_of(const ShapeDescription& shape) {
  Bounds bounds;
  if (const auto* sphere = std::get_if<SphereShape>(&shape.geometry)) {
    const auto r = static_cast<double>(sphere->radius);
    bounds.add({-r, -r, -r});
    bounds.add({r, r, r});
    return bounds;
  }
  const auto& mesh = std::get<TriangleMesh>(shape.geometry);
  for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
    bounds.add({mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]});
  }
  return bounds;
}

Bounds bounds_of(const SceneDescription& scene) {
  std::vector<Bounds> shapes;
  for (const ShapeDescription& shape : scene.shapes) shapes.push_back(bounds_of(shape));
  Bounds bounds;
  for (const InstanceDescription& instance : scene.instances) {
    Transform to_world;
    for (int i = 0; i < 12; ++i) to_world.m[i / 4][i % 4] = instance.transform[static_cast<std::size_t>(i)];
    const Bounds& box = shapes[static_cast<std::size_t>(instance.shape)];
    for (int corner = 0; corner < 8; ++corner) {
      bounds.add(to_world.point({corner & 1 ? box.high[0] : box.low[0], corner & 2 ? box.high[1] : box.low[1],
                                 corner & 4 ? box.high[2] : box.low[2]}));
    }
  }
  return bounds;
}

}  // namespace

CameraDescription framing_camera(const SceneDescription& scene) {
  CameraDescription camera;
  camera.fov_short_axis = static_cast<float>(kFieldOfView);
  const Bounds bounds = bounds_of(scene);
  if (bounds.empty()) return camera;
  Vec3 center, half;
  for (std::size_t i = 0; i < 3; ++i) {
    center[i] = (bounds.low[i] + bounds.high[i]) / 2;
    half[i] = (bounds.high[i] - bounds.low[i]) / 2;
  }
  const double distance = length(half) / std::sin(kFieldOfView * std::numbers::pi / 360);
  const Vec3 z = normalized(kTowardsCamera);  // the camera looks along its own -z
  const Vec3 x = normalized(cross({0, 1, 0}, z));
  const Vec3 y = cross(z, x);
  Transform to_world;
  for (std::size_t i = 0; i < 3; ++i) {
    to_world.m[i][0] = x[i];
    to_world.m[i][1] = y[i];
    to_world.m[i][2] = z[i];
    to_world.m[i][3] = center[i] + distance * z[i];
  }
  camera.transform = to_world.rows();
  return camera;
}

bool is_dark(const SceneDescription& scene) {
  bool wants_light = false;
  for (const InstanceDescription& instance : scene.instances) {
    const MaterialDescription& material = scene.materials[static_cast<std::size_t>(instance.material)];
    if (material.emits() && !material.unlit) return false;
    wants_light = wants_light || !material.unlit;
  }
  return wants_light && scene.lights.empty();
}

LightDescription white_environment() {
  LightDescription light;
  light.type = BDPT_LIGHT_ENVIRONMENT;
  light.value = {1, 1, 1};
  return light;
}

void complete(SceneDescription& scene, bool has_camera, Notes& notes) {
  if (!has_camera) {
    scene.camera = framing_camera(scene);
    notes.add("there is no camera; one that sees all of the scene is used");
  }
  if (is_dark(scene)) {
    scene.lights.push_back(white_environment());
    notes.add("there is no light; an environment of radiance 1 is used");
  }
  scene.camera.where = {scene.path, 0};
}

}  // namespace bdpt_tool
