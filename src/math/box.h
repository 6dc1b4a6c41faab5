// Boxes along the axes.
#pragma once

#include "math/vec.h"

#include <array>
#include <limits>

namespace bdpt {

struct Box {
  Vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

  bool empty() const { return low.x > high.x; }
  void grow(const Vec3& p) {
    low = Vec3(std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z));
    high = Vec3(std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z));
  }
  void grow(const Vec3& center, float radius) {
    grow(center - Vec3(radius));
    grow(center + Vec3(radius));
  }
  void grow(const Box& box) {
    grow(box.low);
    grow(box.high);
  }
  std::array<Vec3, 8> corners() const {
    std::array<Vec3, 8> corners;
    for (size_t i = 0; i < 8; ++i)
      corners[i] = Vec3((i & 1 ? high : low).x, (i & 2 ? high : low).y, (i & 4 ? high : low).z);
    return corners;
  }
};

}  // namespace bdpt
