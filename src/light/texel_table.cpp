#include "light/texel_table.h"

#include <cmath>

namespace bdpt {

TexelTable::TexelTable(uint32_t width, uint32_t height, const std::function<double(uint32_t x, uint32_t y)>& weight)
    : width_(width) {
  constexpr double kUnits = 0x1p31;  // of a row, more or less
  std::vector<double> rows(height), row(width);
  sums_.reserve(size_t(width) * height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) rows[y] += row[x] = weight(x, y);
    uint32_t sum = 0;
    for (uint32_t x = 0; x < width; ++x) {
      if (row[x] > 0) sum += 1 + uint32_t(row[x] / rows[y] * kUnits);
      sums_.push_back(sum);
    }
  }
  rows_ = Discrete(rows);
}

TexelTable::Place TexelTable::sample(double rest, float u1, float u2) const {
  const double digits = rest * 0x1p12, high = std::floor(digits);
  const double u = join(u1, float(high * 0x1p-12));
  double v = join(u2, float(digits - high));
  const uint32_t y = uint32_t(rows_.sample(v));
  const uint32_t* row = &sums_[size_t(y) * width_];
  const double at = u * double(row[width_ - 1]);
  const uint32_t x = uint32_t(std::upper_bound(row, row + width_ - 1, uint32_t(at)) - row);
  const uint32_t below = x > 0 ? row[x - 1] : 0;
  return {x, y, std::clamp((at - below) / (row[x] - below), 0.0, 0x1.fffffffffffffp-1), v};
}

float TexelTable::probability(uint32_t x, uint32_t y) const {
  if (empty()) return 0;
  const uint32_t* row = &sums_[size_t(y) * width_];
  if (row[width_ - 1] == 0) return 0;
  const uint32_t below = x > 0 ? row[x - 1] : 0;
  return rows_.probability(y) * (float(row[x] - below) / float(row[width_ - 1]));
}

}  // namespace bdpt
