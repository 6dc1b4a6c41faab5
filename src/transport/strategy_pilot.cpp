#include "transport/strategy_pilot.h"

#include "sampling/hash.h"
#include "transport/plan.h"
#include "transport/region_grid.h"

namespace bdpt {

namespace {

// Of each tile so many pixels a side, so often that small images have enough samples, too.
constexpr int kSide = 2;
constexpr uint32_t kFewestPasses = 4, kMostPasses = 64, kFewestSamples = 1024;

// Costs, in rays that extend an eye subpath: by least squares over the times of scenes (docs/plans.md). An end's shadow
// ray comes with the connections that were weighed for it in vain.
constexpr double kLightRay = 1.1, kEnd = 0.95, kShadowRay = 0.6, kConnection = 0.35, kMatrixConnection = 0.4;

TransportOptions pilot_options(const TransportOptions& wanted) {
  TransportOptions options = wanted;
  options.plan = find_plan("one-to-one");
  options.heuristic = Heuristic::Balance;
  options.light_samples = 1;
  options.connections = 1;
  options.direct_candidates = 1;
  options.shadow_roulette = Roulette::None;
  return options;
}

// W_A of the shares of a path.
double part(const Candidate& a, const TechniqueShares& shares) {
  const double n = a.light_samples;
  const double inner =
      a.join == Join::Path || a.join == Join::TwoWay ? 0 : 1 - double(shares.eye) - double(shares.light);
  return double(shares.eye) + n * (double(shares.light) + std::max(0.0, inner));
}

// Whether a strategy joins a sample's own light subpaths to its vertex z_{t-1}: z_0 is a local sensor's.
bool joins(Join join, uint32_t t) { return t == 1 ? join != Join::Path : join >= Join::OneToOne; }

// The contributions of a sample with one strategy.
struct SampleSums {
  double ends = 0, own = 0, matrix = 0;                          // sums: s <= 1; inner, by either join
  double ends_squares = 0, own_squares = 0, matrix_squares = 0;  // of their terms
  double moment = 0;
};

}  // namespace

StrategyPilot::StrategyPilot(const Engine& engine)
    : engine_(engine.scene, engine.sensor, engine.film, pilot_options(engine.options), engine.seed),
      target_(engine),
      tiles_(engine.bounds),
      passes_(std::clamp(uint32_t(kFewestSamples / (kSide * kSide * tiles_.count())), kFewestPasses, kMostPasses)),
      measures_(tiles_.count()),
      light_(size_t(tiles_.rows())) {
  engine_.starts = engine.starts;
  engine_.tell_shares();
}

TransportStats StrategyPilot::run(uint32_t row) {
  Block block(engine_);
  LightImage& light = light_[row];
  light.squares.resize(tiles_.count());
  light.sums.resize(tiles_.count());
  for (int column = 0; column < tiles_.columns(); ++column) run_tile(block, column, int(row), light);
  return block.take_stats();
}

void StrategyPilot::run_tile(Block& block, int column, int row, LightImage& light) {
  const PixelRect r = tiles_.pixels(column, row);
  TileMeasure& tile = measures_[size_t(row) * size_t(tiles_.columns()) + size_t(column)];
  tile.pixels = double(engine_.measured(r));
  if (tile.pixels == 0) return;
  PixelRect square = square_within(r, kSide, hash_values(engine_.seed, 9, row, column));
  for (uint32_t i = 1; engine_.measured(square) == 0; ++i)  // where something is measured
    square = square_within(r, kSide, hash_values(engine_.seed, 9, row, column, i));
  const size_t pixels = size_t(engine_.measured(square)), samples = pixels * passes_;

  std::vector<std::array<SampleSums, kCandidates.size()>> sums(samples);
  const auto add = [&](const Contribution& c, double SampleSums::*sum, double SampleSums::*squares, double moment) {
    const double v = double(norm(c.value));
    for (size_t a = 0; a < kCandidates.size(); ++a) {
      const double share = part(kCandidates[a], c.shares);
      SampleSums& s = sums[c.sample][a];
      s.moment += moment * v * v / share;
      if (c.s >= 2 && !joins(kCandidates[a].join, c.t)) continue;
      s.*sum += v / share;
      s.*squares += v * v / (share * share);
    }
  };

  // Ends.
  const TransportStats before = block.stats();
  const auto shadow_rays = [&] {
    double direct = 0;
    for (uint32_t t = 1; t < 32; ++t)
      if (engine_.belongs_to_eye(t)) direct += double(block.techniques().at(1, t).shadow_rays);
    return direct;
  };
  const auto start_rays = [&] {
    double rays = 0;
    for (uint32_t s = 2; s < 32 && engine_.local; ++s) rays += double(block.techniques().at(s, 1).shadow_rays);
    return rays;
  };
  const double direct_before = shadow_rays();
  for (const Contribution& c : block.sample_pilot_ends(passes_, square)) {
    // Lights seen directly are the same to all, and so bright that a tile's mean says nothing of them.
    if (c.s + c.t == 2 && !engine_.local) continue;
    const double v = double(norm(c.value));
    if (engine_.belongs_to_eye(c.t)) {
      tile.mean += v / double(samples);
      add(c, &SampleSums::ends, &SampleSums::ends_squares, 1);
      continue;
    }
    const size_t there = tiles_.tile(c.film);
    light.sums[there] += v;
    for (size_t a = 0; a < kCandidates.size(); ++a) light.squares[there][a] += v * v / part(kCandidates[a], c.shares);
  }
  const TransportStats ends = block.stats();
  const double direct = shadow_rays() - direct_before;
  const double light_rays = double(ends.light_rays - before.light_rays);
  const double light_shadows = double(ends.shadow_rays - before.shadow_rays) - direct;
  light.cost += kLightRay * light_rays + kEnd * light_shadows;
  light.subpaths += double(samples);
  const double path = double(ends.eye_rays - before.eye_rays) + kEnd * direct;

  // Inner connections and those to a local sensor's z_0, one half of their moment from either join.
  const double start_rays_before = start_rays();
  for (const Contribution& c : block.join_pilot(*find_plan("one-to-one"))) {
    tile.mean += 0.5 * double(norm(c.value)) / double(samples);
    add(c, &SampleSums::own, &SampleSums::own_squares, 0.5);
  }
  const TransportStats own = block.stats();
  const double starts_cost = kEnd * (start_rays() - start_rays_before);
  for (const Contribution& c : block.join_pilot(*find_plan("matrix"))) {
    tile.mean += 0.5 * double(norm(c.value)) / double(samples);
    add(c, &SampleSums::matrix, &SampleSums::matrix_squares, 0.5);
  }
  const TransportStats matrix = block.stats();
  const double own_cost = kShadowRay * double(own.shadow_rays - ends.shadow_rays) +
                          kConnection * double(own.connections - ends.connections);
  const double matrix_cost = kShadowRay * double(matrix.shadow_rays - own.shadow_rays) +
                             kMatrixConnection * double(matrix.connections - own.connections);

  for (size_t a = 0; a < kCandidates.size(); ++a) {
    const Candidate& candidate = kCandidates[a];
    const double n = candidate.light_samples;
    double second = 0, mean_squares = 0;
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
      double sum = 0, squares = 0;
      for (size_t i = pixel; i < samples; i += pixels) {
        const SampleSums& s = sums[i][a];
        const bool is_matrix = candidate.join == Join::Matrix;
        const double inner = is_matrix ? s.matrix : s.own, inner_squares = is_matrix ? s.matrix_squares : s.own_squares;
        // Pairs of different contributions: of the ends, of ends and inner ones, of one light subpath, of two.
        second += s.moment + s.ends * s.ends - s.ends_squares + 2 * n * s.ends * inner +
                  n * (inner * inner - inner_squares) + n * (n - 1) * s.own * s.matrix;
        const double value = s.ends + n * inner;
        sum += value, squares += value * value;
      }
      mean_squares += (sum * sum - squares) / (double(passes_) * double(passes_ - 1));
    }
    tile.variance[a] = second / double(samples) - mean_squares / double(pixels);
    tile.cost[a] = (path + (candidate.join == Join::OneToOne ? n * own_cost
                            : candidate.join == Join::Matrix ? n * matrix_cost
                                                             : n * starts_cost)) /
                   double(samples);
  }
}

std::vector<TileMeasure> StrategyPilot::measures(double& light_cost) const {
  std::vector<TileMeasure> measures = measures_;
  double subpaths = 0;
  light_cost = 0;
  for (const LightImage& light : light_) light_cost += light.cost, subpaths += light.subpaths;
  light_cost /= subpaths;
  for (size_t i = 0; i < measures.size(); ++i) {
    TileMeasure& tile = measures[i];
    if (tile.pixels == 0) continue;
    // The light subpaths of a pass for one of the pilot's.
    const double scale = double(engine_.samples_per_pass()) / subpaths / tile.pixels;
    for (const LightImage& light : light_) {
      tile.mean += scale * light.sums[i];
      for (size_t a = 0; a < kCandidates.size(); ++a) tile.variance[a] += scale * light.squares[i][a];
    }
  }
  return measures;
}

}  // namespace bdpt
