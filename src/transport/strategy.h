// How a part of the image is measured: which techniques take part, how often, and who joins inner vertices. All of the
// image has one strategy, unless a plan gives its tiles their own.
#pragma once

#include "sensor/sensor.h"
#include "transport/mis.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bdpt {

struct Strategy {
  const Plan* plan = nullptr;
  TechniqueMask techniques;
  SampleCounts counts;
  TechniqueClasses classes;

  bool allows(uint32_t s, uint32_t t) const { return techniques.allows(int(s), int(t)); }
  // Whether the plan joins vertices; else they are joined as they are made.
  bool joins_inner() const;
};

// The squares of pixels whose strategies are chosen apart.
class Tiles {
 public:
  static constexpr int kSide = 16;

  Tiles() = default;
  explicit Tiles(const PixelRect& bounds)
      : bounds_(bounds), columns_(tiles(bounds.x1 - bounds.x0)), rows_(tiles(bounds.y1 - bounds.y0)) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  size_t count() const { return size_t(columns_) * size_t(rows_); }
  size_t tile(const FilmPosition& film) const {
    const auto place = [](float v, int first, int last) {
      return size_t((std::clamp(int(std::floor(v)), first, last - 1) - first) / kSide);
    };
    return place(film.y, bounds_.y0, bounds_.y1) * size_t(columns_) + place(film.x, bounds_.x0, bounds_.x1);
  }
  // The pixels of a tile.
  PixelRect pixels(int column, int row) const {
    const int x = bounds_.x0 + column * kSide, y = bounds_.y0 + row * kSide;
    return {x, y, std::min(x + kSide, bounds_.x1), std::min(y + kSide, bounds_.y1)};
  }

 private:
  static int tiles(int pixels) { return (pixels + kSide - 1) / kSide; }

  PixelRect bounds_{};
  int columns_ = 0, rows_ = 0;
};

// The strategies of an image's tiles.
struct StrategyMap {
  Tiles tiles;
  std::vector<Strategy> strategies;
  std::vector<uint8_t> choices;  // of each tile
  int light_samples = 1;         // light subpaths for each eye subpath, all over the image; 0 = none

  const Strategy& at(const FilmPosition& film) const { return strategies[choices[tiles.tile(film)]]; }
};

}  // namespace bdpt
