// What `bdpt bake` measures: a sensor for a scene, and what becomes of its film.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "bake_options.h"
#include "scene_description.h"

namespace bdpt_tool {

class BakeTarget {
 public:
  virtual ~BakeTarget() = default;
  // Before the scene is built, and its meshes move into the library.
  virtual void read(const SceneDescription&) {}
  virtual Sensor make_sensor(bdpt_context* context, bdpt_scene* scene, const SceneDescription& description) = 0;
  // `partial`: with the part of a pass that was interrupted.
  virtual void write(const bdpt_film* film, bool partial) = 0;
};

// For --what. They check what of the options concerns them; the options must outlive them.
std::unique_ptr<BakeTarget> lightmap_target(const BakeOptions& options);
std::unique_ptr<BakeTarget> points_target(const BakeOptions& options);

}  // namespace bdpt_tool
