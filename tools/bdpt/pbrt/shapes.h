// Reads the shapes of a pbrt scene. A mesh file used several times is read once.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include "pbrt/params.h"
#include "scene_description.h"
#include "scene_folder.h"

namespace bdpt_tool {

class ShapeTable {
 public:
  ShapeTable(SceneDescription& scene, Diagnostics& diagnostics, const SceneFolder& folder)
      : scene_(scene), diagnostics_(diagnostics), folder_(folder) {}

  // Returns the shape's index. `turned` is ReverseOrientation; a sphere cannot be turned, the caller sees to that.
  int add(const std::string& type, const ParamList& params, bool turned);

 private:
  int add_sphere(const ParamList& params);
  int add_inline_mesh(const ParamList& params, bool turned);
  int add_ply(const ParamList& params, bool turned);
  int push(std::string label, const Location& where, TriangleMesh mesh, bool turned);

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  const SceneFolder& folder_;
  std::map<std::pair<std::string, bool>, int> files_;
  std::map<float, int> spheres_;
};

}  // namespace bdpt_tool
