// A picture that a light shines by: bilinear between the middles of its texels.
#pragma once

#include "geometry/texture.h"
#include "math/vec.h"

#include <memory>

namespace bdpt {

class Picture {
 public:
  // Values are multiplied by scale. wraps: the left and right edges meet; else, and above and below, the last texels
  // go on.
  Picture(std::shared_ptr<const Texture> texture, const Rgb& scale, bool wraps)
      : texture_(std::move(texture)), scale_(scale), wraps_(wraps) {}

  uint32_t width() const { return texture_->width(); }
  uint32_t height() const { return texture_->height(); }
  // In texels from the left and from the top.
  Rgb at(float x, float y) const {
    x -= 0.5f, y -= 0.5f;
    const float fx = std::floor(x), fy = std::floor(y), wx = x - fx, wy = y - fy;
    const int64_t x0 = int64_t(fx), y0 = int64_t(fy);
    return (texel(x0, y0) * (1 - wx) + texel(x0 + 1, y0) * wx) * (1 - wy) +
           (texel(x0, y0 + 1) * (1 - wx) + texel(x0 + 1, y0 + 1) * wx) * wy;
  }
  // norm() of the mean of at() over a texel: what is linear between middles has 1/8, 6/8 and 1/8 of three. Above 0
  // wherever something within the texel is.
  double mean(uint32_t x, uint32_t y) const {
    constexpr float kPart[] = {0.125f, 0.75f, 0.125f};
    Rgb sum;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) sum += texel(int64_t(x) + i, int64_t(y) + j) * (kPart[i + 1] * kPart[j + 1]);
    return double(norm(sum));
  }

 private:
  Rgb texel(int64_t x, int64_t y) const {
    const int64_t w = width(), h = height();
    x = wraps_ ? (x + w) % w : std::clamp<int64_t>(x, 0, w - 1);
    return to_rgb(texture_->texel(uint32_t(x), uint32_t(std::clamp<int64_t>(y, 0, h - 1)))) * scale_;
  }

  std::shared_ptr<const Texture> texture_;
  Rgb scale_;
  bool wraps_;
};

}  // namespace bdpt
