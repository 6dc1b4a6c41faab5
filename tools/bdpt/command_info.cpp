// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "json.h"
#include "scene_upload.h"

namespace bdpt_tool {
namespace {

struct InfoOptions {
  std::string scene;
  ReadOptions read;
  bool json = false;
};

struct SceneFacts {
  std::size_t shapes = 0, textures = 0, materials = 0;
  std::uint32_t max_edges = 0;
  std::uint32_t samples_per_pixel = 0;  // 0 = not in the file
  bdpt_camera_desc camera = sized<bdpt_camera_desc>();
  bdpt_scene_info scene = sized<bdpt_scene_info>();
  std::size_t warnings = 0;
};

SceneFacts gather(const InfoOptions& options) {
  Diagnostics diagnostics;
  SceneDescription description = read_scene(options.scene, diagnostics, options.read);
  SceneFacts facts;
  facts.shapes = description.shapes.size();
  facts.textures = description.textures.size();
  facts.materials = description.materials.size();
  facts.max_edges = description.max_edges;
  facts.samples_per_pixel = description.samples_per_pixel.value_or(0);
  facts.camera = camera_desc(description, description.film.width, description.film.height, diagnostics);
  const Context context = make_context(0, diagnostics);
  const Scene scene = build_scene(context.get(), description);
  check(bdpt_scene_get_info(scene.get(), &facts.scene), "the scene");
  facts.warnings = diagnostics.count();
  return facts;
}

// What kind of camera it is, and how much it sees.
std::string seen_by(const bdpt_camera_desc& camera) {
  char text[64];
  switch (camera.type) {
    case BDPT_CAMERA_ORTHOGRAPHIC:
      std::snprintf(text, sizeof text, "orthographic, %.4g high", static_cast<double>(camera.field_height));
      break;
    case BDPT_CAMERA_EQUIRECTANGULAR:
      return "a panorama";
    case BDPT_CAMERA_LENS:
      std::snprintf(text, sizeof text, "through a lens of %u surfaces", camera.lens_surface_count);
      break;
    default:
      std::snprintf(text, sizeof text, "%.4g degrees high", static_cast<double>(camera.field_of_view));
  }
  return text;
}

void print_text(const SceneFacts& facts) {
  const bdpt_scene_info& scene = facts.scene;
  const auto mebibytes = [](std::uint64_t bytes) { return static_cast<double>(bytes) / (1024 * 1024); };
  std::printf("triangles   %llu, %llu without area dropped\n", static_cast<unsigned long long>(scene.triangles),
              static_cast<unsigned long long>(scene.degenerate_triangles));
  std::printf("spheres     %llu\n", static_cast<unsigned long long>(scene.spheres));
  std::printf("instances   %llu of %zu shapes\n", static_cast<unsigned long long>(scene.instances), facts.shapes);
  std::printf("materials   %zu, %zu textures\n", facts.materials, facts.textures);
  std::printf("lights      %u\n", scene.lights);
  std::printf("bounds      %g %g %g to %g %g %g\n", scene.bounds_min[0], scene.bounds_min[1], scene.bounds_min[2],
              scene.bounds_max[0], scene.bounds_max[1], scene.bounds_max[2]);
  std::printf("memory      %.1f MiB, %.1f MiB of it Embree's\n", mebibytes(scene.memory),
              mebibytes(scene.memory_embree));
  const bdpt_camera_desc& camera = facts.camera;
  std::printf("camera      %u x %u pixels, %s, at %g %g %g, towards %g %g %g", camera.width, camera.height,
              seen_by(camera).c_str(), camera.transform[3], camera.transform[7], camera.transform[11],
              -camera.transform[2], -camera.transform[6], -camera.transform[10]);
  if (camera.lens_radius > 0) std::printf(", lens radius %g, focus at %g", camera.lens_radius, camera.focus_distance);
  std::printf("\nin the file longest path %u edges, ", facts.max_edges);
  if (facts.samples_per_pixel > 0) {
    std::printf("%u samples per pixel\n", facts.samples_per_pixel);
  } else {
    std::printf("no samples per pixel\n");
  }
  std::printf("hash        %016llx\n", static_cast<unsigned long long>(scene.hash));
  std::printf("warnings    %zu\n", facts.warnings);
}

void print_json(const SceneFacts& facts) {
  const bdpt_scene_info& scene = facts.scene;
  JsonWriter json;
  json.value("triangles", scene.triangles);
  json.value("degenerate_triangles", scene.degenerate_triangles);
  json.value("spheres", scene.spheres);
  json.value("instances", scene.instances);
  json.value("shapes", facts.shapes);
  json.value("materials", facts.materials);
  json.value("textures", facts.textures);
  json.value("lights", scene.lights);
  json.array("bounds_min", scene.bounds_min);
  json.array("bounds_max", scene.bounds_max);
  json.value("memory", scene.memory);
  json.value("memory_embree", scene.memory_embree);
  json.open("camera");
  json.value("width", facts.camera.width);
  json.value("height", facts.camera.height);
  json.value("type", facts.camera.type);
  json.value("field_of_view", facts.camera.field_of_view);
  json.value("field_height", facts.camera.field_height);
  json.value("lens_surfaces", facts.camera.lens_surface_count);
  json.array("transform", facts.camera.transform);
  json.value("lens_radius", facts.camera.lens_radius);
  json.value("focus_distance", facts.camera.focus_distance);
  json.close();
  json.value("max_edges", facts.max_edges);
  json.value("samples_per_pixel", facts.samples_per_pixel);
  json.value("warnings", facts.warnings);
  std::fputs(std::move(json).finish().c_str(), stdout);
}

ExitCode info(const InfoOptions& options) {
  const SceneFacts facts = gather(options);
  options.json ? print_json(facts) : print_text(facts);
  return ExitCode::kSuccess;
}

}  // namespace

void add_info_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("info", "Tell what a scene holds");
  const auto options = std::make_shared<InfoOptions>();
  command->add_option("file", options->scene, "A scene file: pbrt-v4, glTF 2.0 (.gltf, .glb), OBJ or PLY")->required();
  add_read_options(*command, options->read);
  command->add_flag("--json", options->json, "Print one JSON object instead of text");
  command->callback([&chosen, options] { chosen = [options] { return info(*options); }; });
}

}  // namespace bdpt_tool
