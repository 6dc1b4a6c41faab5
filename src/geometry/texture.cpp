#include "geometry/texture.h"

#include "sampling/hash.h"

#include <Imath/half.h>

#include <cstring>

namespace bdpt {

namespace {

uint32_t half_of(uint32_t side) { return std::max(1u, side / 2); }

uint32_t level_count(uint32_t width, uint32_t height, uint32_t most) {
  uint32_t levels = 1;
  for (; levels < most && (width > 1 || height > 1); ++levels) width = half_of(width), height = half_of(height);
  return levels;
}

// The texel in [0, n) that stands for number i, which place() keeps near.
uint32_t wrap(int64_t i, uint32_t n, TextureWrap wrap) {
  const auto side = int64_t(n);
  if (wrap == TextureWrap::Clamp) return uint32_t(std::clamp<int64_t>(i, 0, side - 1));
  const int64_t period = wrap == TextureWrap::Mirror ? 2 * side : side;
  while (i < 0) i += period;
  while (i >= period) i -= period;
  return uint32_t(i < side ? i : 2 * side - 1 - i);
}

// Where a coordinate lies among the texels: large numbers are brought near first, so that no digit is lost. One that
// overflowed on its way here lies nowhere, so at 0.
double place(float coordinate, uint32_t n, TextureWrap wrap) {
  double c = std::isfinite(coordinate) ? double(coordinate) : 0;
  if (wrap == TextureWrap::Clamp)
    c = std::clamp(c, -1.0, 2.0);
  else
    c -= 2 * std::floor(c / 2);
  return c * n;
}

// Weights of four texels by the uniform cubic B-spline, which never falls below zero.
std::array<float, 4> cubic_weights(float t) {
  const float s = 1 - t, t2 = t * t, s2 = s * s;
  return {s2 * s / 6, (4 - 6 * t2 + 3 * t2 * t) / 6, (4 - 6 * s2 + 3 * s2 * s) / 6, t2 * t / 6};
}

void add(Rgba& sum, const Rgba& value, float weight) {
  for (size_t c = 0; c < 4; ++c) sum[c] += value[c] * weight;
}

template <TexelFormat format>
float channel(const std::byte* at, uint32_t i) {
  if constexpr (format == TexelFormat::Float) {
    float v;
    std::memcpy(&v, at + 4 * i, 4);
    return v;
  } else {
    uint16_t bits;
    std::memcpy(&bits, at + 2 * i, 2);
    return format == TexelFormat::Half ? imath_half_to_float(bits) : float(bits) / 65535;
  }
}

// bytes_as: what a byte of colour stands for.
template <TexelFormat format, uint32_t channels>
Rgba decode(const std::byte* at, [[maybe_unused]] const float* bytes_as) {
  constexpr bool has_alpha = channels % 2 == 0;
  constexpr uint32_t g = channels > 2 ? 1 : 0, b = channels > 2 ? 2 : 0, a = channels - 1;
  if constexpr (format == TexelFormat::Uint8)
    return {bytes_as[uint8_t(at[0])], bytes_as[uint8_t(at[g])], bytes_as[uint8_t(at[b])],
            has_alpha ? float(uint8_t(at[a])) / 255 : 1};
  else
    return {channel<format>(at, 0), channel<format>(at, g), channel<format>(at, b),
            has_alpha ? channel<format>(at, a) : 1};
}

template <TexelFormat format>
TexelDecoder decoder_of(uint32_t channels) {
  constexpr TexelDecoder kDecoders[] = {decode<format, 1>, decode<format, 2>, decode<format, 3>, decode<format, 4>};
  return kDecoders[channels - 1];
}

TexelDecoder decoder_of(TexelFormat format, uint32_t channels) {
  switch (format) {
    case TexelFormat::Uint8:
      return decoder_of<TexelFormat::Uint8>(channels);
    case TexelFormat::Uint16:
      return decoder_of<TexelFormat::Uint16>(channels);
    case TexelFormat::Half:
      return decoder_of<TexelFormat::Half>(channels);
    case TexelFormat::Float:
      break;
  }
  return decoder_of<TexelFormat::Float>(channels);
}

Rgba mix(const Rgba& a, const Rgba& b, float t) {
  Rgba r;
  for (size_t c = 0; c < 4; ++c) r[c] = a[c] + (b[c] - a[c]) * t;
  return r;
}

}  // namespace

Texture::Texture(TextureImage image, uint32_t levels)
    : label_(std::move(image.label)),
      channels_(image.channels),
      format_(image.format),
      srgb_(image.srgb),
      texel_bytes_(channels_ * bytes_of(format_)),
      decode_(decoder_of(format_, channels_)),
      texels_(std::move(image.texels)) {
  for (int i = 0; i < 256; ++i) bytes_as_[size_t(i)] = srgb_ ? srgb_to_linear(float(i) / 255) : float(i) / 255;
  levels_.push_back({image.width, image.height, 0});
  const uint32_t count = level_count(image.width, image.height, levels);
  texels_.resize(memory(image.width, image.height, channels_, format_, count));
  for (uint32_t i = 1; i < count; ++i) reduce(i - 1);
}

uint64_t Texture::memory(uint32_t width, uint32_t height, uint32_t channels, TexelFormat format, uint32_t levels) {
  uint64_t texels = 0;
  for (uint32_t left = level_count(width, height, levels); left > 0; --left) {
    texels += uint64_t(width) * height;
    width = half_of(width), height = half_of(height);
  }
  return texels * channels * bytes_of(format);
}

// Makes the level after this one. An odd side's last row counts with the one before.
void Texture::reduce(uint32_t level) {
  const Level from = levels_[level];
  const Level to{half_of(from.width), half_of(from.height),
                 from.first + size_t(from.width) * from.height * texel_bytes_};
  levels_.push_back(to);
  for (uint32_t y = 0; y < to.height; ++y)
    for (uint32_t x = 0; x < to.width; ++x) {
      const uint32_t x0 = uint32_t(uint64_t(x) * from.width / to.width),
                     x1 = uint32_t(uint64_t(x + 1) * from.width / to.width);
      const uint32_t y0 = uint32_t(uint64_t(y) * from.height / to.height),
                     y1 = uint32_t(uint64_t(y + 1) * from.height / to.height);
      Rgba mean{};
      for (uint32_t j = y0; j < y1; ++j)
        for (uint32_t i = x0; i < x1; ++i) add(mean, texel(i, j, level), 1 / float((x1 - x0) * (y1 - y0)));
      set_texel(x, y, level + 1, mean);
    }
}

Rgba Texture::texel(uint32_t x, uint32_t y, uint32_t level) const {
  const Level& l = levels_[level];
  return decode_(&texels_[l.first + (size_t(y) * l.width + x) * texel_bytes_], bytes_as_.data());
}

void Texture::set_texel(uint32_t x, uint32_t y, uint32_t level, const Rgba& value) {
  const Level& l = levels_[level];
  std::byte* at = &texels_[l.first + (size_t(y) * l.width + x) * texel_bytes_];
  const bool has_alpha = channels_ == 2 || channels_ == 4;
  for (uint32_t c = 0; c < channels_; ++c) {
    const bool is_alpha = has_alpha && c + 1 == channels_;
    const float v = value[is_alpha ? 3 : c];
    switch (format_) {
      case TexelFormat::Uint8:
        at[c] = std::byte(uint8_t(std::lround((srgb_ && !is_alpha ? linear_to_srgb(v) : v) * 255)));
        break;
      case TexelFormat::Uint16: {
        const auto bits = uint16_t(std::lround(v * 65535));
        std::memcpy(at + 2 * c, &bits, 2);
        break;
      }
      case TexelFormat::Half: {
        const uint16_t bits = imath_float_to_half(v);
        std::memcpy(at + 2 * c, &bits, 2);
        break;
      }
      case TexelFormat::Float:
        std::memcpy(at + 4 * c, &v, 4);
        break;
    }
  }
}

Rgba Texture::lookup(const Vec2& uv, const TextureSampler& sampler) const {
  const float last = float(levels_.size() - 1);
  const float level = std::clamp(sampler.level, 0.0f, last);
  const auto below = uint32_t(level);
  const Rgba a = lookup_in(below, uv, sampler);
  const float t = level - float(below);
  return t == 0 ? a : mix(a, lookup_in(below + 1, uv, sampler), t);
}

// Texel centres lie at half-integers; row 0 is v = 1.
Rgba Texture::lookup_in(uint32_t level, const Vec2& uv, const TextureSampler& sampler) const {
  const Level& l = levels_[level];
  const double x = place(uv.x, l.width, sampler.wrap_u), y = place(1 - uv.y, l.height, sampler.wrap_v);
  const auto at = [&](int64_t i, int64_t j) {
    return texel(wrap(i, l.width, sampler.wrap_u), wrap(j, l.height, sampler.wrap_v), level);
  };
  if (sampler.filter == TextureFilter::Nearest) return at(int64_t(std::floor(x)), int64_t(std::floor(y)));
  const double fx = std::floor(x - 0.5), fy = std::floor(y - 0.5);
  const auto i = int64_t(fx), j = int64_t(fy);
  const auto wx = float(x - 0.5 - fx), wy = float(y - 0.5 - fy);
  if (sampler.filter == TextureFilter::Bilinear)
    return mix(mix(at(i, j), at(i + 1, j), wx), mix(at(i, j + 1), at(i + 1, j + 1), wx), wy);
  const std::array<float, 4> u = cubic_weights(wx), v = cubic_weights(wy);
  Rgba sum{};
  for (int n = 0; n < 4; ++n)
    for (int m = 0; m < 4; ++m) add(sum, at(i + m - 1, j + n - 1), u[size_t(m)] * v[size_t(n)]);
  return sum;
}

uint64_t Texture::content_hash() const {
  uint64_t h = hash_values(width(), height(), channels_, levels(), int(format_), srgb_);
  return hash_bytes(texels_.data(), texels_.size(), h);
}

}  // namespace bdpt
