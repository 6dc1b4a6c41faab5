// The brightest that a texture can be within a box of its coordinates, by a pyramid of maxima.
#pragma once

#include "geometry/texture.h"
#include "math/vec.h"

#include <array>
#include <vector>

namespace bdpt {

class LargestTexels {
 public:
  LargestTexels(const Texture& texture, const TextureSampler& sampler)
      : wrap_u_(sampler.wrap_u), wrap_v_(sampler.wrap_v) {
    // How far filters reach, in texels of the image.
    const int reach = sampler.filter == TextureFilter::Bicubic ? 2 : 1;
    reach_ = sampler.level > 0 ? (reach + 1) * std::exp2(std::ceil(double(sampler.level))) + 1 : reach;
    Level level{texture.width(), texture.height(), {}};
    for (uint32_t y = 0; y < level.height; ++y)
      for (uint32_t x = 0; x < level.width; ++x) level.values.push_back(norm(to_rgb(texture.texel(x, y))));
    levels_.push_back(std::move(level));
    while (levels_.back().width * levels_.back().height > 1) levels_.push_back(half(levels_.back()));
  }

  float within(const Vec2& low, const Vec2& high) const {
    const Range x = range(low.x, high.x, levels_[0].width), y = range(1 - high.y, 1 - low.y, levels_[0].height);
    float largest = 0;
    for (const Span& row : spans(y, levels_[0].height, wrap_v_))
      for (const Span& column : spans(x, levels_[0].width, wrap_u_)) largest = std::max(largest, within(column, row));
    return largest;
  }

 private:
  struct Level {
    uint32_t width, height;
    std::vector<float> values;
  };
  struct Range {
    double low, high;
  };
  struct Span {
    uint32_t first = 1, last = 0;  // with both; nothing
  };

  static Level half(const Level& from) {
    Level to{(from.width + 1) / 2, (from.height + 1) / 2, {}};
    to.values.resize(size_t(to.width) * to.height);
    for (uint32_t y = 0; y < from.height; ++y)
      for (uint32_t x = 0; x < from.width; ++x) {
        float& value = to.values[size_t(y / 2) * to.width + x / 2];
        value = std::max(value, from.values[size_t(y) * from.width + x]);
      }
    return to;
  }
  // In texels.
  Range range(float low, float high, uint32_t size) const {
    return {std::floor(double(low) * size) - reach_, std::floor(double(high) * size) + reach_};
  }
  static std::array<Span, 2> spans(const Range& r, uint32_t size, TextureWrap wrap) {
    if (wrap == TextureWrap::Clamp) {
      const auto clamp = [&](double v) { return uint32_t(std::clamp(v, 0.0, double(size) - 1)); };
      return {Span{clamp(r.low), clamp(r.high)}, Span{}};
    }
    if (wrap == TextureWrap::Mirror && !(r.low >= 0 && r.high < size)) return {Span{0, size - 1}, Span{}};
    if (!(r.high - r.low < size)) return {Span{0, size - 1}, Span{}};
    const double first = r.low - std::floor(r.low / size) * size, last = first + (r.high - r.low);
    if (last < size) return {Span{uint32_t(first), uint32_t(last)}, Span{}};
    return {Span{uint32_t(first), size - 1}, Span{0, uint32_t(last) - size}};
  }
  float within(const Span& x, const Span& y) const {
    if (x.first > x.last || y.first > y.last) return 0;
    size_t l = 0;
    while (l + 1 < levels_.size() && std::max(x.last - x.first, y.last - y.first) >> l > 3) ++l;
    const Level& level = levels_[l];
    float largest = 0;
    for (uint32_t j = y.first >> l; j <= y.last >> l; ++j)
      for (uint32_t i = x.first >> l; i <= x.last >> l; ++i)
        largest = std::max(largest, level.values[size_t(j) * level.width + i]);
    return largest;
  }

  TextureWrap wrap_u_, wrap_v_;
  double reach_;
  std::vector<Level> levels_;
};

}  // namespace bdpt
