// SPDX-License-Identifier: Apache-2.0
#include "scene_read.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "gltf/scene_reader.h"
#include "lowering.h"
#include "mesh_scene.h"
#include "pbrt/scene_reader.h"

namespace bdpt_tool {
namespace {

struct Format {
  const char* extension;
  SceneDescription (*read)(const std::string&, const ReadOptions&, Diagnostics&);
  bool has_scenes;
};

constexpr Format kFormats[] = {
    {".pbrt", read_pbrt_scene, false}, {".gltf", read_gltf_scene, true}, {".glb", read_gltf_scene, true},
    {".obj", read_obj_scene, false},   {".ply", read_ply_scene, false},
};

const Format& format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  if (extension == ".dae") throw Error(Location{path, 0}, "COLLADA is not read here; export glTF 2.0 instead");
  throw Error(Location{path, 0},
              "not a scene this program can read; it reads pbrt-v4 (*.pbrt), glTF 2.0 (*.gltf, *.glb), OBJ (*.obj) "
              "and PLY (*.ply)");
}

void replace_environment(const std::string& path, SceneDescription& scene) {
  std::erase_if(scene.lights, [](const LightDescription& light) { return light.type == BDPT_LIGHT_ENVIRONMENT; });
  LightDescription light;
  light.type = BDPT_LIGHT_ENVIRONMENT;
  light.where = {path, 0};
  light.value = {1, 1, 1};
  light.texture = static_cast<int>(scene.textures.size());
  scene.lights.push_back(std::move(light));
  scene.textures.push_back({.label = std::filesystem::path(path).filename().string(),
                            .where = {path, 0},
                            .image = to_linear(read_image(path)),
                            .exponent = 0,
                            .wrap = {Wrap::kRepeat, Wrap::kClamp},
                            .nearest = false});
}

}  // namespace

void add_read_options(CLI::App& command, ReadOptions& options) {
  command.add_option("--scene", options.scene, "Which scene of a glTF file: its name or number (default: the file's)");
  command.add_option("--folder", options.folder,
                     "Folder that the files a scene names must lie in (default: that of the scene)");
  command.add_option(
      "--environment", options.environment,
      "A picture of the world round the scene, by longitude and latitude, -z in its middle; it takes the "
      "place of the file's");
}

SceneDescription read_scene(const std::string& path, Diagnostics& diagnostics, const ReadOptions& options) {
  const Format& format = format_of(path);
  if (!options.scene.empty() && !format.has_scenes) {
    throw Error(ExitCode::kUsage, "--scene: only glTF files have several scenes");
  }
  SceneDescription scene = format.read(path, options, diagnostics);
  if (!options.environment.empty()) replace_environment(options.environment, scene);
  tell_what_is_lost(scene, diagnostics);
  return scene;
}

}  // namespace bdpt_tool
