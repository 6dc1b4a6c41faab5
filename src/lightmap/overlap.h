// Triangles that lie on one another in texture space.
#pragma once

#include "math/uv_raster.h"

#include <functional>
#include <vector>

namespace bdpt {

// What two triangles share: convex.
struct UvOverlap {
  size_t a = 0, b = 0;  // a < b
  std::vector<Vec2d> corners;
  double area = 0;  // texels
};

// Two triangles overlap if they share more than a thousandth of the smaller one's area and more than this, in texels:
// neighbours whose common corners are rounded apart do not.
inline constexpr double kLeastOverlap = 1e-5;

// Calls visit for each pair that overlaps, in an order of its own, until it returns false. Triangles have an area.
// height: of the atlas, where most of them are.
void for_each_overlap(const std::vector<UvTriangle>& triangles, double height,
                      const std::function<bool(const UvOverlap&)>& visit);

}  // namespace bdpt
