// The film: measurements as exact sums. Sums are kept in wide fixed point, so that neither the order of work nor the
// merging of ranges can change a bit.
#pragma once

#include "base/memory.h"
#include "film/accumulator.h"
#include "film/coverage.h"
#include "film/filter.h"
#include "sensor/sensor.h"

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace bdpt {

inline constexpr int kMaxPlanes = 1024, kMaxGroups = 16;
inline constexpr int kMaxCameraPlanes = 64, kMaxCoverages = 2;

struct FilmDesc {
  int width = 1, height = 1;
  FilterDesc filter;
  bool normalize_by_weights = true;  // Veach (10.11); else by the number of samples (10.10)
  int groups = 2;
  int pyramid_edges = 0;
  int planes = 1;           // measurements of a pixel, three colours each
  bool one_image = false;   // the eye and the light image in one, scaled by the number of samples; box filter
  uint64_t measured = 0;    // pixels that measure anything; 0 = all
  uint64_t unfiltered = 0;  // of two images: planes, one bit each, whose samples count for their own pixel alone
  bool counts = false;      // of two images: the samples of each pixel are counted
  int coverages = 0;        // of a film that counts: kinds of ids
  uint64_t hash() const;
};

// What a film must keep of a sensor's outputs.
struct FilmPlanes {
  explicit FilmPlanes(int number) : planes(number) {}
  explicit FilmPlanes(const Sensor& sensor) : planes(sensor.planes()) {
    if (sensor.is_local()) return;
    for (const OutputPlanes& o : sensor.outputs()) {
      coverages += is_coverage(o.seen);
      if (o.unfiltered) unfiltered |= uint64_t(1) << o.first;
    }
    counts = sensor.outputs().size() > 1;
  }
  int planes, coverages = 0;
  uint64_t unfiltered = 0;
  bool counts = false;
};

// What a film was filled with; ranges of one recipe can be merged.
struct FilmRecipe {
  uint64_t seed = 0, scene_hash = 0, options_hash = 0;
  uint64_t samples_per_pass = 0;  // N of Veach (10.10): light subpaths, and eye subpaths, of a pass
  uint64_t pool_passes = 1;       // passes come so many at a time: [0, n), [n, 2n) ...
  bool operator==(const FilmRecipe&) const = default;
};

// Passes fall into independently scrambled groups, a pool's together. The index counts the passes of a group.
struct PassInGroup {
  uint64_t group, index;
};
inline PassInGroup pass_in_group(uint64_t pass, uint64_t pool_passes, int groups) {
  const uint64_t pool = pass / pool_passes, g = uint64_t(groups);
  return {pool % g, pool / g * pool_passes + pass % pool_passes};
}

// The pass at which it stands.
inline uint64_t pass_of(const PassInGroup& p, uint64_t pool_passes, int groups) {
  return (p.index / pool_passes * uint64_t(groups) + p.group) * pool_passes + p.index % pool_passes;
}

struct PassRange {
  uint64_t begin, end;  // [begin, end)
  bool operator==(const PassRange&) const = default;
};

struct RgbSums {
  Accumulator rgb[3];
};
// Where the sums of a pixel stand, one behind another: the planes of the eye image, its weight, and the planes of the
// light image; then the weight of unfiltered planes and the number of samples, if they are counted. Or plane by plane,
// if the two are one image.
struct PixelLayout {
  explicit PixelLayout(const FilmDesc& desc)
      : planes(size_t(desc.planes)), one_image(desc.one_image), counts(desc.counts) {}
  size_t planes;
  bool one_image, counts;
  size_t size() const { return one_image ? 3 * planes : 6 * planes + 1 + (counts ? 2 : 0); }
  size_t eye(size_t plane) const { return 3 * plane; }
  size_t weight() const { return 3 * planes; }
  size_t light(size_t plane) const { return one_image ? 3 * plane : 3 * planes + 1 + 3 * plane; }
  size_t own_weight() const { return 6 * planes + 1; }
  size_t samples() const { return 6 * planes + 2; }
};

enum class FilmLayer { Color, Eye, Light, Variance, Technique, Rejected, Samples };

class Film {
 public:
  Film(const FilmDesc& desc, std::shared_ptr<MemoryMeter> meter);

  const FilmDesc& desc() const { return desc_; }
  const Filter& filter() const { return filter_; }
  // The pixels that must be sampled: those of the film and a margin by the filter's radius.
  PixelRect sample_bounds() const;

  bool is_empty() const { return ranges_.empty(); }
  const FilmRecipe& recipe() const { return recipe_; }
  const std::vector<PassRange>& ranges() const { return ranges_; }  // disjoint, ascending, not touching
  uint64_t passes() const;
  uint64_t rejected() const { return rejected_; }
  static uint64_t bytes_for(const FilmDesc& desc);

  // One render at a time may fill a film.
  bool acquire() { return !in_use_.exchange(true); }
  void release() { in_use_ = false; }
  bool is_in_use() const { return in_use_; }

  // --- Filling, by src/render. Contributions go to the pass in hand; end_pass adds it to its group. ---
  void begin(const FilmRecipe& recipe);  // throws Mismatch if the film holds another recipe
  // Thread-safe, but for two eye samples of one pixel. s and t say which image of the pyramid gets the contribution,
  // too.
  void add_eye_sample(const FilmPosition& film, const Rgb& value) { add_eye_sample(film, &value, 1); }
  // For `weight` samples that find this in the mean; the values are their sum, one for each plane.
  void add_eye_sample(const FilmPosition& film, const Rgb* values, float weight);
  void add_light_sample(const FilmPosition& film, const Rgb& value, size_t plane = 0);
  // Of the eye image, but of no pixel: an eye image of such samples alone is normalised by their number.
  void add_free_eye_sample(const FilmPosition& film, const Rgb& value);
  // What an eye sample met, for its own pixel; by one thread for each pixel.
  void add_coverage(size_t coverage, const FilmPosition& film, uint64_t id) {
    if (is_inside(film)) pass_coverage_[coverage * pixels() + own(film)].add(id, 1);
  }
  void add_technique_sample(int s, int t, const FilmPosition& film, const Rgb& value);
  // Counts a contribution that was left out before it came here. Thread-safe.
  void reject(const FilmPosition& film);
  bool has_technique(int s, int t) const { return s + t >= 2 && s + t - 1 <= desc_.pyramid_edges; }
  // The pass in hand is `pass` and those that come with it.
  void end_pass(uint64_t pass, int row_begin, int row_end);  // folds these rows; rows in parallel
  void commit_pass(uint64_t pass);                           // after all rows are folded
  void discard_pass();                                       // forgets the pass in hand
  void set_partial(bool partial) { partial_ = partial; }     // whether the pass in hand holds finished blocks

  // --- Reading ---
  // Writes 3 floats per pixel to rows `row_stride` floats apart.
  void read(FilmLayer layer, int s, int t, const PixelRect& rect, bool include_partial, float* pixels,
            size_t row_stride, int plane = 0) const;
  // The ids of each pixel, those of most samples first, `ranks` for each; the rest has no samples. Parts are of all
  // samples of the pixel. What no rank names is counted, as parts of the samples of all these pixels.
  struct Covered {
    uint64_t id;
    double part;
  };
  std::vector<Covered> read_coverage(size_t coverage, const PixelRect& rect, size_t ranks, bool include_partial,
                                     double& lost) const;
  // Square root of the mean relative variance of the first plane; -1 while unknown.
  double relative_error() const;

  void clear();
  void merge(const Film& source);  // throws Mismatch

  void save(const std::string& path) const;
  static std::unique_ptr<Film> load(const std::string& path, std::shared_ptr<MemoryMeter> meter);

 private:
  int technique_index(int s, int t) const {
    const int k = s + t - 1;
    return (k - 1) * (k + 4) / 2 + s;
  }
  int technique_count() const {
    const int k = desc_.pyramid_edges;
    return k * (k + 5) / 2;
  }
  size_t pixels() const { return size_t(desc_.width) * desc_.height; }
  template <class Add>
  void splat(const FilmPosition& film, Add&& add);
  void add_sample(size_t place, const FilmPosition& film, const Rgb& value);
  void add_planes(const FilmPosition& film, const Rgb* values, float weight);
  bool is_unfiltered(size_t plane) const { return desc_.unfiltered >> plane & 1; }
  bool is_inside(const FilmPosition& film) const {
    return film.x >= 0 && film.y >= 0 && film.x < float(desc_.width) && film.y < float(desc_.height);
  }
  size_t own(const FilmPosition& film) const { return size_t(film.y) * size_t(desc_.width) + size_t(film.x); }
  struct GroupSums;
  class GroupReader;
  GroupSums all_groups(size_t pixel, size_t count, bool include_partial) const;
  GroupSums one_group(int group, size_t pixel) const;
  const Accumulator* sums_of(int group, size_t pixel) const {
    return sums_.data() + (size_t(group) * pixels() + pixel) * layout_.size();
  }
  uint64_t passes_in_group(int group) const;
  void read_rejected(const PixelRect& rect, bool include_partial, float* pixels, size_t row_stride) const;

  FilmDesc desc_;
  Filter filter_;
  Booking booking_;
  FilmRecipe recipe_;
  std::vector<PassRange> ranges_;
  PixelLayout layout_;
  std::vector<Accumulator> sums_;  // groups x pixels x layout
  std::vector<Accumulator> pass_;  // of the pass in hand
  std::vector<RgbSums> pyramid_;   // techniques x pixels
  std::vector<RgbSums> pyramid_pass_;
  std::vector<PixelCoverage> coverage_, pass_coverage_;  // coverages x pixels
  // Contributions left out, of all and of pixels that have any.
  using PixelCounts = std::map<uint64_t, uint64_t>;
  std::mutex rejected_mutex_;
  uint64_t rejected_pass_ = 0, rejected_ = 0;
  PixelCounts rejected_pass_in_, rejected_in_;
  bool partial_ = false;
  bool own_pixel_ = false;  // an eye sample counts for its own pixel only
  std::atomic<bool> in_use_{false};
};

}  // namespace bdpt
