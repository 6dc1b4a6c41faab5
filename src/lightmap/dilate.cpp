#include "lightmap/dilate.h"

#include "lightmap/neighbors.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bdpt {
namespace {

class Dilator {
 public:
  explicit Dilator(const DilateImage& image) : image_(image), slots_(size_t(image.width) * image.height, kOriginal) {
    for (size_t i = 0; i < slots_.size(); ++i) {
      if (image_.mask[i] && is_finite(i)) continue;
      if (image_.mask[i]) result_.not_finite.push_back(i);
      slots_[i] = kEmpty;
    }
  }

  Dilation run(uint32_t steps) {
    std::vector<size_t> candidates;
    for (size_t i = 0; i < slots_.size(); ++i)
      if (is_empty(i)) candidates.push_back(i);
    const size_t empty = candidates.size();
    for (uint32_t step = 0; step < steps && !candidates.empty(); ++step) candidates = fill(candidates);
    result_.left = empty - result_.texels.size();
    return std::move(result_);
  }

 private:
  // Where a texel's value is: nowhere, nowhere but among the candidates, in the image, or in the result at this place.
  static constexpr uint32_t kEmpty = 0xFFFFFFFFu, kCandidate = 0xFFFFFFFEu, kOriginal = 0xFFFFFFFDu;

  bool is_empty(size_t texel) const { return slots_[texel] > kOriginal; }
  bool is_finite(size_t texel) const {
    const float* v = image_.pixels + texel * image_.channels;
    return std::all_of(v, v + image_.channels, [](float x) { return std::isfinite(x); });
  }
  const float* value(size_t texel) const {
    return slots_[texel] == kOriginal ? image_.pixels + texel * image_.channels
                                      : result_.values.data() + size_t(slots_[texel]) * image_.channels;
  }
  // An empty texel's, too.
  uint32_t chart(size_t texel) const {
    if (!image_.charts) return 0;
    return slots_[texel] < kOriginal ? result_.charts[slots_[texel]] : image_.charts[texel];
  }

  // One step. Returns the empty texels next to those that were filled.
  std::vector<size_t> fill(const std::vector<size_t>& candidates) {
    const size_t before = result_.texels.size();
    for (const size_t texel : candidates)
      if (const std::optional<uint32_t> chart = choose_chart(texel)) add_mean(texel, *chart);
    for (size_t i = before; i < result_.texels.size(); ++i) slots_[result_.texels[i]] = uint32_t(i);
    for (const size_t texel : candidates)
      if (is_empty(texel)) slots_[texel] = kEmpty;
    std::vector<size_t> next;
    for (size_t i = before; i < result_.texels.size(); ++i)
      for_each_neighbor(result_.texels[i], image_.width, image_.height, [&](size_t n) {
        if (slots_[n] != kEmpty) return;
        slots_[n] = kCandidate;
        next.push_back(n);
      });
    return next;
  }

  std::optional<uint32_t> choose_chart(size_t texel) const {
    uint32_t charts[8];
    int n = 0;
    const uint32_t own = chart(texel);
    for_each_neighbor(texel, image_.width, image_.height, [&](size_t i) {
      if (!is_empty(i) && (own == 0 || chart(i) == own)) charts[n++] = chart(i);
    });
    if (n == 0) return std::nullopt;
    if (!image_.charts) return 0;
    uint32_t best = charts[0];
    std::ptrdiff_t most = 0;
    for (int i = 0; i < n; ++i) {
      const std::ptrdiff_t votes = std::count(charts, charts + n, charts[i]);
      if (votes > most || (votes == most && charts[i] < best)) most = votes, best = charts[i];
    }
    return best;
  }

  void add_mean(size_t texel, uint32_t chart_id) {
    sum_.assign(image_.channels, 0);
    int n = 0;
    for_each_neighbor(texel, image_.width, image_.height, [&](size_t i) {
      if (is_empty(i) || chart(i) != chart_id) return;
      const float* v = value(i);
      for (uint32_t c = 0; c < image_.channels; ++c) sum_[c] += v[c];
      ++n;
    });
    for (const double sum : sum_) result_.values.push_back(float(sum / n));
    result_.texels.push_back(texel);
    result_.charts.push_back(chart_id);
  }

  const DilateImage& image_;
  std::vector<uint32_t> slots_;
  std::vector<double> sum_;
  Dilation result_;
};

}  // namespace

Dilation dilate(const DilateImage& image, uint32_t steps) { return Dilator(image).run(steps); }

}  // namespace bdpt
