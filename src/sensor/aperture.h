// The hole that light passes: a disk, or a regular polygon within it. All in units of its radius.
#pragma once

#include "sampling/warp.h"

#include <algorithm>

namespace bdpt {

struct Aperture {
  int blades = 0;      // 0 = round
  float rotation = 0;  // radians

  double area() const { return blades == 0 ? M_PI : 0.5 * blades * std::sin(2 * M_PI / blades); }

  Vec2 sample(const float u[2]) const {
    if (blades == 0) return sample_disk(u[0], u[1]);
    // One of n triangles round the centre, then a point of it.
    const float scaled = u[0] * float(blades);
    const int blade = std::min(int(scaled), blades - 1);
    const Vec2 b = sample_triangle(scaled - float(blade), u[1]);
    const float a0 = kTwoPi * float(blade) / float(blades) + rotation, a1 = a0 + kTwoPi / float(blades);
    return Vec2(std::cos(a0), std::sin(a0)) * b.x + Vec2(std::cos(a1), std::sin(a1)) * b.y;
  }

  bool contains(const Vec2& p) const {
    if (blades == 0) return p.x * p.x + p.y * p.y <= 1;
    const float sector = kTwoPi / float(blades);
    float angle = std::atan2(p.y, p.x) - rotation;
    angle -= sector * std::floor(angle / sector);
    return std::sqrt(p.x * p.x + p.y * p.y) * std::cos(angle - sector / 2) <= std::cos(sector / 2);
  }
};

}  // namespace bdpt
