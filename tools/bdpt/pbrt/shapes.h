// Reads the shapes of a pbrt scene. A mesh file used several times is read once.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pbrt/params.h"
#include "scene_description.h"
#include "scene_folder.h"

namespace bdpt_tool {

class ShapeTable {
 public:
  ShapeTable(SceneDescription& scene, Diagnostics& diagnostics, const SceneFolder& folder)
      : scene_(scene), diagnostics_(diagnostics), folder_(folder) {}

  // Returns the shape's index. `turned` is ReverseOrientation; a sphere cannot be turned, the caller sees to that.
  // Those of files get their meshes from read_files().
  int add(const std::string& type, const ParamList& params, bool turned);
  void read_files();

 private:
  struct File {
    int shape;
    std::string path;
    Location from;  // the parameter that names it
    bool turned;
  };

  int add_sphere(const ParamList& params);
  int add_inline_mesh(const ParamList& params, bool turned);
  int add_ply(const ParamList& params, bool turned);
  int push(std::string label, const Location& where, TriangleMesh mesh);
  void repair(ShapeDescription& shape);

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  const SceneFolder& folder_;
  std::vector<File> files_;
  std::map<std::pair<std::string, bool>, int> shapes_of_files_;
  std::map<float, int> spheres_;
};

}  // namespace bdpt_tool
