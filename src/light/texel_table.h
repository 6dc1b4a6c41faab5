// A distribution over the texels of an image: a row by all rows' sums, then a texel of the row.
#pragma once

#include "sampling/discrete.h"

#include <cstdint>
#include <functional>

namespace bdpt {

class TexelTable {
 public:
  TexelTable() = default;
  // weight(x, y) >= 0; whatever is above 0 keeps a chance.
  TexelTable(uint32_t width, uint32_t height, const std::function<double(uint32_t x, uint32_t y)>& weight);

  // Without any texel that has a chance.
  bool empty() const { return rows_.empty(); }
  struct Place {
    uint32_t x, y;
    double u, v;  // within the texel, [0,1)
  };
  // u chooses the column, v the row. rest: 48 bits of which both take some: a picture may have a sun, and beside it
  // many texels that are hardly ever chosen. Not of an empty table.
  Place sample(double rest, float u, float v) const;
  float probability(uint32_t x, uint32_t y) const;
  static uint64_t memory_of(uint32_t width, uint32_t height) { return uint64_t(width) * height * sizeof(uint32_t); }

 private:
  Discrete rows_;
  std::vector<uint32_t> sums_;  // of each row, up to and with each texel: whole numbers, so that nothing small is lost
  uint32_t width_ = 0;
};

}  // namespace bdpt
