// A scene, built, and what it is seen by: all that a render needs but its options.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "error.h"
#include "handles.h"
#include "scene_description.h"
#include "setting.h"

namespace bdpt_experiments {

struct Stage {
  bdpt_tool::Context context;
  bdpt_tool::Scene scene;
  bdpt_tool::Sensor sensor;
  std::uint32_t width = 0, height = 0, threads = 1;
  float exposure = 0;  // stops, for pictures
  double build_seconds = 0;
};

// Thrown by an experiment whose scene is not there.
struct SceneMissing : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A scene of Bitterli's collection, grey where `grey`, for then colours cannot differ between renderers.
bdpt_tool::SceneDescription bitterli_scene(const Setting& setting, const std::string& name, bool grey = false);

// The picture has `width` columns and as many rows as the scene's own shape wants.
Stage build_stage(bdpt_tool::SceneDescription description, std::uint32_t width, const Setting& setting,
                  float exposure = 0);

// The same, measured by a lightmap of so many texels a side, of all meshes that have coordinates for one.
Stage build_lightmap(bdpt_tool::SceneDescription description, std::uint32_t side, const Setting& setting,
                     float exposure = 0);

}  // namespace bdpt_experiments
