// glTF materials as the library's, converted when first used.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "gltf/document.h"
#include "gltf/notes.h"
#include "scene_description.h"

namespace bdpt_tool::gltf {

class MaterialTable {
 public:
  MaterialTable(const Document& document, SceneDescription& scene, Notes& notes)
      : document_(document), scene_(scene), notes_(notes), converted_(document.materials.size() + 1, -1) {}

  // The scene's material for one of the document; -1 = the format's default one.
  int use(int material);

 private:
  MaterialDescription convert(const Material& from, const std::string& where);
  void set_conductor(const Material& from, MaterialDescription& to);
  void set_dielectric(const Material& from, const std::string& where, MaterialDescription& to);
  void set_diffuse(const Material& from, const std::string& where, MaterialDescription& to);
  void set_emission(const Material& from, const std::string& where, MaterialDescription& to);
  void note_what_is_left_out(const Material& from, const std::string& where);

  ByteImage read_image(int texture) const;
  int reflectance_texture(int texture, const Rgb& factor);
  Rgb mean_of(int texture);

  const Document& document_;
  SceneDescription& scene_;
  Notes& notes_;
  std::vector<int> converted_;                    // the default material comes last
  std::map<std::tuple<int, Rgb>, int> textures_;  // by image and factor
  std::map<int, Rgb> means_;                      // by image
};

}  // namespace bdpt_tool::gltf
