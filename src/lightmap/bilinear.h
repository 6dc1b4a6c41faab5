// The texels that a bilinear lookup reads. Values sit at the centres of texels; lookups clamp to the image.
#pragma once

#include "math/uv_raster.h"

namespace bdpt {

struct Footprint {
  size_t texels[4];
  double weights[4];  // add up to 1; zero for texels that are not read
};

// point: in texels, within the image.
inline Footprint bilinear_footprint(const Vec2d& point, uint32_t width, uint32_t height) {
  const double x = std::clamp(point.x - 0.5, 0.0, double(width - 1)),
               y = std::clamp(point.y - 0.5, 0.0, double(height - 1));
  const size_t x0 = size_t(x), y0 = size_t(y);
  const size_t x1 = std::min<size_t>(x0 + 1, width - 1), y1 = std::min<size_t>(y0 + 1, height - 1);
  const double u = x - double(x0), v = y - double(y0);
  return {{y0 * width + x0, y0 * width + x1, y1 * width + x0, y1 * width + x1},
          {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v}};
}

}  // namespace bdpt
