// Which charts claim which texels.
#pragma once

#include "lightmap/charts.h"

namespace bdpt {

struct Atlas {
  uint32_t width = 0, height = 0;
  uint32_t number = 0;  // of the meshes that are in it

  size_t texels() const { return size_t(width) * height; }
  size_t texel(int64_t x, int64_t y) const { return size_t(y) * width + size_t(x); }
  TexelRect bounds() const { return {0, 0, width, height}; }
};

struct Claims {
  std::vector<uint32_t> charts;  // for each texel the chart with the largest part of it, the first of equals; 0 = none
  std::vector<uint32_t> counts;  // for each texel how many charts touch it
};

// A chart touches a texel if it reaches further into it than kTexelTolerance. Throws InvalidArgument where the
// triangles cover the atlas so many times that they were never unwrapped.
Claims find_claims(const std::vector<UvMesh>& meshes, const Charts& charts, const Atlas& atlas);

}  // namespace bdpt
