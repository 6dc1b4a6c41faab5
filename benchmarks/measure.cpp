// SPDX-License-Identifier: Apache-2.0
#include "measure.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "integrator.h"
#include "process_memory.h"
#include "ray_log.h"
#include "render_run.h"
#include "timing.h"
#include "variance.h"

namespace bdpt_benchmark {
namespace {

// The renders of one integrator, and what they took.
struct Contestant {
  Integrator integrator;
  RayLog rays;
  bdpt::TransportStats stats;  // of all timed passes
  double stats_seconds = 0;
  std::vector<double> render, sample, replay, scaling, replay_scaling, variance_seconds;
  ImageVariance variance;

  explicit Contestant(Integrator i) : integrator(std::move(i)) {}
};

class SceneBenchmark {
 public:
  SceneBenchmark(const SceneFile& file, const Options& options, bdpt_tool::Diagnostics& diagnostics)
      : options_(options), before_(resident_now()) {
    say(file.name, "reading");
    scene_ = load_scene(file, options.width, options.threads, diagnostics, reset_resident_peak);
    all_ = bdpt::make_pool(options.threads);
    one_ = bdpt::make_pool(1);
    for (const Integrator& integrator : integrators()) contestants_.push_back(std::make_unique<Contestant>(integrator));
  }

  SceneResult run() {
    SceneResult result;
    result.name = scene_.name;
    result.width = static_cast<std::uint32_t>(scene_.sensor->width());
    result.height = static_cast<std::uint32_t>(scene_.sensor->height());
    result.triangles = scene_.scene->info().triangles;
    result.memory = measure_memory();  // first: the rays that are kept later are not the library's
    measure_time();
    measure_variance();
    for (const auto& contestant : contestants_) result.integrators.push_back(summary(*contestant));
    return result;
  }

 private:
  static void say(const std::string& scene, const char* what) { std::fprintf(stderr, "%s: %s\n", scene.c_str(), what); }

  MemoryResult measure_memory() const {
    RenderRun run(scene_, contestants_.back()->integrator, all_);
    run.advance(1);
    MemoryResult memory;
    memory.context_peak = scene_.meter->peak();
    memory.process_peak = resident_peak();
    memory.process_before = before_;
    memory.film = run.film_bytes();
    memory.embree = scene_.scene->info().memory_embree;
    memory.arrays = scene_.array_bytes();
    const double process = double(memory.process_peak) - double(before_);
    memory.used = std::max(process, double(memory.context_peak)) - double(memory.film);
    memory.allowed = 1.3 * double(memory.embree + memory.arrays) + 64.0 * 1024 * 1024;
    return memory;
  }

  // The passes that are recorded, rendered on an executor.
  Timing render(const Contestant& contestant, const std::shared_ptr<bdpt::Executor>& executor) const {
    RenderRun run(scene_, contestant.integrator, executor);
    run.advance(std::uint64_t(options_.warm_passes));
    return run.advance(std::uint64_t(options_.timed_passes));
  }

  void record(Contestant& contestant) const {
    RenderRun run(scene_, contestant.integrator, one_);  // one thread: block after block
    run.advance(std::uint64_t(options_.warm_passes));
    run.advance(std::uint64_t(options_.timed_passes), &contestant.rays);
  }

  // Everything that is compared takes turns, so that a disturbance hits all alike.
  void measure_time() {
    say(scene_.name, "recording rays");
    for (const auto& c : contestants_) record(*c);
    say(scene_.name, "renders and replays in turn");
    for (int round = 0; round < options_.rounds; ++round)
      for (const auto& c : contestants_) {
        const Timing all = render(*c, all_);
        const double replay_all = c->rays.replay(*scene_.scene, *all_);
        const Timing one = render(*c, one_);
        const double replay_one = c->rays.replay(*scene_.scene, *one_);
        c->render.push_back(all.seconds);
        c->sample.push_back(all.seconds / double(all.stats.samples));
        c->replay.push_back(replay_all);
        c->scaling.push_back(one.seconds / all.seconds);
        c->replay_scaling.push_back(replay_one / replay_all);
        c->stats += all.stats;
        c->stats_seconds += all.seconds;
      }
  }

  void measure_variance() {
    say(scene_.name, "variance");
    for (int seed = 0; seed < options_.seeds; ++seed)
      for (const auto& c : contestants_) {
        RenderRun run(scene_, c->integrator, all_, std::uint64_t(seed) + 1);
        c->variance_seconds.push_back(run.advance(std::uint64_t(options_.variance_passes)).seconds);
        c->variance.add(run.grey_image());
      }
  }

  StageShares shares(const Contestant& c) const {
    const bdpt::TransportStats& s = c.stats;
    const double whole = c.stats_seconds * double(options_.threads);
    StageShares shares{s.start / whole,       (s.extend - s.extend_rays) / whole,
                       s.extend_rays / whole, s.connect / whole,
                       s.shadow / whole,      s.accumulate / whole};
    shares.rest = 1 - (s.start + s.extend + s.connect + s.shadow + s.accumulate) / whole;
    return shares;
  }

  // Ratios are medians of ratios within one round.
  static double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> ratios(a.size());
    std::transform(a.begin(), a.end(), b.begin(), ratios.begin(), [](double x, double y) { return x / y; });
    return median(std::move(ratios));
  }

  IntegratorResult summary(const Contestant& c) const {
    IntegratorResult result;
    result.name = c.integrator.name;
    const double per_second = 1 / (median(c.render) * options_.rounds);
    result.samples_per_second = double(c.stats.samples) * per_second;
    result.eye_rays_per_second = double(c.stats.eye_rays) * per_second;
    result.light_rays_per_second = double(c.stats.light_rays) * per_second;
    result.shadow_rays_per_second = double(c.stats.shadow_rays) * per_second;
    result.stages = shares(c);
    result.replayed_rays = c.rays.size();
    result.replay_ratio = median_ratio(c.render, c.replay);
    result.cost = median_ratio(c.sample, contestants_.front()->sample);
    result.image_mean = c.variance.image_mean();
    result.relative_variance = c.variance.relative();
    result.variance_seconds = median(c.variance_seconds);
    result.efficiency = 1 / (result.relative_variance * result.variance_seconds);
    result.scaling = median(c.scaling);
    result.replay_scaling = median(c.replay_scaling);
    return result;
  }

  const Options& options_;
  std::uint64_t before_;
  LoadedScene scene_;
  std::shared_ptr<bdpt::Executor> all_, one_;
  std::vector<std::unique_ptr<Contestant>> contestants_;
};

}  // namespace

SceneResult measure_scene(const SceneFile& file, const Options& options, bdpt_tool::Diagnostics& diagnostics) {
  return SceneBenchmark(file, options, diagnostics).run();
}

}  // namespace bdpt_benchmark
