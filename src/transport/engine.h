// What every block of a render shares: the scene, the sensor, the options, and what follows from them.
#pragma once

#include "film/film.h"
#include "sampling/sampler.h"
#include "scene/scene.h"
#include "sensor/sensor.h"
#include "transport/mis.h"
#include "transport/options.h"
#include "transport/sample_rates.h"
#include "transport/shadow_roulette.h"
#include "transport/stats.h"
#include "transport/strategy.h"

#include <optional>

namespace bdpt {

// Every ray that is traced, for benchmarks: what it would cost to trace them alone.
class RayRecorder {
 public:
  virtual ~RayRecorder() = default;
  // Thread-safe. shadow: only whether anything is in the way was asked.
  virtual void record(const Ray* rays, size_t count, bool shadow) = 0;
};

// The passes of pilots, from here on up: their subpaths share no number with any other.
inline constexpr uint64_t kPilotPass = 1ull << 63;

struct Engine {
  const Scene& scene;
  const Sensor& sensor;
  Film& film;
  TransportOptions options;
  DirectLighting direct_lighting;
  PixelRect bounds;  // the pixels whose eye subpaths are traced
  uint64_t seed;

  // What follows from the options.
  const Plan& plan;
  bool local;                      // sensor: t = 1 belongs to an eye subpath
  Strategy strategy;               // of all the image; where tiles have their own, all that any of them does
  std::optional<StrategyMap> map;  // of plans that choose by tiles, once they have chosen
  bool running_sums;               // else reference_weight()
  bool tells_shares = false;       // kept contributions know of Contribution::shares
  PowerHeuristic heuristic;
  bool unweighted;
  uint32_t max_eye, max_light;  // vertices of the subpaths; 0 = none are traced
  bool hit_sensor;              // whether t = 0 is done at all,
  bool land;                    // and where light lands on surfaces,
  bool cross;                   // or passes through volumes
  bool media;                   // whether media count in the scene
  Interior sensor_interior;     // what encloses a camera's z_0
  bool moves;                   // something moves: samples have times
  bool shares_time;             // of a whole pass, or of passes that come together: light of one sample meets others
  RayRecorder* recorder = nullptr;
  ShadowRoulette roulette;
  SampleRates rates;
  float light_weight = 1;  // of a light subpath, in the light image
  Discrete starts;         // of light subpaths: the lights' probabilities by importance, once a pilot has found it

  Engine(const Scene& scene, const Sensor& sensor, Film& film, const TransportOptions& options, uint64_t seed);

  bool allows(uint32_t s, uint32_t t) const { return strategy.allows(s, t); }
  // Whether what a technique measures belongs to an eye subpath; else it goes where light falls on the film.
  bool belongs_to_eye(uint32_t t) const { return t >= (local ? 1u : 2u); }
  // Whether a splat there takes the light subpath's sums without inner techniques. Where all tiles are alike the sums
  // know already.
  bool uses_outer(const Strategy& there) const { return map && !there.joins_inner(); }
  const Strategy& strategy_at(const FilmPosition& film) const { return map ? map->at(film) : strategy; }
  LightChoice light_choice() const {
    return {options.light_start == StartBy::Uniform, starts.empty() ? nullptr : &starts};
  }
  uint32_t max_edges() const { return options.max_edges > 0 ? uint32_t(options.max_edges) : ~0u; }
  uint64_t pool_passes;  // passes that come together, in one pool
  uint32_t pool_pixels;  // pixels of a block, where the result depends on them; else 0
  uint64_t samples_per_pass() const { return local ? sensor.count() : bounds.count(); }
  // The number of a pixel's sample among those of a pass; -1 where nothing is measured.
  int64_t sample_number(int x, int y) const {
    return local ? sensor.number(x, y) : int64_t(y - bounds.y0) * bounds.width() + (x - bounds.x0);
  }
  // The number of a pixel's eye subpaths among their streams.
  uint64_t eye_number(int x, int y) const {
    if (local) return sensor.place(x, y);
    return uint64_t(y - bounds.y0) * uint64_t(bounds.width()) + uint64_t(x - bounds.x0);
  }
  // How many pixels of a rectangle measure anything.
  uint64_t measured(const PixelRect& rect) const;
  uint64_t light_per_pass() const { return samples_per_pass() * uint64_t(options.light_samples); }
  void set_rates(const RegionGrid& grid, const std::vector<RegionMeasure>& eye, const std::vector<RegionMeasure>& all);
  // Whether something that an ImagePilot finds is still unknown.
  bool wants_pilot() const {
    return (options.shadow_roulette == Roulette::Efficiency && !roulette.plays()) ||
           (options.adaptive == Adaptive::TwoStages && !rates.are_set());
  }
  FilmRecipe recipe() const;
  // For plans whose counts depend on what a pilot finds. True if the mask says the same within each class.
  bool set_counts(double light_vertices);
  // The part of the image whose tiles chose a plan; 0 where tiles have no choice.
  float share(const Plan& plan) const;
  // What tiles do from now on. No sample may be under way.
  void choose(StrategyMap map);
  // For pilots by the balance heuristic: balance_shares() of all contributions.
  void tell_shares() { tells_shares = true, running_sums = false; }
  // A strategy of this engine's techniques for a plan, with other counts.
  Strategy make_strategy(const Plan& plan, const TransportOptions& counts, double light_vertices = 1) const;

  // The streams of random numbers of eye or light subpath `number` of a pass. Passes fall into independently scrambled
  // groups; an eye subpath's points belong to its pixel, a light subpath's to the whole pass.
  PassInGroup in_group(uint64_t pass) const;
  Stream eye_stream(uint64_t pass, uint64_t number) const;
  Stream light_stream(uint64_t pass, uint64_t number) const;
  Four draw(const Stream& stream, uint32_t vertex, Purpose purpose) const {
    const uint32_t group = dimension_group(int(vertex), purpose);
    return options.sampler == SamplerType::Sobol ? sobol4(stream, group) : independent4(stream, group);
  }
  // Times are within [0,1]. That of a pass, if samples share it; passes fill the time evenly.
  float time_of_pass(uint64_t pass) const;
  // The camera as it is then.
  EyeStart start_eye(const FilmPosition& film, const float lens[2], float time) const;
  bool sample_toward(const Vec3& x, const float lens[2], float time, SensorPoint& z0) const;
  bool hit_camera(const Ray& ray, float tmax, SensorPoint& z0) const;
  // Film position and lens of an eye subpath: {x in pixel, y in pixel, lens, lens}.
  Four draw_film(const Stream& stream, uint64_t pass, uint64_t number) const;

 private:
  void limit_subpaths();
};

}  // namespace bdpt
