// SPDX-License-Identifier: Apache-2.0
#include "stage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>
#include <utility>

#include "scene_upload.h"

namespace bdpt_experiments {
namespace {

// What readers and library warn of is known of these scenes, and would hide the progress.
bdpt_tool::Diagnostics& silence() {
  static bdpt_tool::Diagnostics diagnostics(false);
  return diagnostics;
}

}  // namespace

bdpt_tool::SceneDescription bitterli_scene(const Setting& setting, const std::string& name, bool grey) {
  const auto folder = std::filesystem::path(setting.scenes) / name;
  auto path = folder / (grey ? "scene-v4-grey.pbrt" : "scene-v4-present-textures.pbrt");
  if (!grey && !std::filesystem::exists(path)) path = folder / "scene-v4.pbrt";
  if (!std::filesystem::exists(path)) throw SceneMissing(path.string() + " is not there");
  return bdpt_tool::read_scene(path.string(), silence());
}

namespace {

// All but the sensor.
Stage set_stage(bdpt_tool::SceneDescription& description, const Setting& setting, float exposure) {
  Stage stage;
  stage.exposure = exposure;
  stage.threads = setting.threads ? setting.threads : std::max(1u, std::thread::hardware_concurrency());
  stage.context = bdpt_tool::make_context(stage.threads, silence());
  const auto begin = std::chrono::steady_clock::now();
  stage.scene = bdpt_tool::build_scene(stage.context.get(), description);
  stage.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return stage;
}

}  // namespace

Stage build_stage(bdpt_tool::SceneDescription description, std::uint32_t width, const Setting& setting,
                  float exposure) {
  Stage stage = set_stage(description, setting, exposure);
  const double shape = double(description.film.height) / description.film.width;
  stage.width = width;
  stage.height = static_cast<std::uint32_t>(std::lround(width * shape));
  const bdpt_camera_desc camera = bdpt_tool::camera_desc(description, stage.width, stage.height, silence());
  stage.sensor = bdpt_tool::make<bdpt_tool::Sensor>("the camera", bdpt_camera_create, stage.context.get(), &camera);
  return stage;
}

Stage build_lightmap(bdpt_tool::SceneDescription description, std::uint32_t side, const Setting& setting,
                     float exposure) {
  std::vector<std::size_t> mapped;  // before the meshes move into the library
  for (std::size_t i = 0; i < description.instances.size(); ++i) {
    const auto& shape = description.shapes[static_cast<std::size_t>(description.instances[i].shape)];
    const auto* mesh = std::get_if<bdpt_tool::TriangleMesh>(&shape.geometry);
    if (mesh && !mesh->uv_lightmap.empty()) mapped.push_back(i);
  }
  Stage stage = set_stage(description, setting, exposure);
  stage.width = stage.height = side;
  std::vector<bdpt_lightmap_instance> instances;
  for (const std::size_t i : mapped) {
    instances.push_back(bdpt_tool::sized<bdpt_lightmap_instance>());
    instances.back().instance = description.instances[i].id;
  }
  auto desc = bdpt_tool::sized<bdpt_lightmap_desc>();
  desc.width = desc.height = side;
  desc.instances = instances.data();
  desc.instance_count = static_cast<std::uint32_t>(instances.size());
  stage.sensor = bdpt_tool::make<bdpt_tool::Sensor>("the lightmap", bdpt_lightmap_create, stage.scene.get(), &desc);
  return stage;
}

}  // namespace bdpt_experiments
