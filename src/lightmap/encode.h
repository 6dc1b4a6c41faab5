// Texels in fewer bits. What is not finite becomes 0 and is counted; what is clipped is counted, too: texels, not
// values.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bdpt {

struct EncodeCounts {
  uint64_t clipped = 0;
  uint64_t not_finite = 0;
};

// Texels of n floats, stride floats apart.
struct FloatTexels {
  const float* pixels = nullptr;
  size_t count = 0, stride = 0;
};

// 16-bit floats, rounded to nearest, clipped to +-65504.
EncodeCounts encode_half(const FloatTexels& texels, uint32_t channels, uint16_t* out);

// Four bytes R G B M: colour = range * M/255 * (R, G, B)/255.
EncodeCounts encode_rgbm(const FloatTexels& texels, double range, uint8_t* out);

// Four bytes R G B D, D >= 1: colour = range / D * (R, G, B)/255.
EncodeCounts encode_rgbd(const FloatTexels& texels, double range, uint8_t* out);

}  // namespace bdpt
