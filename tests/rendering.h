// Rendering for tests: films by pass, block means over independent seeds, and what it takes to compare them.
#pragma once

#include "render/render.h"
#include "scenes.h"
#include "statistics.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <sstream>
#include <string>
#include <thread>

namespace bdpt::rendering {

using statistics::Estimate;

// --- Techniques and options ---

inline TechniqueMask mask_of(const std::function<bool(int s, int t)>& allows) {
  TechniqueMask mask;
  for (int s = 0; s < 32; ++s)
    for (int t = 0; t < 32; ++t)
      if (!allows(s, t)) mask.rows[size_t(s)] &= ~(1u << t);
  return mask;
}
inline TechniqueMask only(int s0, int t0) {
  return mask_of([=](int s, int t) { return s == s0 && t == t0; });
}

inline std::string technique_name(int s, int t) {
  std::ostringstream name;
  name << '(' << s << ',' << t << ')';
  return name.str();
}

// Independent numbers: the errors of two renders are then those of independent samples.
inline TransportOptions options_for(const TechniqueMask& mask = {}, int max_edges = 0) {
  TransportOptions o;
  o.techniques = mask;
  o.max_edges = max_edges;
  o.sampler = SamplerType::Independent;
  return o;
}

// A box of one pixel, normalised by the number of samples: unbiased.
inline FilmDesc film_desc(int width, int height, int pyramid_edges = 0) {
  FilmDesc d;
  d.width = width, d.height = height;
  d.normalize_by_weights = false;
  d.groups = 1;
  d.pyramid_edges = pyramid_edges;
  return d;
}

// The film of a sensor.
inline FilmDesc film_for(const Sensor& sensor) {
  FilmDesc d = film_desc(sensor.width(), sensor.height());
  if (!sensor.is_local()) {
    const FilmPlanes planes(sensor);
    d.planes = planes.planes, d.counts = planes.counts, d.unfiltered = planes.unfiltered;
    d.coverages = planes.coverages;
    return d;
  }
  d.planes = sensor.planes();
  d.one_image = true;
  d.measured = sensor.count();
  return d;
}

// --- Renders ---

using ScenePointer = std::shared_ptr<const Scene>;
using SensorPointer = std::shared_ptr<const Sensor>;

inline std::shared_ptr<Executor> threads(uint32_t n = 2) {
  static std::map<uint32_t, std::shared_ptr<Executor>> pools;
  std::shared_ptr<Executor>& pool = pools[n];
  if (!pool) pool = make_pool(n);
  return pool;
}

// Renders of few pixels would wait for each other's threads at the end of every pass: they run on the caller's alone,
// and many of them side by side.
inline std::shared_ptr<Executor> caller() {
  HostExecutor host;
  host.run = [](void*, uint32_t n, void (*body)(void*, uint32_t), void* user) {
    for (uint32_t i = 0; i < n; ++i) body(user, i);
  };
  return make_host_executor(host);
}
inline void in_parallel(size_t count, const std::function<void(size_t)>& body) {
  std::atomic<size_t> next = 0;
  std::vector<std::jthread> workers;
  for (int i = 0; i < 2; ++i)
    workers.emplace_back([&] {
      for (size_t k; (k = next++) < count;) body(k);
    });
}

struct Picture {
  std::shared_ptr<Film> film;
  TransportStats stats;
};

inline Picture render(const ScenePointer& scene, const SensorPointer& sensor, const FilmDesc& film,
                      const RenderDesc& desc, uint64_t passes) {
  Picture picture{std::make_shared<Film>(film, nullptr), {}};
  Render render(scene, sensor, picture.film, caller(), nullptr, desc);
  AdvanceDesc advance;
  advance.passes = passes;
  render.advance(advance);
  picture.stats = render.stats();
  return picture;
}

inline Picture render(const ScenePointer& scene, const SensorPointer& sensor, const TransportOptions& options,
                      uint64_t passes, uint64_t seed) {
  RenderDesc desc;
  desc.transport = options;
  desc.seed = seed;
  return render(scene, sensor, film_for(*sensor), desc, passes);
}

inline std::vector<float> read(const Film& film, FilmLayer layer = FilmLayer::Color, int s = 0, int t = 0,
                               int plane = 0) {
  const int width = film.desc().width, height = film.desc().height;
  std::vector<float> pixels(size_t(width) * size_t(height) * 3);
  film.read(layer, s, t, {0, 0, width, height}, false, pixels.data(), size_t(width) * 3, plane);
  return pixels;
}

inline double grey(const float* rgb) { return (double(rgb[0]) + rgb[1] + rgb[2]) / 3; }

inline double mean_of(const Film& film) {
  const std::vector<float> pixels = read(film);
  double sum = 0;
  for (float v : pixels) sum += v;
  return sum / double(pixels.size());
}

// --- Block means over independent seeds ---

// The picture's squares of `side` pixels in grey, the three channels of the whole, and the whole: one estimate each.
struct BlockMeans {
  std::vector<Estimate> values;
  uint64_t rejected = 0;

  void add(const Film& film, int side) {
    const int width = film.desc().width, height = film.desc().height, columns = width / side;
    const std::vector<float> pixels = read(film);
    std::vector<double> sums(size_t(columns * (height / side)) + 4);
    const double block = double(side) * side, all = double(width) * height;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const float* p = &pixels[3 * (size_t(y) * size_t(width) + size_t(x))];
        sums[size_t(y / side * columns + x / side)] += grey(p) / block;
        for (size_t c = 0; c < 3; ++c) sums[sums.size() - 4 + c] += p[c] / all;
        sums.back() += grey(p) / all;
      }
    values.resize(sums.size());
    for (size_t i = 0; i < sums.size(); ++i) values[i].add(sums[i]);
    rejected += film.rejected();
  }
  const Estimate& whole() const { return values.back(); }
};

struct Effort {
  int seeds = 32;
  uint64_t passes = 4;
  uint64_t first_seed = 1;
  int side = 8;
};

inline BlockMeans block_means(const ScenePointer& scene, const SensorPointer& sensor, const FilmDesc& film,
                              const TransportOptions& options, const Effort& effort) {
  std::vector<Picture> pictures(static_cast<size_t>(effort.seeds));
  in_parallel(pictures.size(), [&](size_t i) {
    RenderDesc desc;
    desc.transport = options;
    desc.seed = effort.first_seed * 1000 + i;
    pictures[i] = render(scene, sensor, film, desc, effort.passes);
  });
  BlockMeans means;
  for (const Picture& p : pictures) {
    means.add(*p.film, effort.side);
    means.rejected += p.stats.rejected;
  }
  return means;
}
inline BlockMeans block_means(const ScenePointer& scene, const SensorPointer& sensor, const TransportOptions& options,
                              const Effort& effort) {
  return block_means(scene, sensor, film_for(*sensor), options, effort);
}

// Student's t with these degrees of freedom as a deviation of a normal distribution (Wallace 1959).
inline double normal_deviation(double t, double degrees) {
  return (8 * degrees + 1) / (8 * degrees + 3) * std::sqrt(degrees * std::log1p(t * t / degrees));
}

// The chance that two estimates of one value, or an estimate and the value, differ by more.
inline double chance(const Estimate& a, const Estimate& b) {
  const double va = a.variance() / double(a.count()), vb = b.variance() / double(b.count());
  if (a.mean() == b.mean()) return 1;
  if (!(va + vb > 0)) return 0;
  const double degrees = (va + vb) * (va + vb) / (va * va / double(a.count() - 1) + vb * vb / double(b.count() - 1));
  return 2 * statistics::normal_tail(normal_deviation((a.mean() - b.mean()) / std::sqrt(va + vb), degrees));
}
inline double chance(const Estimate& a, double value, double tolerance = 0) {
  const double t = statistics::deviation(a, value, tolerance);
  return 2 * statistics::normal_tail(normal_deviation(t, double(a.count() - 1)));
}

// Bonferroni: each of all comparisons of a family must be as likely as kSignificance over their number.
inline void expect_same(const BlockMeans& a, const BlockMeans& b, size_t family, const std::string& what) {
  ASSERT_EQ(a.values.size(), b.values.size());
  const double limit = statistics::kSignificance / double(family * a.values.size());
  for (size_t i = 0; i < a.values.size(); ++i)
    EXPECT_GT(chance(a.values[i], b.values[i]), limit)
        << what << ", value " << i << " of " << a.values.size() << ": " << a.values[i].mean() << " +- "
        << a.values[i].standard_error() << " and " << b.values[i].mean() << " +- " << b.values[i].standard_error();
  EXPECT_EQ(a.rejected + b.rejected, 0u) << what;
}

// Each against each other.
inline void expect_all_same(const std::vector<BlockMeans>& means, const std::vector<std::string>& names) {
  const size_t pairs = means.size() * (means.size() - 1) / 2;
  for (size_t i = 0; i < means.size(); ++i)
    for (size_t j = 0; j < i; ++j) expect_same(means[i], means[j], pairs, names[i] + " against " + names[j]);
}

// A part of the techniques that finds all paths, and how many passes tell.
struct TechniqueSet {
  const char* name;
  std::function<bool(int s, int t)> allows;
  uint64_t passes;
  const Plan* plan = nullptr;
};
inline std::vector<TechniqueSet> technique_sets(uint64_t passes) {
  return {{"path", [](int s, int) { return s <= 1; }, passes},
          {"light", [](int, int t) { return t <= 1; }, 2 * passes},
          {"bidirectional", [](int, int) { return true; }, passes},
          {"odd", [](int s, int t) { return s <= 1 || (s + t) % 2 == 1; }, 2 * passes}};
}

// Each gives the same picture, by paths of five edges at most, and rejects nothing.
inline void expect_one_picture(const ScenePointer& scene, const SensorPointer& sensor,
                               const std::vector<TechniqueSet>& sets) {
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const TechniqueSet& set : sets) {
    TransportOptions options = options_for(mask_of(set.allows), 5);
    options.plan = set.plan;
    means.push_back(block_means(scene, sensor, options, {.passes = set.passes, .first_seed = means.size() + 1}));
    EXPECT_EQ(means.back().rejected, 0u) << set.name;
    names.push_back(set.name);
  }
  expect_all_same(means, names);
}

// What GoogleTest takes for the name of a case.
inline std::string case_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
}

inline void expect_value(const Estimate& a, double value, size_t family, const std::string& what,
                         double tolerance = 0) {
  EXPECT_GT(chance(a, value, tolerance), statistics::kSignificance / double(family))
      << what << ": " << a.mean() << " +- " << a.standard_error() << " should be " << value;
}

}  // namespace bdpt::rendering
