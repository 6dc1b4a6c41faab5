// What a film says: its layers, coverage and error, from its sums.
#include "film/film.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

// The accumulators of pixels that lie side by side, added over groups.
struct Film::GroupSums {
  const Accumulator* first;  // of the first pixel in the first group
  size_t count, size;        // pixels, and accumulators of each
  size_t groups, stride;
  const Accumulator* partial;  // of the pass in hand, if that is wanted

  // Accumulator i of each pixel, into every step-th of values.
  void read(size_t i, double* values, size_t step) const {
    const Accumulator* sums = first + i;
    for (size_t k = 0; k < count; ++k, sums += size, values += step)
      *values = sum(sums, partial ? partial + i + k * size : nullptr);
  }

 private:
  double sum(const Accumulator* sums, const Accumulator* more) const {
    int64_t word = 0;
    if (more && !more->add_to(word)) return wide_sum(sums, more);
    for (const Accumulator *a = sums, *end = sums + groups * stride; a != end; a += stride)
      if (!a->add_to(word)) return wide_sum(sums, more);
    return Accumulator::value_of(word);
  }
  [[gnu::noinline]] double wide_sum(const Accumulator* sums, const Accumulator* more) const {
    Accumulator sum = more ? *more : Accumulator{};
    for (size_t g = 0; g < groups; ++g) sum.add(sums[g * stride]);
    return sum.value();
  }
};

namespace {

// Veach's I_j = (|D| / N) I_j^L + I_j^E, the sums scaled as (10.10) or (10.11) say. With |D| the number of pixels
// sampled and as many samples in a pass, |D| / N is one over the number of passes.
struct Sums {
  double eye[3] = {}, light[3] = {}, weight = 0, samples = 0;

  // Of as many pixels as there are in the groups' sums.
  template <class GroupSums>
  static void read(const PixelLayout& layout, size_t plane, bool unfiltered, const GroupSums& from, Sums* sums) {
    constexpr size_t step = sizeof(Sums) / sizeof(double);
    for (size_t c = 0; c < 3; ++c) from.read(layout.eye(plane) + c, &sums->eye[c], step);
    if (layout.one_image) return;
    for (size_t c = 0; c < 3; ++c) from.read(layout.light(plane) + c, &sums->light[c], step);
    from.read(unfiltered ? layout.own_weight() : layout.weight(), &sums->weight, step);
    if (layout.counts) from.read(layout.samples(), &sums->samples, step);
  }
  void add(const Sums& o) {
    for (size_t c = 0; c < 3; ++c) eye[c] += o.eye[c], light[c] += o.light[c];
    weight += o.weight;
    samples += o.samples;
  }
  double eye_scale(bool by_weights, double passes) const {
    if (by_weights && weight != 0) return weight > 0 ? 1 / weight : 0;
    return passes > 0 ? 1 / passes : 0;
  }
};

}  // namespace

Film::GroupSums Film::all_groups(size_t pixel, size_t count, bool include_partial) const {
  const size_t size = layout_.size();
  return {sums_of(0, pixel),    count,           size,
          size_t(desc_.groups), pixels() * size, include_partial ? &pass_[pixel * size] : nullptr};
}
Film::GroupSums Film::one_group(int group, size_t pixel) const {
  return {sums_of(group, pixel), 1, layout_.size(), 1, 1, nullptr};
}

// Reads the mean of a pixel and the variance of this mean, both from the groups of passes that hold any.
class Film::GroupReader {
 public:
  explicit GroupReader(const Film& film) : film_(film) {
    for (int g = 0; g < film.desc_.groups; ++g)
      if (const double n = double(film.passes_in_group(g)); n > 0) {
        groups_[filled_++] = {g, n};
        all_ += n;
      }
  }
  size_t filled() const { return filled_; }

  // Needs two filled groups.
  void read(size_t pixel, size_t plane, double color[3], double variance[3]) const {
    const bool by_weights = film_.desc_.normalize_by_weights;
    Sums whole;
    double mean[3] = {}, square[3] = {};
    for (size_t i = 0; i < filled_; ++i) {
      const Group& g = groups_[i];
      Sums sums;
      Sums::read(film_.layout_, plane, film_.is_unfiltered(plane), film_.one_group(g.index, pixel), &sums);
      whole.add(sums);
      const double scale = sums.eye_scale(by_weights, g.passes), w = g.passes / all_;
      for (int c = 0; c < 3; ++c) {
        const double v = sums.eye[c] * scale + sums.light[c] / g.passes;
        mean[c] += w * v, square[c] += w * v * v;
      }
    }
    const double scale = whole.eye_scale(by_weights, all_);
    for (int c = 0; c < 3; ++c) {
      color[c] = whole.eye[c] * scale + whole.light[c] / all_;
      variance[c] = std::max(0.0, square[c] - mean[c] * mean[c]) / double(filled() - 1);
    }
  }

 private:
  struct Group {
    int index;
    double passes;
  };
  const Film& film_;
  Group groups_[kMaxGroups];  // no allocation: threads of the host's read, too
  size_t filled_ = 0;
  double all_ = 0;
};

void Film::read(FilmLayer layer, int s, int t, const PixelRect& rect, bool include_partial, float* out,
                size_t row_stride, int plane_index) const {
  const size_t plane = size_t(plane_index);
  include_partial = include_partial && partial_;
  if (layer == FilmLayer::Rejected) return read_rejected(rect, include_partial, out, row_stride);
  const double whole = double(passes() + (include_partial ? recipe_.pool_passes : 0));
  const double per_pass = whole > 0 ? 1 / whole : 0;
  const GroupReader groups(*this);

  const auto read_pixel = [&](size_t pixel, const Sums& sums, float* p) {
    const double eye = sums.eye_scale(desc_.normalize_by_weights, whole);
    double rgb[3] = {};
    switch (layer) {
      case FilmLayer::Color:
        for (int c = 0; c < 3; ++c) rgb[c] = sums.eye[c] * eye + sums.light[c] * per_pass;
        break;
      case FilmLayer::Eye:
        for (int c = 0; c < 3; ++c) rgb[c] = sums.eye[c] * eye;
        break;
      case FilmLayer::Light:
        for (int c = 0; c < 3; ++c) rgb[c] = sums.light[c] * per_pass;
        break;
      case FilmLayer::Technique: {
        const size_t i = size_t(technique_index(s, t)) * pixels() + pixel;
        const double scale = t >= 2 ? eye : per_pass;
        for (int c = 0; c < 3; ++c)
          rgb[c] = (pyramid_[i].rgb[c].value() + (include_partial ? pyramid_pass_[i].rgb[c].value() : 0)) * scale;
        break;
      }
      case FilmLayer::Variance: {
        double color[3];
        if (groups.filled() >= 2) groups.read(pixel, plane, color, rgb);
        break;
      }
      case FilmLayer::Samples:
        for (int c = 0; c < 3; ++c) rgb[c] = sums.samples;
        break;
      case FilmLayer::Rejected:
        break;
    }
    for (int c = 0; c < 3; ++c) p[c] = float(rgb[c]);
  };

  constexpr int kRun = 64;
  Sums sums[kRun];
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; x += kRun) {
      const size_t first = size_t(y) * size_t(desc_.width) + size_t(x), count = size_t(std::min(kRun, rect.x1 - x));
      Sums::read(layout_, plane, is_unfiltered(plane), all_groups(first, count, include_partial), sums);
      float* p = out + size_t(y - rect.y0) * row_stride + size_t(x - rect.x0) * 3;
      for (size_t i = 0; i < count; ++i, p += 3) read_pixel(first + i, sums[i], p);
    }
}

void Film::read_rejected(const PixelRect& rect, bool include_partial, float* out, size_t row_stride) const {
  for (int y = 0; y < rect.y1 - rect.y0; ++y) std::fill_n(out + size_t(y) * row_stride, 3 * rect.width(), 0.0f);
  const auto add = [&](const PixelCounts& counts) {
    for (const auto& [pixel, count] : counts) {
      const int x = int(pixel % uint64_t(desc_.width)), y = int(pixel / uint64_t(desc_.width));
      if (x < rect.x0 || x >= rect.x1 || y < rect.y0 || y >= rect.y1) continue;
      float* p = out + size_t(y - rect.y0) * row_stride + size_t(x - rect.x0) * 3;
      for (int c = 0; c < 3; ++c) p[c] += float(count);
    }
  };
  add(rejected_in_);
  if (include_partial) add(rejected_pass_in_);
}

std::vector<Film::Covered> Film::read_coverage(size_t coverage, const PixelRect& rect, size_t ranks,
                                               bool include_partial, double& lost) const {
  include_partial = include_partial && partial_;
  std::vector<Covered> result;
  result.reserve(rect.count() * ranks);
  double all = 0, left_out = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) {
      const size_t pixel = size_t(y) * size_t(desc_.width) + size_t(x);
      PixelCoverage covered = coverage_[coverage * pixels() + pixel];
      if (include_partial) covered.add(pass_coverage_[coverage * pixels() + pixel]);
      Sums sums;
      Sums::read(layout_, 0, false, all_groups(pixel, 1, include_partial), &sums);
      std::sort(std::begin(covered.slots), std::end(covered.slots), [](const CoverageSlot& a, const CoverageSlot& b) {
        return a.samples != b.samples ? a.samples > b.samples : a.id < b.id;
      });
      for (size_t i = 0; i < ranks; ++i)
        if (i < PixelCoverage::kSlots && covered.slots[i].samples > 0)
          result.push_back({covered.slots[i].id, double(covered.slots[i].samples) / sums.samples});
        else
          result.push_back({0, 0});
      left_out += double(covered.lost);
      for (size_t i = ranks; i < PixelCoverage::kSlots; ++i) left_out += double(covered.slots[i].samples);
      all += sums.samples;
    }
  lost = all > 0 ? left_out / all : 0;
  return result;
}

double Film::relative_error() const {
  const GroupReader reader(*this);
  if (reader.filled() < 2) return -1;
  struct Grey {
    float mean, variance;
  };
  std::vector<Grey> greys(pixels());
  double mean = 0;
  for (size_t i = 0; i < pixels(); ++i) {
    double color[3], variance[3];
    reader.read(i, 0, color, variance);
    greys[i] = {float((color[0] + color[1] + color[2]) / 3), float((variance[0] + variance[1] + variance[2]) / 3)};
    mean += greys[i].mean;
  }
  const double measured = double(desc_.measured > 0 ? desc_.measured : pixels());
  mean /= measured;
  if (!(mean > 0)) return 0;
  double sum = 0;
  for (const Grey& g : greys) sum += g.variance / (double(g.mean) * g.mean + 0.01 * mean * mean);
  return std::sqrt(sum / measured);
}

}  // namespace bdpt
