// The eight texels round a texel.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bdpt {

// visit(texel) for those within the image, row by row; texels are numbered row by row, too.
template <class Visit>
void for_each_neighbor(size_t texel, uint32_t width, uint32_t height, Visit&& visit) {
  const size_t x = texel % width, y = texel / width;
  for (size_t row = y > 0 ? y - 1 : 0; row <= y + 1 && row < height; ++row)
    for (size_t column = x > 0 ? x - 1 : 0; column <= x + 1 && column < width; ++column)
      if (row != y || column != x) visit(row * width + column);
}

}  // namespace bdpt
