#include "transport/start_pilot.h"

#include "transport/block.h"
#include "transport/region_grid.h"

namespace bdpt {

namespace {

constexpr uint32_t kPerLight = 64, kLeast = 8192, kMost = 65536;  // samples
constexpr uint32_t kBlock = 256;
constexpr double kByPower = 0.1;  // of the probabilities found
constexpr double kKnown = 4;      // starts of a light, as many as count no less than its power does

// What one start of a light delivered to a region.
struct Delivery {
  uint32_t light, region;
  float value;
};

std::vector<double> by_power(const Lights& lights) {
  std::vector<double> power;
  for (size_t i = 0; i < lights.count(); ++i) power.push_back(double(lights.choice(int(i), {})));
  return power;
}

// The pilot's own choice: half by power, half each alike, but none that is black.
Discrete mixed(const std::vector<double>& power) {
  std::vector<double> weights = power;
  for (double& w : weights)
    if (w > 0) w = 0.5 * w + 0.5 / double(power.size());
  return Discrete(weights);
}

// Veach's plan, whichever will be rendered by: each light subpath has one eye subpath.
TransportOptions pilot_options(const Engine& engine) {
  TransportOptions options = engine.options;
  options.plan = nullptr;
  options.techniques = engine.strategy.techniques;
  options.connections = options.pool_passes = 0;
  options.light_samples = options.direct_samples = options.direct_candidates = 1;
  options.shadow_roulette = Roulette::None;
  return options;
}

class Deliveries {
 public:
  explicit Deliveries(const Engine& engine)
      : engine_(engine), grid_(engine.bounds), brightness_(grid_.count()), starts_(engine.scene.lights().count()) {}

  void add(const std::vector<Contribution>& contributions, const LightSubpaths& light) {
    for (const LightStart& start : light.starts)
      if (start.y0.light >= 0) ++starts_[size_t(start.y0.light)];
    samples_ += double(light.count());
    for (const Contribution& c : contributions) {
      const uint32_t region = uint32_t(grid_.region(c.film));
      brightness_[region] += double(norm(c.value));
      if (engine_.belongs_to_eye(c.t) && c.s < 2) continue;  // no light subpath
      const int from = light.starts[c.sample].y0.light;
      all_.push_back({uint32_t(from), region, norm(c.value) * engine_.starts.probability(size_t(from))});
    }
  }

  // E[c^2] of a start of each light.
  std::vector<double> second_moments(const std::vector<double>& power) const {
    const std::vector<double> tolerance = tolerances();
    std::vector<double> sums(starts_.size());
    for (const Delivery& d : all_)
      if (tolerance[d.region] > 0) sums[d.light] += double(d.value) * double(d.value) / tolerance[d.region];
    // A light of which little is known is what others of its power are.
    double delivered = 0, expected = 0;
    for (size_t i = 0; i < sums.size(); ++i) delivered += sums[i], expected += double(starts_[i]) * power[i] * power[i];
    const double alike = expected > 0 ? delivered / expected : 0;
    for (size_t i = 0; i < sums.size(); ++i)
      sums[i] = (sums[i] + kKnown * alike * power[i] * power[i]) / (double(starts_[i]) + kKnown);
    return sums;
  }

 private:
  // mean^2 + 0.01 M^2 of each region.
  std::vector<double> tolerances() const {
    const double pixels = double(engine_.bounds.count());
    std::vector<double> result(grid_.count());
    double all = 0;
    for (double b : brightness_) all += b / samples_;
    for (int row = 0; row < grid_.rows(); ++row)
      for (int column = 0; column < grid_.columns(); ++column) {
        const PixelRect r = grid_.rect(column, row);
        const size_t i = size_t(row) * size_t(grid_.columns()) + size_t(column);
        const double mean = brightness_[i] / samples_ * pixels / (double(r.x1 - r.x0) * (r.y1 - r.y0));
        result[i] = mean * mean + 0.01 * all * all;
      }
    return result;
  }

  const Engine& engine_;
  RegionGrid grid_;
  std::vector<double> brightness_;
  std::vector<uint64_t> starts_;
  std::vector<Delivery> all_;
  double samples_ = 0;
};

Discrete probabilities(std::vector<double> moments, const std::vector<double>& power) {
  double sum = 0;
  for (double& m : moments) sum += m = std::sqrt(m);
  if (!(sum > 0) || !std::isfinite(sum)) return {};
  for (size_t i = 0; i < moments.size(); ++i) moments[i] = (1 - kByPower) * moments[i] / sum + kByPower * power[i];
  return Discrete(moments);
}

}  // namespace

StartPilot pilot_starts(const Engine& engine) {
  const Lights& lights = engine.scene.lights();
  StartPilot result;
  if (lights.empty() || lights.count() < 2 || engine.max_light == 0) return result;
  const std::vector<double> power = by_power(lights);
  Engine pilot(engine.scene, engine.sensor, engine.film, pilot_options(engine), engine.seed);
  pilot.starts = mixed(power);
  const uint32_t samples = uint32_t(std::clamp<uint64_t>(kPerLight * lights.count(), kLeast, kMost));
  Deliveries deliveries(pilot);
  Block block(pilot);
  std::vector<StreamPair> streams(kBlock);
  for (uint32_t first = 0; first < samples; first += kBlock) {
    for (uint32_t i = 0; i < kBlock; ++i)
      streams[i] = {Stream(hash_values(engine.seed, 16), first + i), Stream(hash_values(engine.seed, 17), first + i)};
    deliveries.add(block.sample_film(streams), block.light());
  }
  result.stats = block.take_stats();
  result.starts = probabilities(deliveries.second_moments(power), power);
  return result;
}

}  // namespace bdpt
