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
