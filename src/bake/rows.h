// Measurements without a place of their own in the film: in rows, in order. The last row may have room left. As many
// rows as columns, so that neighbours in order are neighbours in blocks.
#pragma once

#include "sensor/sensor.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

// Where the film has the measurement in column x and row y.
inline FilmPosition center_of(int x, int y) { return {float(x) + 0.5f, float(y) + 0.5f}; }

struct Rows {
  explicit Rows(uint64_t n)
      : count(n),
        width(std::max(1, int(std::ceil(std::sqrt(double(n)))))),
        height(int((n + uint64_t(width) - 1) / uint64_t(width))) {}
  uint64_t count;
  int width, height;

  // -1 where there is none.
  int64_t number(int x, int y) const {
    const int64_t i = int64_t(y) * width + x;
    return i < int64_t(count) ? i : -1;
  }
  uint64_t number(const FilmPosition& film) const { return uint64_t(film.y) * uint64_t(width) + uint64_t(film.x); }
  FilmPosition place(uint64_t number) const {
    return center_of(int(number % uint64_t(width)), int(number / uint64_t(width)));
  }
};

}  // namespace bdpt
