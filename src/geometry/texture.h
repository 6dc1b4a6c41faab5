// Image textures: bilinear, repeated.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt {

class Texture {
 public:
  // 8-bit texels (1 or 3 channels, packed), decoded through a table of 256; or floats.
  Texture(std::string label, uint32_t width, uint32_t height, uint32_t channels, std::vector<uint8_t> texels,
          bool srgb);
  Texture(std::string label, uint32_t width, uint32_t height, uint32_t channels, std::vector<float> texels);

  Rgb lookup(const Vec2& uv) const;
  const std::string& label() const { return label_; }
  uint64_t memory() const { return bytes_.size() + floats_.size() * sizeof(float); }
  uint64_t content_hash() const;

 private:
  Rgb texel(uint32_t x, uint32_t y) const;

  std::string label_;
  uint32_t width_, height_, channels_;
  std::vector<uint8_t> bytes_;
  std::vector<float> floats_;
  float decode_[256];
};

float srgb_to_linear(float v);

}  // namespace bdpt
