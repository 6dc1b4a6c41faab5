// SPDX-License-Identifier: Apache-2.0
#include "scene_set.h"

#include <cmath>
#include <filesystem>
#include <variant>

#include "api/handles.h"
#include "built_in_scene.h"
#include "scene_upload.h"

namespace bdpt_benchmark {
namespace {

std::uint64_t mesh_bytes(const bdpt_tool::SceneDescription& description) {
  std::uint64_t bytes = 0;
  for (const auto& shape : description.shapes) {
    const auto* mesh = std::get_if<bdpt_tool::TriangleMesh>(&shape.geometry);
    if (!mesh) continue;
    bytes += sizeof(float) * (mesh->positions.size() + mesh->normals.size() + mesh->uv.size());
    bytes += sizeof(std::uint32_t) * mesh->indices.size();
  }
  return bytes;
}

}  // namespace

std::vector<SceneFile> find_scenes(const std::string& folder) {
  std::vector<SceneFile> found;
  for (const char* name : {"veach-bidir", "veach-ajar", "cornell-box", "veach-mis", "water-caustic"}) {
    const auto path = std::filesystem::path(folder) / name / "scene-v4-grey.pbrt";
    if (std::filesystem::exists(path)) found.push_back({name, path.string()});
  }
  if (found.empty()) found.push_back({"built-in", ""});
  return found;
}

LoadedScene build_loaded(bdpt_tool::SceneDescription description, std::uint32_t width, std::uint32_t threads,
                         bdpt_tool::Diagnostics& diagnostics) {
  LoadedScene loaded;
  loaded.borrowed_bytes = mesh_bytes(description);
  loaded.context = bdpt_tool::make_context(threads, diagnostics);
  loaded.scene_handle = bdpt_tool::build_scene(loaded.context.get(), description);
  const double shape = double(description.film.height) / description.film.width;
  const auto height = static_cast<std::uint32_t>(std::lround(width * shape));
  const bdpt_camera_desc camera = bdpt_tool::camera_desc(description, width, height, diagnostics);
  loaded.sensor_handle =
      bdpt_tool::make<bdpt_tool::Sensor>("the camera", bdpt_camera_create, loaded.context.get(), &camera);
  loaded.scene = loaded.scene_handle->scene;
  loaded.sensor = loaded.sensor_handle->sensor;
  loaded.meter = loaded.context->meter;
  return loaded;
}

LoadedScene load_scene(const SceneFile& file, std::uint32_t width, std::uint32_t threads,
                       bdpt_tool::Diagnostics& diagnostics, const std::function<void()>& before_build) {
  auto description = file.path.empty() ? built_in_scene() : bdpt_tool::read_scene(file.path, diagnostics);
  if (before_build) before_build();
  LoadedScene loaded = build_loaded(std::move(description), width, threads, diagnostics);
  loaded.name = file.name;
  return loaded;
}

}  // namespace bdpt_benchmark
