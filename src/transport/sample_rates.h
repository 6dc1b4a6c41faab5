// Adaptive sampling of the image plane (Veach 10.3.6), in two stages, so that no sample has a say in how many there
// are: a pilot (image_pilot.h) first tells each region its rate r, the number of eye samples that a pixel gets in a
// pass, in the mean. A sample then weighs 1 / r.
//
// A sample brings its light subpaths with it, as ever. They may hit any pixel, and weigh one over the mean of r.
#pragma once

#include "film/film.h"
#include "transport/region_grid.h"

#include <vector>

namespace bdpt {

class SampleRates {
 public:
  // Rates are multiples of a quarter, from 1/2 to 4: after four passes of a group every pixel has r times as many. What
  // the pilot missed has at most twice the variance.
  static constexpr int kParts = 4, kLeastParts = 2, kMost = 4;

  bool are_set() const { return !parts_.empty(); }
  // eye: what can be gained by eye samples, and what one costs; all: what the error is measured against.
  void set(const RegionGrid& grid, const std::vector<RegionMeasure>& eye, const std::vector<RegionMeasure>& all,
           uint64_t seed);

  double rate(int x, int y) const { return are_set() ? double(parts(x, y)) / kParts : 1; }
  double mean() const { return mean_; }

  // The samples of a pixel in a pass, by their numbers in the pixel.
  struct Numbers {
    uint64_t begin, end;
  };
  Numbers numbers(const PassInGroup& pass, int x, int y) const {
    if (!are_set()) return {pass.index, pass.index + 1};
    const uint64_t n = parts(x, y), offset = phase(pass.group, x, y);
    return {(pass.index * n + offset) / kParts, ((pass.index + 1) * n + offset) / kParts};
  }

 private:
  uint64_t parts(int x, int y) const { return parts_[grid_.region({float(x), float(y)})]; }
  // The fractions of 2 x 2 pixels, and of four groups, reach a whole in turn.
  uint64_t phase(uint64_t group, int x, int y) const {
    constexpr uint64_t kOrder[] = {0, 2, 3, 1};
    return (phase_ + kOrder[group % 4] + kOrder[(x & 1) + 2 * (y & 1)]) % kParts;
  }

  RegionGrid grid_;
  std::vector<uint8_t> parts_;  // of each region: r in quarters
  uint64_t phase_ = 0;
  double mean_ = 1;  // over the pixels
};

}  // namespace bdpt
