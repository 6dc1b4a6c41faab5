// Image textures: texels of one to four channels, looked up at texture coordinates.
//
// A lookup depends on the coordinates alone, never on how a path came there: all techniques must see the same surface.
// So the mip level is a number of the sampler's, not a matter of footprints.
#pragma once

#include "geometry/rgba.h"
#include "math/srgb.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bdpt {

enum class TextureWrap : uint8_t { Repeat, Mirror, Clamp };
enum class TextureFilter : uint8_t { Bilinear, Nearest, Bicubic };

struct TextureSampler {
  TextureWrap wrap_u = TextureWrap::Repeat, wrap_v = TextureWrap::Repeat;
  TextureFilter filter = TextureFilter::Bilinear;
  float level = 0;  // of the mip levels, 0 being the image; between two of them their mean by distance
  bool operator==(const TextureSampler&) const = default;
};

// How texels are kept: as they came where that can be decoded while they are looked up.
enum class TexelFormat : uint8_t { Uint8, Uint16, Half, Float };
inline uint32_t bytes_of(TexelFormat format) {
  return format == TexelFormat::Uint8 ? 1 : format == TexelFormat::Float ? 4 : 2;
}

struct TextureImage {
  std::string label;
  uint32_t width = 0, height = 0, channels = 0;  // channels: grey; grey, alpha; red, green, blue; and alpha
  TexelFormat format = TexelFormat::Float;
  bool srgb = false;              // of 8-bit texels: colour, not alpha, is decoded by the sRGB curve
  std::vector<std::byte> texels;  // packed; row 0 is v = 1
};

using TexelDecoder = Rgba (*)(const std::byte* texel, const float* bytes_as);

class Texture {
 public:
  // levels: at most so many mip levels, the image being one; each halves the one before, by its mean.
  explicit Texture(TextureImage image, uint32_t levels = 1);

  // A channel that is missing: grey stands for all three colours, and alpha is 1.
  Rgba lookup(const Vec2& uv, const TextureSampler& sampler = {}) const;
  Rgba texel(uint32_t x, uint32_t y, uint32_t level = 0) const;

  const std::string& label() const { return label_; }
  uint32_t width() const { return levels_[0].width; }
  uint32_t height() const { return levels_[0].height; }
  uint32_t levels() const { return uint32_t(levels_.size()); }
  uint64_t memory() const { return texels_.size(); }
  uint64_t content_hash() const;
  // Bytes of a texture with so many levels.
  static uint64_t memory(uint32_t width, uint32_t height, uint32_t channels, TexelFormat format, uint32_t levels);

 private:
  struct Level {
    uint32_t width, height;
    size_t first;  // byte
  };
  Rgba lookup_in(uint32_t level, const Vec2& uv, const TextureSampler& sampler) const;
  void reduce(uint32_t level);
  void set_texel(uint32_t x, uint32_t y, uint32_t level, const Rgba& value);

  std::string label_;
  uint32_t channels_;
  TexelFormat format_;
  bool srgb_;
  uint32_t texel_bytes_;
  TexelDecoder decode_;
  std::vector<Level> levels_;
  std::vector<std::byte> texels_;
  std::array<float, 256> bytes_as_;
};

}  // namespace bdpt
