#include "geometry/texture.h"

#include "sampling/hash.h"

namespace bdpt {

float srgb_to_linear(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

Texture::Texture(std::string label, uint32_t width, uint32_t height, uint32_t channels, std::vector<uint8_t> texels,
                 bool srgb)
    : label_(std::move(label)), width_(width), height_(height), channels_(channels), bytes_(std::move(texels)) {
  for (int i = 0; i < 256; ++i) decode_[i] = srgb ? srgb_to_linear(i / 255.0f) : i / 255.0f;
}

Texture::Texture(std::string label, uint32_t width, uint32_t height, uint32_t channels, std::vector<float> texels)
    : label_(std::move(label)), width_(width), height_(height), channels_(channels), floats_(std::move(texels)) {}

Rgb Texture::texel(uint32_t x, uint32_t y) const {
  const size_t i = (size_t(y) * width_ + x) * channels_;
  if (!bytes_.empty()) {
    if (channels_ == 1) return Rgb(decode_[bytes_[i]]);
    return {decode_[bytes_[i]], decode_[bytes_[i + 1]], decode_[bytes_[i + 2]]};
  }
  if (channels_ == 1) return Rgb(floats_[i]);
  return {floats_[i], floats_[i + 1], floats_[i + 2]};
}

Rgb Texture::lookup(const Vec2& uv) const {
  // Texel centres lie at half-integers; row 0 is v = 1.
  const float u = uv.x - std::floor(uv.x), v = 1.0f - (uv.y - std::floor(uv.y));
  const float x = u * width_ - 0.5f, y = v * height_ - 0.5f;
  const float fx = std::floor(x), fy = std::floor(y);
  const float wx = x - fx, wy = y - fy;
  const auto wrap = [](float i, uint32_t n) { return i < 0 ? n - 1 : uint32_t(i) >= n ? 0u : uint32_t(i); };
  const uint32_t x0 = wrap(fx, width_), x1 = wrap(fx + 1, width_);
  const uint32_t y0 = wrap(fy, height_), y1 = wrap(fy + 1, height_);
  return (texel(x0, y0) * (1 - wx) + texel(x1, y0) * wx) * (1 - wy) +
         (texel(x0, y1) * (1 - wx) + texel(x1, y1) * wx) * wy;
}

uint64_t Texture::content_hash() const {
  uint64_t h = hash_values(width_, height_, channels_);
  h = hash_bytes(bytes_.data(), bytes_.size(), h);
  h = hash_bytes(floats_.data(), floats_.size() * sizeof(float), h);
  return hash_bytes(decode_, bytes_.empty() ? 0 : sizeof(decode_), h);
}

}  // namespace bdpt
