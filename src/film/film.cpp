#include "film/film.h"

#include "base/error.h"
#include "sampling/hash.h"

#include <cmath>

namespace bdpt {

uint64_t FilmDesc::hash() const {
  uint64_t h = hash_values(width, height, int(filter.type), normalize_by_weights, groups, pyramid_edges);
  if (one_image) h = hash_combine(h, hash_values(planes, measured));
  if (counts) h = hash_combine(h, hash_values(planes, unfiltered, coverages));
  const float numbers[] = {filter.radius, filter.a, filter.b};
  return hash_bytes(numbers, sizeof(numbers), h);
}

uint64_t Film::bytes_for(const FilmDesc& desc) {
  const uint64_t pixels = uint64_t(desc.width) * uint64_t(desc.height);
  const uint64_t k = uint64_t(desc.pyramid_edges);
  return pixels * (sizeof(Accumulator) * PixelLayout(desc).size() * uint64_t(desc.groups + 1) +
                   sizeof(RgbSums) * 2 * (k * (k + 5) / 2) + sizeof(PixelCoverage) * 2 * uint64_t(desc.coverages));
}

Film::Film(const FilmDesc& desc, std::shared_ptr<MemoryMeter> meter)
    : desc_(desc), filter_(desc.filter), booking_(std::move(meter), bytes_for(desc), "the film"), layout_(desc) {
  desc_.filter.radius = filter_.radius();
  if (desc_.one_image) desc_.normalize_by_weights = false;
  own_pixel_ = !desc.one_image && desc.filter.type == FilterType::Box && filter_.radius() == 0.5f;
  sums_.resize(pixels() * layout_.size() * size_t(desc.groups));
  pass_.resize(pixels() * layout_.size());
  pyramid_.resize(pixels() * size_t(technique_count()));
  pyramid_pass_.resize(pyramid_.size());
  coverage_.resize(pixels() * size_t(desc.coverages));
  pass_coverage_.resize(coverage_.size());
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

void Film::add_eye_sample(const FilmPosition& film, const Rgb* values, float weight) {
  if (desc_.one_image) {
    for (size_t plane = 0; plane < size_t(desc_.planes); ++plane) add_sample(layout_.eye(plane), film, values[plane]);
    return;
  }
  if (desc_.counts) return add_planes(film, values, weight);
  const Rgb& value = values[0];
  const bool ok = fits(value);
  if (!ok) reject(film);
  if (own_pixel_) {  // no other thread samples this pixel
    const int x = int(film.x), y = int(film.y);
    Accumulator* sums = &pass_[(size_t(y) * size_t(desc_.width) + size_t(x)) * layout_.size()];
    if (ok) add_own(sums[0], value.r), add_own(sums[1], value.g), add_own(sums[2], value.b);
    if (desc_.normalize_by_weights) add_own(sums[layout_.weight()], weight);
    return;
  }
  splat(film, [&](size_t pixel, float h) {
    Accumulator* sums = &pass_[pixel * layout_.size()];
    if (ok) add_rgb(sums, value * h);
    if (desc_.normalize_by_weights) sums[layout_.weight()].add_shared(Accumulator::steps(h * weight));
  });
}

void Film::add_planes(const FilmPosition& film, const Rgb* values, float weight) {
  const auto add_shared = [&](size_t pixel, size_t plane, float h) {
    add_rgb(&pass_[pixel * layout_.size() + layout_.eye(plane)], values[plane] * h);
  };
  uint64_t filtered = 0;
  for (size_t plane = 0; plane < layout_.planes; ++plane)
    if (!fits(values[plane]))
      reject(film);
    else if (!is_unfiltered(plane))
      filtered |= uint64_t(1) << plane;
    else if (is_inside(film))
      add_shared(own(film), plane, 1);
  splat(film, [&](size_t pixel, float h) {
    for (size_t plane = 0; plane < layout_.planes; ++plane)
      if (filtered >> plane & 1) add_shared(pixel, plane, h);
    if (desc_.normalize_by_weights)
      pass_[pixel * layout_.size() + layout_.weight()].add_shared(Accumulator::steps(h * weight));
  });
  if (!is_inside(film)) return;
  Accumulator* sums = &pass_[own(film) * layout_.size()];  // no other thread samples this pixel
  if (desc_.normalize_by_weights) add_own(sums[layout_.own_weight()], weight);
  add_own(sums[layout_.samples()], 1);
}

void Film::reject(const FilmPosition& film) {
  const std::lock_guard lock(rejected_mutex_);
  ++rejected_pass_;
  if (film.x >= 0 && film.y >= 0 && film.x < float(desc_.width) && film.y < float(desc_.height))
    ++rejected_pass_in_[uint64_t(film.y) * uint64_t(desc_.width) + uint64_t(film.x)];
}

void Film::add_sample(size_t place, const FilmPosition& film, const Rgb& value) {
  if (!fits(value)) {
    reject(film);
    return;
  }
  splat(film, [&](size_t pixel, float h) { add_rgb(&pass_[pixel * layout_.size() + place], value * h); });
}
void Film::add_light_sample(const FilmPosition& film, const Rgb& value, size_t plane) {
  if (!is_unfiltered(plane)) return add_sample(layout_.light(plane), film, value);
  if (!fits(value)) return reject(film);
  if (is_inside(film)) add_rgb(&pass_[own(film) * layout_.size() + layout_.light(plane)], value);
}
void Film::add_free_eye_sample(const FilmPosition& film, const Rgb& value) { add_sample(layout_.eye(0), film, value); }

void Film::add_technique_sample(int s, int t, const FilmPosition& film, const Rgb& value) {
  if (!has_technique(s, t) || !fits(value)) return;
  RgbSums* layer = pyramid_pass_.data() + size_t(technique_index(s, t)) * pixels();
  splat(film, [&](size_t pixel, float h) { add_rgb(layer[pixel].rgb, value * h); });
}

void Film::end_pass(uint64_t pass, int row_begin, int row_end) {
  const size_t first = size_t(row_begin) * size_t(desc_.width), last = size_t(row_end) * size_t(desc_.width);
  Accumulator* group =
      sums_.data() + size_t(pass_in_group(pass, recipe_.pool_passes, desc_.groups).group) * pass_.size();
  for (size_t i = first * layout_.size(); i < last * layout_.size(); ++i) {
    group[i].add(pass_[i]);
    pass_[i] = Accumulator{};
  }
  for (size_t c = 0; c < size_t(desc_.coverages); ++c)
    for (size_t i = c * pixels() + first; i < c * pixels() + last; ++i) {
      coverage_[i].add(pass_coverage_[i]);
      pass_coverage_[i] = PixelCoverage{};
    }
  for (size_t layer = 0; layer < size_t(technique_count()); ++layer)
    for (size_t i = layer * pixels() + first; i < layer * pixels() + last; ++i) {
      for (int c = 0; c < 3; ++c) pyramid_[i].rgb[c].add(pyramid_pass_[i].rgb[c]);
      pyramid_pass_[i] = RgbSums{};
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
  rejected_ += std::exchange(rejected_pass_, 0);
  for (const auto& [pixel, count] : rejected_pass_in_) rejected_in_[pixel] += count;
  rejected_pass_in_.clear();
  partial_ = false;
}

void Film::discard_pass() {
  if (!partial_) return;
  std::fill(pass_.begin(), pass_.end(), Accumulator{});
  std::fill(pyramid_pass_.begin(), pyramid_pass_.end(), RgbSums{});
  std::fill(pass_coverage_.begin(), pass_coverage_.end(), PixelCoverage{});
  rejected_pass_ = 0;
  rejected_pass_in_.clear();
  partial_ = false;
}

namespace {

// Veach's I_j = (|D| / N) I_j^L + I_j^E, the sums scaled as (10.10) or (10.11) say. With |D| the number of pixels
// sampled and as many samples in a pass, |D| / N is one over the number of passes.
struct Sums {
  double eye[3] = {}, light[3] = {}, weight = 0, samples = 0;
  Sums() = default;
  // sum(i) is accumulator i of the pixel's layout.
  template <class Sum>
  Sums(const PixelLayout& layout, size_t plane, bool unfiltered, const Sum& sum) {
    for (size_t c = 0; c < 3; ++c) eye[c] = sum(layout.eye(plane) + c).value();
    if (layout.one_image) return;
    for (size_t c = 0; c < 3; ++c) light[c] = sum(layout.light(plane) + c).value();
    weight = sum(unfiltered ? layout.own_weight() : layout.weight()).value();
    if (layout.counts) samples = sum(layout.samples()).value();
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

// A pixel's accumulators, of all groups together, and of the pass in hand if that is wanted.
struct Film::AllOf {
  const Film& film;
  bool include_partial;
  auto operator()(size_t pixel) const {
    return [this, pixel](size_t i) {
      Accumulator sum = include_partial ? film.pass_[pixel * film.layout_.size() + i] : Accumulator{};
      for (int g = 0; g < film.desc_.groups; ++g) sum.add(film.sums_of(g, pixel)[i]);
      return sum;
    };
  }
};

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
      const Accumulator* of_group = film_.sums_of(g.index, pixel);
      const Sums sums(film_.layout_, plane, film_.is_unfiltered(plane), [&](size_t j) { return of_group[j]; });
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
  const AllOf all_of{*this, include_partial};

  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) {
      const size_t pixel = size_t(y) * size_t(desc_.width) + size_t(x);
      const Sums sums(layout_, plane, is_unfiltered(plane), all_of(pixel));
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
      float* p = out + size_t(y - rect.y0) * row_stride + size_t(x - rect.x0) * 3;
      for (int c = 0; c < 3; ++c) p[c] = float(rgb[c]);
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
  const AllOf all_of{*this, include_partial};
  double all = 0, left_out = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) {
      const size_t pixel = size_t(y) * size_t(desc_.width) + size_t(x);
      PixelCoverage covered = coverage_[coverage * pixels() + pixel];
      if (include_partial) covered.add(pass_coverage_[coverage * pixels() + pixel]);
      const Sums sums(layout_, 0, false, all_of(pixel));
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

void Film::clear() {
  std::fill(sums_.begin(), sums_.end(), Accumulator{});
  std::fill(pyramid_.begin(), pyramid_.end(), RgbSums{});
  std::fill(coverage_.begin(), coverage_.end(), PixelCoverage{});
  partial_ = true;
  discard_pass();
  ranges_.clear();
  recipe_ = FilmRecipe{};
  rejected_ = 0;
  rejected_in_.clear();
}

void Film::merge(const Film& source) {
  if (&source == this) fail(ErrorCode::InvalidArgument, "source: it is the destination");
  if (desc_.hash() != source.desc_.hash())
    fail(ErrorCode::Mismatch, "source: it has another size, filter, normalization, groups, pyramid or outputs");
  if (source.is_empty()) return;
  if (!is_empty() && !(recipe_ == source.recipe_))
    fail(ErrorCode::Mismatch, "source: it was rendered from another scene, with another seed or with other options");
  std::vector<PassRange> all = ranges_, united;
  all.insert(all.end(), source.ranges_.begin(), source.ranges_.end());
  if (!unite(all, united)) fail(ErrorCode::Mismatch, "source: some of its passes are in the destination already");
  recipe_ = source.recipe_;
  ranges_ = std::move(united);
  rejected_ += source.rejected_;
  for (const auto& [pixel, count] : source.rejected_in_) rejected_in_[pixel] += count;
  for (size_t i = 0; i < sums_.size(); ++i) sums_[i].add(source.sums_[i]);
  for (size_t i = 0; i < pyramid_.size(); ++i)
    for (int c = 0; c < 3; ++c) pyramid_[i].rgb[c].add(source.pyramid_[i].rgb[c]);
  for (size_t i = 0; i < coverage_.size(); ++i) coverage_[i].add(source.coverage_[i]);
}

}  // namespace bdpt
