// Gutters: values for texels that no chart covers, from those that one does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

struct DilateImage {
  uint32_t width = 0, height = 0, channels = 0;
  const float* pixels = nullptr;     // channels floats to a texel, packed
  const uint8_t* mask = nullptr;     // 0 = to be filled
  const uint32_t* charts = nullptr;  // or NULL: all of one chart
};

struct Dilation {
  std::vector<size_t> texels;      // those that were filled
  std::vector<float> values;       // channels floats for each
  std::vector<uint32_t> charts;    // for each
  std::vector<size_t> not_finite;  // texels that the mask had, with a value that is not finite: filled if within reach
  uint64_t left = 0;               // texels that are still without a value
};

// In each step every texel without a value that has neighbours with one, among the eight round it, takes their mean.
// With charts they are of one chart: of the texel's own, or if it has none (0) of the one that most of them have, the
// lowest of equals, which is then the texel's, too.
Dilation dilate(const DilateImage& image, uint32_t steps);

}  // namespace bdpt
