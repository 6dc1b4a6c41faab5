// A picture that a light shines by: bilinear between the middles of its texels.
#pragma once

#include "geometry/texture.h"
#include "math/vec.h"

#include <memory>
#include <vector>

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
  // norm() of the mean of at() over each texel, row by row. Above 0 wherever something within the texel is.
  std::vector<float> means() const {
    std::vector<float> means;
    means.reserve(size_t(width()) * height());
    std::vector<Rgb> above = across(-1), here = across(0);
    for (uint32_t y = 0; y < height(); ++y) {
      std::vector<Rgb> below = across(int64_t(y) + 1);
      for (uint32_t x = 0; x < width(); ++x) means.push_back(norm(mean_of(above[x], here[x], below[x])));
      above = std::move(here), here = std::move(below);
    }
    return means;
  }

 private:
  // Of what is linear between the middles of three texels: over the second of them.
  static Rgb mean_of(const Rgb& a, const Rgb& b, const Rgb& c) { return (a + c) * 0.125f + b * 0.75f; }
  // The means of a row along x.
  std::vector<Rgb> across(int64_t y) const {
    const int64_t w = width();
    std::vector<Rgb> row, means;
    for (int64_t x = -1; x <= w; ++x) row.push_back(texel(x, y));
    for (int64_t x = 1; x <= w; ++x) means.push_back(mean_of(row[x - 1], row[x], row[x + 1]));
    return means;
  }
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
