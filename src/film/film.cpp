#include "film/film.h"

#include "base/error.h"
#include "sampling/hash.h"

#include <cmath>

namespace bdpt {

uint64_t FilmDesc::hash() const {
  uint64_t h = hash_values(width, height, int(filter.type), normalize_by_weights, groups, pyramid_edges);
  const float numbers[] = {filter.radius, filter.a, filter.b};
  return hash_bytes(numbers, sizeof(numbers), h);
}

uint64_t Film::bytes_for(const FilmDesc& desc) {
  const uint64_t pixels = uint64_t(desc.width) * uint64_t(desc.height);
  const uint64_t k = uint64_t(desc.pyramid_edges);
  return pixels * (sizeof(PixelSums) * uint64_t(desc.groups + 1) + sizeof(TechniqueSums) * 2 * (k * (k + 5) / 2));
}

Film::Film(const FilmDesc& desc, std::shared_ptr<MemoryMeter> meter)
    : desc_(desc), filter_(desc.filter), booking_(std::move(meter), bytes_for(desc), "the film") {
  desc_.filter.radius = filter_.radius();
  own_pixel_ = desc.filter.type == FilterType::Box && filter_.radius() == 0.5f;
  sums_.resize(pixels() * size_t(desc.groups));
  pass_.resize(pixels());
  pyramid_.resize(pixels() * size_t(technique_count()));
  pyramid_pass_.resize(pyramid_.size());
}

PixelRect Film::sample_bounds() const {
  const int margin = int(std::ceil(filter_.radius() - 0.5f));
  return {-margin, -margin, desc_.width + margin, desc_.height + margin};
}

uint64_t Film::passes() const {
  uint64_t n = 0;
  for (const PassRange& r : ranges_) n += r.end - r.begin;
  return n;
}

uint64_t Film::passes_in_group(int group) const {
  const uint64_t pool = recipe_.pool_passes, g = uint64_t(desc_.groups);
  const auto below = [&](uint64_t end) {  // passes p < end of this group; end is a multiple of the pool
    const uint64_t pools = end / pool;
    return (pools / g + (pools % g > uint64_t(group) ? 1 : 0)) * pool;
  };
  uint64_t n = 0;
  for (const PassRange& r : ranges_) n += below(r.end) - below(r.begin);
  return n;
}

void Film::begin(const FilmRecipe& recipe) {
  if (!is_empty() && !(recipe_ == recipe)) {
    const char* what = recipe_.scene_hash != recipe.scene_hash ? "another scene"
                       : recipe_.seed != recipe.seed           ? "another seed"
                                                               : "another sensor or other options";
    fail(ErrorCode::Mismatch, "film: it was filled with ", what, "; clear it, or take a new one");
  }
  recipe_ = recipe;
}

// Calls add(pixel, h_j) for each pixel j whose filter covers the position.
template <class Add>
void Film::splat(const FilmPosition& film, Add&& add) {
  const float r = filter_.radius();
  const int x0 = std::max(0, int(std::ceil(film.x - 0.5f - r))),
            x1 = std::min(desc_.width - 1, int(std::floor(film.x - 0.5f + r)));
  const int y0 = std::max(0, int(std::ceil(film.y - 0.5f - r))),
            y1 = std::min(desc_.height - 1, int(std::floor(film.y - 0.5f + r)));
  float hx[20];
  for (int x = x0; x <= x1; ++x) hx[x - x0] = filter_(film.x - (float(x) + 0.5f));
  for (int y = y0; y <= y1; ++y) {
    const float hy = filter_(film.y - (float(y) + 0.5f));
    if (hy == 0) continue;
    for (int x = x0; x <= x1; ++x)
      if (const float h = hx[x - x0] * hy; h != 0) add(size_t(y) * size_t(desc_.width) + size_t(x), h);
  }
}

namespace {

bool fits(const Rgb& v) {
  return std::fabs(v.r) <= Accumulator::kMaximum && std::fabs(v.g) <= Accumulator::kMaximum &&
         std::fabs(v.b) <= Accumulator::kMaximum;  // false for NaN, too
}

void add_own(Accumulator& sum, float v) {
  if (v != 0) sum.add(Accumulator::of(v));
}

void add_rgb(Accumulator sums[3], const Rgb& v) {
  if (v.r != 0) sums[0].add_shared(Accumulator::steps(v.r));
  if (v.g != 0) sums[1].add_shared(Accumulator::steps(v.g));
  if (v.b != 0) sums[2].add_shared(Accumulator::steps(v.b));
}

}  // namespace

void Film::add_eye_sample(const FilmPosition& film, const Rgb& value, float weight) {
  const bool ok = fits(value);
  if (!ok) ++rejected_pass_;
  if (own_pixel_) {  // no other thread samples this pixel
    const int x = int(film.x), y = int(film.y);
    PixelSums& sums = pass_[size_t(y) * size_t(desc_.width) + size_t(x)];
    if (ok) add_own(sums.eye[0], value.r), add_own(sums.eye[1], value.g), add_own(sums.eye[2], value.b);
    if (desc_.normalize_by_weights) add_own(sums.weight, weight);
    return;
  }
  splat(film, [&](size_t pixel, float h) {
    PixelSums& sums = pass_[pixel];
    if (ok) add_rgb(sums.eye, value * h);
    if (desc_.normalize_by_weights) sums.weight.add_shared(Accumulator::steps(h * weight));
  });
}

void Film::add_sample(Accumulator (PixelSums::*image)[3], const FilmPosition& film, const Rgb& value) {
  if (!fits(value)) {
    ++rejected_pass_;
    return;
  }
  splat(film, [&](size_t pixel, float h) { add_rgb(pass_[pixel].*image, value * h); });
}
void Film::add_light_sample(const FilmPosition& film, const Rgb& value) { add_sample(&PixelSums::light, film, value); }
void Film::add_free_eye_sample(const FilmPosition& film, const Rgb& value) { add_sample(&PixelSums::eye, film, value); }

void Film::add_technique_sample(int s, int t, const FilmPosition& film, const Rgb& value) {
  if (!has_technique(s, t) || !fits(value)) return;
  TechniqueSums* layer = pyramid_pass_.data() + size_t(technique_index(s, t)) * pixels();
  splat(film, [&](size_t pixel, float h) { add_rgb(layer[pixel].rgb, value * h); });
}

void Film::end_pass(uint64_t pass, int row_begin, int row_end) {
  const size_t first = size_t(row_begin) * size_t(desc_.width), last = size_t(row_end) * size_t(desc_.width);
  PixelSums* group = sums_.data() + size_t(pass_in_group(pass, recipe_.pool_passes, desc_.groups).group) * pixels();
  for (size_t i = first; i < last; ++i) {
    for (int c = 0; c < 3; ++c) {
      group[i].eye[c].add(pass_[i].eye[c]);
      group[i].light[c].add(pass_[i].light[c]);
    }
    group[i].weight.add(pass_[i].weight);
    pass_[i] = PixelSums{};
  }
  for (size_t layer = 0; layer < size_t(technique_count()); ++layer)
    for (size_t i = layer * pixels() + first; i < layer * pixels() + last; ++i) {
      for (int c = 0; c < 3; ++c) pyramid_[i].rgb[c].add(pyramid_pass_[i].rgb[c]);
      pyramid_pass_[i] = TechniqueSums{};
    }
}

namespace {

// The union of disjoint ranges, joined where they touch; false where two overlap.
bool unite(std::vector<PassRange> all, std::vector<PassRange>& united) {
  std::sort(all.begin(), all.end(), [](const PassRange& a, const PassRange& b) { return a.begin < b.begin; });
  united.clear();
  for (const PassRange& r : all) {
    if (!united.empty() && r.begin < united.back().end) return false;
    if (!united.empty() && r.begin == united.back().end)
      united.back().end = r.end;
    else
      united.push_back(r);
  }
  return true;
}

}  // namespace

void Film::commit_pass(uint64_t pass) {
  std::vector<PassRange> all = ranges_;
  all.push_back({pass, pass + recipe_.pool_passes});
  if (!unite(all, ranges_)) fail(ErrorCode::Internal, "pass ", pass, " was rendered twice");
  rejected_ += rejected_pass_.exchange(0);
  partial_ = false;
}

void Film::discard_pass() {
  if (!partial_) return;
  std::fill(pass_.begin(), pass_.end(), PixelSums{});
  std::fill(pyramid_pass_.begin(), pyramid_pass_.end(), TechniqueSums{});
  rejected_pass_ = 0;
  partial_ = false;
}

namespace {

// Veach's I_j = (|D| / N) I_j^L + I_j^E, the sums scaled as (10.10) or (10.11) say. With |D| the number of pixels
// sampled and as many samples in a pass, |D| / N is one over the number of passes.
struct Sums {
  double eye[3] = {}, light[3] = {}, weight = 0;
  void add(const PixelSums& s) {
    for (int c = 0; c < 3; ++c) {
      eye[c] += s.eye[c].value();
      light[c] += s.light[c].value();
    }
    weight += s.weight.value();
  }
  double eye_scale(bool by_weights, double passes) const {
    if (by_weights && weight != 0) return weight > 0 ? 1 / weight : 0;
    return passes > 0 ? 1 / passes : 0;
  }
};

}  // namespace

void Film::read_group(int group, size_t pixel, double rgb[3]) const {
  Sums sums;
  sums.add(sums_[size_t(group) * pixels() + pixel]);
  const double passes = double(passes_in_group(group));
  const double scale = sums.eye_scale(desc_.normalize_by_weights, passes);
  for (int c = 0; c < 3; ++c) rgb[c] = sums.eye[c] * scale + (passes > 0 ? sums.light[c] / passes : 0);
}

void Film::read(FilmLayer layer, int s, int t, const PixelRect& rect, bool include_partial, float* out,
                size_t row_stride) const {
  include_partial = include_partial && partial_;
  const double whole = double(passes() + (include_partial ? recipe_.pool_passes : 0));
  const double per_pass = whole > 0 ? 1 / whole : 0;
  std::vector<double> group_passes;
  for (int g = 0; g < desc_.groups; ++g) group_passes.push_back(double(passes_in_group(g)));
  int filled = 0;
  for (double n : group_passes) filled += n > 0;

  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) {
      const size_t pixel = size_t(y) * size_t(desc_.width) + size_t(x);
      Sums sums;
      for (int g = 0; g < desc_.groups; ++g) sums.add(sums_[size_t(g) * pixels() + pixel]);
      if (include_partial) sums.add(pass_[pixel]);
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
          if (filled < 2) break;
          double mean[3] = {}, square[3] = {};
          for (int g = 0; g < desc_.groups; ++g) {
            if (group_passes[size_t(g)] == 0) continue;
            double v[3];
            read_group(g, pixel, v);
            const double w = group_passes[size_t(g)] / double(passes());
            for (int c = 0; c < 3; ++c) mean[c] += w * v[c], square[c] += w * v[c] * v[c];
          }
          for (int c = 0; c < 3; ++c) rgb[c] = std::max(0.0, square[c] - mean[c] * mean[c]) / (filled - 1);
          break;
        }
      }
      float* p = out + size_t(y - rect.y0) * row_stride + size_t(x - rect.x0) * 3;
      for (int c = 0; c < 3; ++c) p[c] = float(rgb[c]);
    }
}

double Film::relative_error() const {
  int filled = 0;
  for (int g = 0; g < desc_.groups; ++g) filled += passes_in_group(g) > 0;
  if (filled < 2) return -1;
  const PixelRect all{0, 0, desc_.width, desc_.height};
  std::vector<float> color(pixels() * 3), variance(pixels() * 3);
  read(FilmLayer::Color, 0, 0, all, false, color.data(), size_t(desc_.width) * 3);
  read(FilmLayer::Variance, 0, 0, all, false, variance.data(), size_t(desc_.width) * 3);
  const auto grey = [](const float* p) { return (double(p[0]) + p[1] + p[2]) / 3; };
  double mean = 0;
  for (size_t i = 0; i < pixels(); ++i) mean += grey(&color[3 * i]);
  mean /= double(pixels());
  if (!(mean > 0)) return 0;
  double sum = 0;
  for (size_t i = 0; i < pixels(); ++i) {
    const double m = grey(&color[3 * i]);
    sum += grey(&variance[3 * i]) / (m * m + 0.01 * mean * mean);
  }
  return std::sqrt(sum / double(pixels()));
}

void Film::clear() {
  std::fill(sums_.begin(), sums_.end(), PixelSums{});
  std::fill(pyramid_.begin(), pyramid_.end(), TechniqueSums{});
  partial_ = true;
  discard_pass();
  ranges_.clear();
  recipe_ = FilmRecipe{};
  rejected_ = 0;
}

void Film::merge(const Film& source) {
  if (&source == this) fail(ErrorCode::InvalidArgument, "source: it is the destination");
  if (desc_.hash() != source.desc_.hash())
    fail(ErrorCode::Mismatch, "source: it has another size, filter, normalization, groups or pyramid");
  if (source.is_empty()) return;
  if (!is_empty() && !(recipe_ == source.recipe_))
    fail(ErrorCode::Mismatch, "source: it was rendered from another scene, with another seed or with other options");
  std::vector<PassRange> all = ranges_, united;
  all.insert(all.end(), source.ranges_.begin(), source.ranges_.end());
  if (!unite(all, united)) fail(ErrorCode::Mismatch, "source: some of its passes are in the destination already");
  recipe_ = source.recipe_;
  ranges_ = std::move(united);
  rejected_ += source.rejected_;
  for (size_t i = 0; i < sums_.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      sums_[i].eye[c].add(source.sums_[i].eye[c]);
      sums_[i].light[c].add(source.sums_[i].light[c]);
    }
    sums_[i].weight.add(source.sums_[i].weight);
  }
  for (size_t i = 0; i < pyramid_.size(); ++i)
    for (int c = 0; c < 3; ++c) pyramid_[i].rgb[c].add(source.pyramid_[i].rgb[c]);
}

}  // namespace bdpt
