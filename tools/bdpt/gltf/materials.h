// The materials of a document and their textures, added to the scene when first used.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "gltf/document.h"
#include "notes.h"
#include "scene_description.h"

namespace bdpt_tool::gltf {

class MaterialTable {
 public:
  MaterialTable(const Document& document, SceneDescription& scene, Notes& notes)
      : document_(document), scene_(scene), notes_(notes) {}

  // The scene's material for one of the document; -1 = the format's default one. `colored`: the mesh has colours.
  int use(int material, bool colored);

 private:
  MaterialDescription converted(int material, bool colored);
  void use_textures(MaterialDescription& material, const std::string& place);
  int texture(int texture, bool is_color);

  const Document& document_;
  SceneDescription& scene_;
  Notes& notes_;
  std::map<std::pair<int, bool>, int> materials_;  // by material, and whether colours multiply it
  std::map<std::pair<int, bool>, int> textures_;   // by texture, and whether its numbers are colours
};

}  // namespace bdpt_tool::gltf
