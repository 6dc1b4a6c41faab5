// SPDX-License-Identifier: Apache-2.0
#include "pbrt/textures.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace bdpt_tool {
namespace {

constexpr int kMaxDepth = 16;

// "sRGB" 0, "linear" 1, "gamma 2.2" 2.2; negative if it is none of these.
float exponent_of(const std::string& encoding) {
  if (encoding == "sRGB") return 0;
  if (encoding == "linear") return 1;
  if (!encoding.starts_with("gamma ")) return -1;
  float exponent = -1;
  std::from_chars(encoding.data() + 6, encoding.data() + encoding.size(), exponent);
  return exponent > 0 && std::isfinite(exponent) ? exponent : -1;
}

float decode(std::uint8_t byte, float exponent) {
  const float x = static_cast<float>(byte) / 255.0f;
  return exponent == 0 ? srgb_to_linear(x) : std::pow(x, exponent);
}

Image to_linear(const ByteImage& bytes, const std::string& encoding) {
  float table[256];
  for (int i = 0; i < 256; ++i) table[i] = decode(static_cast<std::uint8_t>(i), exponent_of(encoding));
  Image image(bytes.width, bytes.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = table[bytes.pixels[bytes.channels == 1 ? i / 3 : i]];
  }
  return image;
}

}  // namespace

void TextureTable::define(const std::string& name, const std::string& kind, ParamList params,
                          const std::string& folder) {
  const Location where = params.where();
  if (!definitions_.emplace(name, Definition{kind, std::move(params), folder}).second) {
    throw Error(where, "texture '" + name + "' is defined twice; rename one");
  }
}

TextureTable::Source TextureTable::image_source(const Definition& definition) {
  const ParamList& params = definition.params;
  if (params.get_string("mapping", "uv") != "uv")
    params.fail("only the mapping \"uv\" is known; bake the texture to uv");
  for (const char* name : {"uscale", "vscale"}) {
    if (params.get_float(name, 1) != 1)
      params.fail(std::string(name) + " is not known yet; scale the mesh's uv instead");
  }
  for (const char* name : {"udelta", "vdelta"}) {
    if (params.get_float(name, 0) != 0)
      params.fail(std::string(name) + " is not known yet; move the mesh's uv instead");
  }
  if (params.get_string("wrap", "repeat") != "repeat") params.fail("only \"string wrap\" \"repeat\" is known");
  if (params.get_string("filter", "bilinear") != "bilinear" && !warned_of_filter_) {
    warned_of_filter_ = true;
    diagnostics_.warn(params.find("filter")->where, params.directive() + ": all textures are filtered bilinearly");
  }
  params.ignore("maxanisotropy");
  Source source;
  source.where = params.where();
  source.encoding = params.get_string("encoding", "sRGB");
  if (exponent_of(source.encoding) < 0) params.fail("encoding must be \"sRGB\", \"linear\" or \"gamma <number>\"");
  const std::string file = params.get_string("filename", "");
  if (file.empty()) params.fail("\"string filename\" is missing");
  source.path = (std::filesystem::path(definition.folder) / file).string();
  const float scale = params.get_float("scale", 1);
  const bool invert = params.get_bool("invert", false);
  source.gain.fill(invert ? -scale : scale);
  source.offset.fill(invert ? 1.0f : 0.0f);
  return source;
}

TextureTable::Source TextureTable::operand(const ParamList& params, const std::string& name, int depth) {
  const std::string texture = params.get_texture(name);
  if (!texture.empty()) return source_of(texture, params, depth + 1);
  Source source;
  const Param* param = params.find(name);
  if (param && param->type == "float") {
    source.offset.fill(params.get_float(name, 1));
  } else {
    source.offset = params.get_rgb(name, {1, 1, 1});
  }
  return source;
}

TextureTable::Source TextureTable::source_of(const std::string& name, const ParamList& user, int depth) {
  const auto found = definitions_.find(name);
  if (found == definitions_.end()) user.fail("there is no texture '" + name + "'; define it before its use");
  const Definition& definition = found->second;
  const ParamList& params = definition.params;
  if (depth > kMaxDepth) params.fail("textures refer to each other more than 16 deep");
  Source source;
  if (definition.kind == "imagemap") {
    source = image_source(definition);
  } else if (definition.kind == "constant") {
    source = operand(params, "value", depth);
  } else if (definition.kind == "scale") {
    source = operand(params, "tex", depth);
    const Source factor = operand(params, "scale", depth);
    if (!factor.path.empty())
      params.fail("an image as \"scale\" is not known; make it \"tex\", and \"scale\" a constant");
    for (int c = 0; c < 3; ++c) {
      source.gain[c] *= factor.offset[c];
      source.offset[c] *= factor.offset[c];
    }
  } else {
    params.fail("this kind of texture is not known; bake it to an image and use \"imagemap\"");
  }
  params.warn_unused(diagnostics_);
  return source;
}

int TextureTable::load(const Source& source) {
  const SourceKey key(source.path, source.encoding, source.gain, source.offset);
  const auto found = loaded_.find(key);
  if (found != loaded_.end()) return found->second;

  TextureDescription texture;
  texture.label = std::filesystem::path(source.path).filename().string();
  texture.where = source.where;
  if (source.path.ends_with(".exr")) {
    auto layers = read_exr(source.path, source.where);
    if (!layers.contains("")) throw Error(source.where, "'" + source.path + "' has no channels R, G and B");
    texture.image = std::move(layers.at(""));
  } else {
    ByteImage bytes = read_byte_image(source.path, source.where);
    if (source.encoding == "sRGB") {
      texture.image = std::move(bytes);
    } else {
      texture.image = to_linear(bytes, source.encoding);
    }
  }
  const bool as_it_is = source.gain == Rgb{1, 1, 1} && source.offset == Rgb{0, 0, 0};
  if (!as_it_is && std::holds_alternative<ByteImage>(texture.image)) {
    texture.image = to_linear(std::get<ByteImage>(texture.image), source.encoding);
  }
  if (auto* image = std::get_if<Image>(&texture.image)) {
    for (std::size_t i = 0; i < image->pixels.size(); ++i) {
      float& x = image->pixels[i];
      if (!std::isfinite(x)) throw Error(source.where, "'" + source.path + "' has a texel that is not finite");
      x = std::clamp(x * source.gain[i % 3] + source.offset[i % 3], 0.0f, 1.0f);
    }
  }
  scene_.textures.push_back(std::move(texture));
  return loaded_[key] = static_cast<int>(scene_.textures.size()) - 1;
}

TextureValue TextureTable::resolve(const std::string& name, const ParamList& user) {
  const Source source = source_of(name, user, 0);
  if (source.path.empty()) return {source.offset, -1};
  return {{1, 1, 1}, load(source)};
}

}  // namespace bdpt_tool
