// The choice of strategies: the least product of the image's relative variance and cost. For a price of cost in terms
// of variance each tile chooses alone; the price of the optimum is variance over cost of the whole.
#include "transport/plan.h"
#include "transport/strategy_pilot.h"

namespace bdpt {

namespace {

constexpr int kSmooth = 1;               // tiles on either side whose measures are averaged
constexpr double kDark = 0.01;           // of the mean of all squared: keeps dark tiles from ruling the sum
constexpr double kLeastVariance = 0.02;  // of the second moment: few samples may show no variance at all
constexpr double kOverNone = 0.95;       // light subpaths must win by so much over none,
constexpr double kOverFewer = 0.9;       // and more of them over fewer
constexpr int kRounds = 12;

// Relative variance and cost of a tile's pixels, by candidates.
struct TileTerms {
  std::array<double, kCandidates.size()> error{}, cost{};
};

struct Choice {
  std::vector<uint8_t> candidates;  // of each tile
  double error = 0, cost = 0;
  double product() const { return error * cost; }
};

std::vector<TileTerms> terms_of(const Tiles& tiles, const std::vector<TileMeasure>& measures) {
  double whole = 0, pixels = 0;
  for (const TileMeasure& m : measures) whole += m.mean * m.pixels, pixels += m.pixels;
  const double dark = kDark * (whole / pixels) * (whole / pixels);
  std::vector<TileTerms> own(measures.size()), terms(measures.size());
  for (size_t i = 0; i < measures.size(); ++i) {
    const TileMeasure& m = measures[i];
    const double black = dark + m.mean * m.mean;
    for (size_t a = 0; a < kCandidates.size(); ++a) {
      const double variance = std::max(m.variance[a], kLeastVariance * m.mean * m.mean);
      own[i].error[a] = black > 0 ? m.pixels * variance / black : 0;
      own[i].cost[a] = m.pixels * m.cost[a];
    }
  }
  for (int row = 0; row < tiles.rows(); ++row)
    for (int column = 0; column < tiles.columns(); ++column) {
      TileTerms& sum = terms[size_t(row) * size_t(tiles.columns()) + size_t(column)];
      double pixels = 0;
      for (int y = std::max(0, row - kSmooth); y <= std::min(tiles.rows() - 1, row + kSmooth); ++y)
        for (int x = std::max(0, column - kSmooth); x <= std::min(tiles.columns() - 1, column + kSmooth); ++x) {
          const size_t i = size_t(y) * size_t(tiles.columns()) + size_t(x);
          pixels += measures[i].pixels;
          for (size_t a = 0; a < kCandidates.size(); ++a)
            sum.error[a] += own[i].error[a], sum.cost[a] += own[i].cost[a];
        }
      if (pixels == 0) continue;
      const double part = measures[size_t(row) * size_t(tiles.columns()) + size_t(column)].pixels / pixels;
      for (size_t a = 0; a < kCandidates.size(); ++a) sum.error[a] *= part, sum.cost[a] *= part;
    }
  return terms;
}

// The best of a set of candidates, for light subpaths that cost so much.
Choice best_of(const std::vector<TileTerms>& terms, const std::vector<uint8_t>& allowed, double light_cost) {
  const auto choose = [&](double price) {
    Choice c;
    c.cost = light_cost;
    for (const TileTerms& t : terms) {
      uint8_t best = allowed[0];
      for (uint8_t a : allowed)
        if (t.error[a] + price * t.cost[a] < t.error[best] + price * t.cost[best]) best = a;
      c.candidates.push_back(best);
      c.error += t.error[best], c.cost += t.cost[best];
    }
    return c;
  };
  Choice best;
  for (uint8_t a : allowed) {  // all of the image alike
    Choice c{std::vector<uint8_t>(terms.size(), a), 0, light_cost};
    for (const TileTerms& t : terms) c.error += t.error[a], c.cost += t.cost[a];
    if (best.candidates.empty() || c.product() < best.product()) best = c;
  }
  for (int round = 0; round < kRounds; ++round) {
    const Choice c = choose(best.error / best.cost);
    if (!(c.product() < best.product())) break;
    best = c;
  }
  return best;
}

const Plan& plan_of(Join join) {
  switch (join) {
    case Join::Path:
      return kPath;
    case Join::TwoWay:
      return *find_plan("two-way");
    case Join::OneToOne:
      return *find_plan("one-to-one");
    case Join::Matrix:
      break;
  }
  return *find_plan("matrix");
}

}  // namespace

// A strategy may be chosen only if it finds all paths that any other does. Eye subpaths that hit the light (s = 0) find
// all; else direct lighting does where nothing is specular.
bool StrategyPilot::covers_all(Join join) const {
  if (join == Join::OneToOne || join == Join::Matrix) return true;
  const auto takes = [&](uint32_t s) {
    for (uint32_t t = s == 1 && engine_.local ? 1 : 2; t < 32; ++t)
      if (!engine_.allows(s, t)) return false;
    return true;
  };
  const SceneInfo& scene = engine_.scene.info();
  return (takes(0) && engine_.scene.lights().all_hittable()) || (takes(1) && takes(0) && !scene.has_specular);
}

StrategyMap StrategyPilot::choose() const {
  double light_cost = 0;
  const std::vector<TileTerms> terms = terms_of(tiles_, measures(light_cost));
  Choice best;
  for (int n : {0, 1, 2, 4}) {
    std::vector<uint8_t> allowed;
    for (size_t a = 0; a < kCandidates.size(); ++a)
      if ((kCandidates[a].light_samples == n) && covers_all(kCandidates[a].join)) allowed.push_back(uint8_t(a));
    if (allowed.empty()) continue;
    const Choice c = best_of(terms, allowed, light_cost * n * double(engine_.samples_per_pass()));
    if (best.candidates.empty() || c.product() < (n > 1 ? kOverFewer : kOverNone) * best.product()) best = c;
  }

  StrategyMap map;
  map.tiles = tiles_;
  map.light_samples = kCandidates[best.candidates[0]].light_samples;
  TransportOptions options = target_.options;
  options.light_samples = map.light_samples;
  options.connections = std::max(1, map.light_samples);
  std::array<int, kCandidates.size()> index;
  index.fill(-1);
  for (uint8_t candidate : best.candidates) {
    if (index[candidate] < 0) {
      index[candidate] = int(map.strategies.size());
      map.strategies.push_back(target_.make_strategy(plan_of(kCandidates[candidate].join), options));
    }
    map.choices.push_back(uint8_t(index[candidate]));
  }
  return map;
}

}  // namespace bdpt
