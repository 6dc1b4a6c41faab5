// Textures of a pbrt scene: image maps, chequerboards, constants, and products of these. They are read when first used.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "pbrt/params.h"
#include "scene_description.h"
#include "scene_folder.h"

namespace bdpt_tool {

// Below this alpha pbrt treats a surface as smooth.
constexpr float kSmoothAlpha = 1e-3f;

// What a texture comes to: one value everywhere, or the texels of an image.
struct TextureValue {
  Rgb constant = {1, 1, 1};
  TextureUse use;

  bool is_image() const { return use.texture >= 0; }
};

class TextureTable {
 public:
  TextureTable(SceneDescription& scene, Diagnostics& diagnostics, const SceneFolder& folder)
      : scene_(scene), diagnostics_(diagnostics), folder_(folder) {}

  // `params.directive()` names it in errors; `kind` is "imagemap", "constant", ...; a texture of floats is the mean of
  // an image's channels.
  void define(const std::string& name, const std::string& kind, bool is_float, ParamList params);

  // `user` is the parameter list that names the texture.
  TextureValue resolve(const std::string& name, const ParamList& user);
  // A roughness: GGX's alpha, once it is remapped by the square root where that is asked for. Of an image the texels
  // are alphas.
  TextureValue resolve_alpha(const std::string& name, const ParamList& user, bool remap);
  // Of the texels that a use looks up.
  Rgb mean(const TextureUse& use) const;
  // A file of linear numbers, such as a map of normals.
  int linear_image(const std::string& file, const Location& where);

 private:
  // What becomes of a number once it is looked up.
  enum class Curve { kNone, kAlpha, kRemappedAlpha };
  struct Definition {
    std::string kind;
    bool is_float = false;
    ParamList params;
  };
  // The texels of an image, times gain, plus offset; or only the offset, without an image.
  struct Source {
    std::string path;  // of the image, or the name of a chequerboard
    Location where;
    float exponent = 0;
    Rgb gain = {0, 0, 0}, offset = {0, 0, 0};
    bool is_float = false, nearest = false;
    Curve curve = Curve::kNone;
    std::array<Wrap, 2> wrap = {Wrap::kRepeat, Wrap::kRepeat};
    TextureUse use;
    std::array<Rgb, 2> checks = {};  // of a chequerboard
    bool is_checkerboard = false;

    bool is_image() const { return !path.empty(); }
  };

  Source source_of(const std::string& name, const ParamList& user, int depth);
  Source operand(const ParamList& params, const std::string& name, int depth);
  Rgb constant_operand(const ParamList& params, const std::string& name, int depth);
  Source image_source(const Definition& definition);
  Source checkerboard(const std::string& name, const ParamList& params, int depth);
  void read_mapping(const ParamList& params, double size, TextureUse& use) const;
  AnyImage texels(const Source& source) const;
  int load(const Source& source);
  TextureValue value_of(const Source& source);

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  const SceneFolder& folder_;
  bool warned_of_filter_ = false;
  std::map<std::string, Definition> definitions_;
  using SourceKey = std::tuple<std::string, float, Rgb, Rgb, bool, bool, Curve, std::array<Wrap, 2>>;
  std::map<SourceKey, int> loaded_;
};

}  // namespace bdpt_tool
