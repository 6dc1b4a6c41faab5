// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "image.h"

namespace bdpt_tool {

float srgb_to_linear(float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); }

Image to_linear(const ByteImage& bytes) {
  float table[256];
  for (int i = 0; i < 256; ++i) table[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
  Image image(bytes.width, bytes.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = table[bytes.pixels[bytes.channels == 1 ? i / 3 : i]];
  }
  return image;
}

}  // namespace bdpt_tool
