// SPDX-License-Identifier: Apache-2.0
#include "pbrt/textures.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace bdpt_tool {
namespace {

constexpr int kMaxDepth = 16;
constexpr std::uint32_t kCheckSize = 32;  // texels of a chequerboard's square: as sharp as bilinear filters allow

// "sRGB" 0, "linear" 1, "gamma 2.2" 2.2; negative if it is none of these.
float exponent_of(const std::string& encoding) {
  if (encoding == "sRGB") return 0;
  if (encoding == "linear") return 1;
  if (!encoding.starts_with("gamma ")) return -1;
  float exponent = -1;
  std::from_chars(encoding.data() + 6, encoding.data() + encoding.size(), exponent);
  return exponent > 0 && std::isfinite(exponent) ? exponent : -1;
}

Wrap wrap_of(const ParamList& params) {
  const std::string name = params.get_string("wrap", "repeat");
  if (name == "repeat") return Wrap::kRepeat;
  if (name == "clamp") return Wrap::kClamp;
  if (name == "black") return Wrap::kBlack;
  params.fail("\"string wrap\" must be repeat, clamp or black");
}

Image checks(const std::array<Rgb, 2>& colors) {
  Image image(2 * kCheckSize, 2 * kCheckSize);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    // Row 0 is at t = 2; the square at the origin has the first colour.
    const std::size_t x = i / 3 % image.width / kCheckSize, y = 1 - i / 3 / image.width / kCheckSize;
    image.pixels[i] = colors[(x + y) % 2][i % 3];
  }
  return image;
}

void average_channels(Image& image) {
  for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3) {
    const float mean = (image.pixels[i] + image.pixels[i + 1] + image.pixels[i + 2]) / 3;
    std::fill_n(&image.pixels[i], 3, mean);
  }
}

Rgb mean_of(const Image& image) {
  std::array<double, 3> sum = {};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) sum[i % 3] += static_cast<double>(image.pixels[i]);
  Rgb mean;
  for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<float>(sum[c] / (double(image.pixels.size()) / 3));
  return mean;
}

}  // namespace

void TextureTable::define(const std::string& name, const std::string& kind, bool is_float, ParamList params) {
  const Location where = params.where();
  if (!definitions_.emplace(name, Definition{kind, is_float, std::move(params)}).second) {
    throw Error(where, "texture '" + name + "' is defined twice; rename one");
  }
}

// `size` squares of the texture's own unit make the image.
void TextureTable::read_mapping(const ParamList& params, double size, TextureUse& use) const {
  if (params.get_string("mapping", "uv") != "uv") {
    params.fail("only the mapping \"uv\" is known; bake the texture to uv");
  }
  const auto scaled = [&](const char* name, float fallback) {
    return static_cast<float>(static_cast<double>(params.get_float(name, fallback)) / size);
  };
  use.transform = {scaled("uscale", 1), 0, scaled("udelta", 0), 0, scaled("vscale", 1), scaled("vdelta", 0)};
}

TextureTable::Source TextureTable::image_source(const Definition& definition) {
  const ParamList& params = definition.params;
  Source source;
  source.where = params.where();
  read_mapping(params, 1, source.use);
  source.wrap.fill(wrap_of(params));
  const std::string filter = params.get_string("filter", "bilinear");
  source.nearest = filter == "point";
  if (filter != "bilinear" && !source.nearest && !warned_of_filter_) {
    warned_of_filter_ = true;
    diagnostics_.warn(params.find("filter")->where, params.directive() + ": all textures are filtered bilinearly");
  }
  params.ignore("maxanisotropy");
  source.exponent = exponent_of(params.get_string("encoding", "sRGB"));
  if (source.exponent < 0) params.fail("encoding must be \"sRGB\", \"linear\" or \"gamma <number>\"");
  const std::string file = params.get_string("filename", "");
  if (file.empty()) params.fail("\"string filename\" is missing");
  source.path = folder_.path_of(file, params.find("filename")->where);
  source.is_float = definition.is_float;
  const float scale = params.get_float("scale", 1);
  const bool invert = params.get_bool("invert", false);
  source.gain.fill(invert ? -scale : scale);
  source.offset.fill(invert ? 1.0f : 0.0f);
  return source;
}

TextureTable::Source TextureTable::checkerboard(const std::string& name, const ParamList& params, int depth) {
  if (params.get_int("dimension", 2) != 2) params.fail("only chequerboards of 2 dimensions are known");
  Source source;
  source.path = "chequerboard " + name;
  source.where = params.where();
  source.is_checkerboard = source.nearest = true;
  source.gain.fill(1);
  source.checks = {constant_operand(params, "tex1", depth), constant_operand(params, "tex2", depth)};
  if (!params.has("tex2")) source.checks[1] = {0, 0, 0};
  read_mapping(params, 2, source.use);
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

Rgb TextureTable::constant_operand(const ParamList& params, const std::string& name, int depth) {
  const Source source = operand(params, name, depth);
  if (source.is_image()) params.fail("an image as \"" + name + "\" is not known; give a constant");
  return source.offset;
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
  } else if (definition.kind == "checkerboard") {
    source = checkerboard(name, params, depth);
  } else if (definition.kind == "constant") {
    source = operand(params, "value", depth);
  } else if (definition.kind == "scale") {
    source = operand(params, "tex", depth);
    const Source factor = operand(params, "scale", depth);
    if (factor.is_image()) {
      params.fail("an image as \"scale\" is not known; make it \"tex\", and \"scale\" a constant");
    }
    for (int c = 0; c < 3; ++c) {
      source.gain[c] *= factor.offset[c];
      source.offset[c] *= factor.offset[c];
    }
  } else if (definition.kind == "mix") {
    const float amount = params.get_float("amount", 0.5f);
    const Rgb a = constant_operand(params, "tex1", depth), b = constant_operand(params, "tex2", depth);
    for (int c = 0; c < 3; ++c) source.offset[c] = (1 - amount) * (params.has("tex1") ? a[c] : 0) + amount * b[c];
  } else {
    params.fail("this kind of texture is not known; bake it to an image and use \"imagemap\"");
  }
  params.warn_unused(diagnostics_);
  return source;
}

// Texels are changed as linear floats, and left as the file has them where nothing changes them.
AnyImage TextureTable::texels(const Source& source) const {
  if (source.is_checkerboard) return checks(source.checks);
  AnyImage image = read_image(source.path, source.where);
  const bool as_it_is = source.gain == Rgb{1, 1, 1} && source.offset == Rgb{0, 0, 0} && !source.is_float;
  if (as_it_is && !std::holds_alternative<Image>(image)) return image;
  Image linear = to_linear(image, source.exponent);
  if (source.is_float) average_channels(linear);
  for (std::size_t i = 0; i < linear.pixels.size(); ++i) {
    float& x = linear.pixels[i];
    if (!std::isfinite(x)) throw Error(source.where, "'" + source.path + "' has a texel that is not finite");
    x = x * source.gain[i % 3] + source.offset[i % 3];
    if (source.curve != Curve::kNone) {
      if (source.curve == Curve::kRemappedAlpha) x = std::sqrt(std::max(x, 0.0f));
      if (x < kSmoothAlpha) x = 0;
      if (x > 1) diagnostics_.warn(source.where, "texels of a roughness above 1 become 1");
    }
    x = std::clamp(x, 0.0f, 1.0f);
  }
  return linear;
}

int TextureTable::load(const Source& source) {
  const SourceKey key(source.path, source.exponent, source.gain, source.offset, source.is_float, source.nearest,
                      source.curve, source.wrap);
  const auto found = loaded_.find(key);
  if (found != loaded_.end()) return found->second;
  TextureDescription texture;
  texture.label = std::filesystem::path(source.path).filename().string();
  texture.where = source.where;
  texture.image = texels(source);
  texture.exponent = source.is_float ? 1 : source.exponent;
  texture.wrap = source.wrap;
  texture.nearest = source.nearest;
  scene_.textures.push_back(std::move(texture));
  return loaded_[key] = static_cast<int>(scene_.textures.size()) - 1;
}

TextureValue TextureTable::resolve(const std::string& name, const ParamList& user) {
  return value_of(source_of(name, user, 0));
}

TextureValue TextureTable::resolve_alpha(const std::string& name, const ParamList& user, bool remap) {
  Source source = source_of(name, user, 0);
  source.curve = remap ? Curve::kRemappedAlpha : Curve::kAlpha;
  if (source.is_image()) source.is_float = true;
  return value_of(source);
}

Rgb TextureTable::mean(const TextureUse& use) const {
  const TextureDescription& texture = scene_.textures[static_cast<std::size_t>(use.texture)];
  return mean_of(to_linear(texture.image, texture.exponent));
}

TextureValue TextureTable::value_of(const Source& source) {
  if (!source.is_image()) return {source.offset, {}};
  TextureValue value;
  value.use = source.use;
  value.use.texture = load(source);
  return value;
}

int TextureTable::linear_image(const std::string& file, const Location& where) {
  Source source;
  source.path = folder_.path_of(file, where);
  source.where = where;
  source.exponent = 1;
  source.gain.fill(1);
  return load(source);
}

}  // namespace bdpt_tool
