// An image in regions, for what a pilot learns of each.
#pragma once

#include "sensor/sensor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace bdpt {

// What a pilot learned of a region.
struct RegionMeasure {
  double mean = 0;      // of a pixel
  double variance = 0;  // of a pixel's value by one sample of it and one pass of light subpaths
  double rays = 0;      // of one sample with its light subpaths
};

// A square of some pixels a side, or what of it fits, at a place in a rectangle that 64 random bits choose.
inline PixelRect square_within(const PixelRect& r, int side, uint64_t place) {
  const int w = std::min(side, r.x1 - r.x0), h = std::min(side, r.y1 - r.y0);
  const int x = r.x0 + int(place % uint64_t(r.x1 - r.x0 - w + 1));
  const int y = r.y0 + int((place >> 32) % uint64_t(r.y1 - r.y0 - h + 1));
  return {x, y, x + w, y + h};
}

class RegionGrid {
 public:
  RegionGrid() = default;
  explicit RegionGrid(const PixelRect& bounds)
      : bounds_(bounds), columns_(divide(bounds.x1 - bounds.x0)), rows_(divide(bounds.y1 - bounds.y0)) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  size_t count() const { return size_t(columns_) * size_t(rows_); }
  size_t region(const FilmPosition& film) const {
    const auto place = [](float v, int first, int last, int n) {
      return int(int64_t(std::clamp(int(std::floor(v)), first, last - 1) - first) * n / (last - first));
    };
    return size_t(place(film.y, bounds_.y0, bounds_.y1, rows_)) * size_t(columns_) +
           size_t(place(film.x, bounds_.x0, bounds_.x1, columns_));
  }
  // Its pixels.
  PixelRect rect(int column, int row) const {
    const auto edge = [](int first, int last, int i, int n) {
      return first + int((int64_t(last - first) * i + n - 1) / n);
    };
    return {edge(bounds_.x0, bounds_.x1, column, columns_), edge(bounds_.y0, bounds_.y1, row, rows_),
            edge(bounds_.x0, bounds_.x1, column + 1, columns_), edge(bounds_.y0, bounds_.y1, row + 1, rows_)};
  }
  double pixels(size_t region) const {
    const PixelRect r = rect(int(region % size_t(columns_)), int(region / size_t(columns_)));
    return double(r.x1 - r.x0) * (r.y1 - r.y0);
  }
  // The geometric mean of a region and its neighbours, of those values that are above zero: few samples find few of the
  // rare bright ones, and one that they find must not speak for a region.
  std::vector<double> smooth(const std::vector<double>& values) const {
    std::vector<double> smoothed(count());
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        double logs = 0;
        int n = 0;
        for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y)
          for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x)
            if (const double v = values[size_t(y) * size_t(columns_) + size_t(x)]; v > 0) logs += std::log(v), ++n;
        if (n > 0) smoothed[size_t(row) * size_t(columns_) + size_t(column)] = std::exp(logs / n);
      }
    return smoothed;
  }

 private:
  // At most 32 a side, and at least 8 pixels each.
  static int divide(int pixels) { return std::clamp(pixels / 8, 1, 32); }

  PixelRect bounds_;
  int columns_ = 0, rows_ = 0;
};

}  // namespace bdpt
