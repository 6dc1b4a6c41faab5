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
  struct Texel {
    uint32_t x, y;
  };
  // Chooses a texel: v its row, u the one in it; both are stretched back to [0,1). Not of an empty table.
  Texel sample(double& u, double& v) const;
  float probability(uint32_t x, uint32_t y) const;

 private:
  Discrete rows_;
  std::vector<uint32_t> sums_;  // of each row, up to and with each texel: whole numbers, so that nothing small is lost
  uint32_t width_ = 0;
};

}  // namespace bdpt
