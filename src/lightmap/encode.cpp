#include "lightmap/encode.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

constexpr float kLargestHalf = 65504;

// A colour within [0, range], counted where it had to be brought there.
struct Colour {
  double rgb[3];
  double largest;
};

Colour clip(const float* in, double range, EncodeCounts& counts) {
  if (!(std::isfinite(in[0]) && std::isfinite(in[1]) && std::isfinite(in[2]))) {
    ++counts.not_finite;
    return {{0, 0, 0}, 0};
  }
  Colour c{};
  bool clipped = false;
  for (int i = 0; i < 3; ++i) {
    c.rgb[i] = std::clamp(double(in[i]), 0.0, range);
    clipped |= c.rgb[i] != double(in[i]);
    c.largest = std::max(c.largest, c.rgb[i]);
  }
  counts.clipped += clipped;
  return c;
}

uint8_t to_byte(double v) { return uint8_t(std::clamp(std::floor(v * 255 + 0.5), 0.0, 255.0)); }

}  // namespace

EncodeCounts encode_half(const FloatTexels& texels, uint32_t channels, uint16_t* out) {
  EncodeCounts counts;
  for (size_t i = 0; i < texels.count; ++i) {
    const float* in = texels.pixels + i * texels.stride;
    bool finite = true, clipped = false;
    for (uint32_t c = 0; c < channels; ++c) {
      finite &= std::isfinite(in[c]);
      clipped |= std::fabs(in[c]) > kLargestHalf;
    }
    for (uint32_t c = 0; c < channels; ++c)
      *out++ = Imath::half(finite ? std::clamp(in[c], -kLargestHalf, kLargestHalf) : 0.0f).bits();
    if (!finite)
      ++counts.not_finite;
    else
      counts.clipped += clipped;
  }
  return counts;
}

EncodeCounts encode_rgbm(const FloatTexels& texels, double range, uint8_t* out) {
  EncodeCounts counts;
  for (size_t i = 0; i < texels.count; ++i, out += 4) {
    const Colour c = clip(texels.pixels + i * texels.stride, range, counts);
    const double m = std::clamp(std::ceil(c.largest / range * 255), 1.0, 255.0);
    for (int k = 0; k < 3; ++k) out[k] = to_byte(c.rgb[k] / range * 255 / m);
    out[3] = uint8_t(m);
  }
  return counts;
}

EncodeCounts encode_rgbd(const FloatTexels& texels, double range, uint8_t* out) {
  EncodeCounts counts;
  for (size_t i = 0; i < texels.count; ++i, out += 4) {
    const Colour c = clip(texels.pixels + i * texels.stride, range, counts);
    const double d = c.largest > 0 ? std::clamp(std::floor(range / c.largest), 1.0, 255.0) : 255;
    for (int k = 0; k < 3; ++k) out[k] = to_byte(c.rgb[k] / range * d);
    out[3] = uint8_t(d);
  }
  return counts;
}

}  // namespace bdpt
