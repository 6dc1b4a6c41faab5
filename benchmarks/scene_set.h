// The scenes that are measured.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/memory.h"
#include "error.h"
#include "handles.h"
#include "scene/scene.h"
#include "scene_description.h"
#include "sensor/sensor.h"

namespace bdpt_benchmark {

struct SceneFile {
  std::string name;
  std::string path;  // empty = the scene that needs no file
};

// The scenes found in a folder, in the order of the table; the built-in one alone where there are none.
std::vector<SceneFile> find_scenes(const std::string& folder);

// A scene as the host's handles and, behind them, as the library's own objects.
struct LoadedScene {
  std::string name;
  bdpt_tool::Context context;
  bdpt_tool::Scene scene_handle;
  bdpt_tool::Sensor sensor_handle;
  std::shared_ptr<const bdpt::Scene> scene;
  std::shared_ptr<const bdpt::Sensor> sensor;
  std::shared_ptr<bdpt::MemoryMeter> meter;
  std::uint64_t borrowed_bytes = 0;  // arrays of the scene that stay the reader's

  // All arrays of the scene, whoever owns them, without what Embree made of them.
  std::uint64_t array_bytes() const { return scene->info().memory - scene->info().memory_embree + borrowed_bytes; }
};

// The image is `width` pixels wide, and as high as the scene wants. before_build, called between reading and building,
// tells the reader's memory from the library's. diagnostics must outlive the scene.
LoadedScene load_scene(const SceneFile& file, std::uint32_t width, std::uint32_t threads,
                       bdpt_tool::Diagnostics& diagnostics, const std::function<void()>& before_build = {});
LoadedScene build_loaded(bdpt_tool::SceneDescription description, std::uint32_t width, std::uint32_t threads,
                         bdpt_tool::Diagnostics& diagnostics);

}  // namespace bdpt_benchmark
