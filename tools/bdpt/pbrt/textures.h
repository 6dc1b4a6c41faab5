// Textures of a pbrt scene: image maps, constants, and products of these. They are read when first used.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "pbrt/params.h"
#include "scene_description.h"

namespace bdpt_tool {

// What a texture comes to: one value everywhere, or a texture of the scene.
struct TextureValue {
  Rgb constant = {1, 1, 1};
  int texture = -1;
};

class TextureTable {
 public:
  TextureTable(SceneDescription& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  // `params.directive()` names it in errors; `kind` is "imagemap", "constant", ...; `folder` is that of relative paths.
  void define(const std::string& name, const std::string& kind, ParamList params, const std::string& folder);

  // `user` is the parameter that names the texture.
  TextureValue resolve(const std::string& name, const ParamList& user);

 private:
  struct Definition {
    std::string kind;
    ParamList params;
    std::string folder;
  };
  // The texels of an image, times gain, plus offset; or only the offset, without an image.
  struct Source {
    std::string path;
    Location where;
    std::string encoding;
    Rgb gain = {0, 0, 0}, offset = {0, 0, 0};
  };

  Source source_of(const std::string& name, const ParamList& user, int depth);
  Source operand(const ParamList& params, const std::string& name, int depth);
  Source image_source(const Definition& definition);
  int load(const Source& source);

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  bool warned_of_filter_ = false;
  std::map<std::string, Definition> definitions_;
  using SourceKey = std::tuple<std::string, std::string, Rgb, Rgb>;
  std::map<SourceKey, int> loaded_;
};

}  // namespace bdpt_tool
