// Plans, heuristics, roulettes, samplers, numbers of samples, starts and rates: every pair of choices together at least
// once. The plain average is left out: its variance need not be finite.
#pragma once

#include "rendering.h"
#include "transport/plan.h"

#include <set>

namespace bdpt::cover {

using namespace rendering;

// One value of each factor, by its number.
enum Factor {
  kPlan,
  kHeuristic,
  kRoulette,
  kSampler,
  kConnections,
  kLightSamples,
  kStart,
  kOrder,
  kSubpathRoulette,
  kMatrix,
  kAdaptive,
  kFactors
};
using Choice = std::array<int, kFactors>;

inline int plans() {
  int n = 0;
  while (plan_at(size_t(n))) ++n;
  return n;
}
inline Choice sizes() { return {plans(), 5, 3, 3, 3, 2, 3, 3, 2, 2, 2}; }

// Greedy: each row takes, factor by factor, what meets most pairs that are not met yet.
inline std::vector<Choice> pairwise_cover(const Choice& sizes) {
  std::set<std::array<int, 4>> open;  // factor, value, later factor, value
  for (int a = 0; a < kFactors; ++a)
    for (int b = a + 1; b < kFactors; ++b)
      for (int i = 0; i < sizes[size_t(a)]; ++i)
        for (int j = 0; j < sizes[size_t(b)]; ++j) open.insert({a, i, b, j});
  std::vector<Choice> rows;
  while (!open.empty()) {
    const std::array<int, 4> first = *open.begin();
    Choice row;
    row.fill(-1);
    row[size_t(first[0])] = first[1];
    row[size_t(first[2])] = first[3];
    const auto gain = [&](int factor, int value) {
      int n = 0;
      for (int other = 0; other < kFactors; ++other) {
        const int v = row[size_t(other)];
        if (v < 0 || other == factor) continue;
        n += other < factor ? int(open.count({other, v, factor, value})) : int(open.count({factor, value, other, v}));
      }
      return n;
    };
    for (int factor = 0; factor < kFactors; ++factor) {
      if (row[size_t(factor)] >= 0) continue;
      int best = 0;
      for (int value = 1; value < sizes[size_t(factor)]; ++value)
        if (gain(factor, value) > gain(factor, best)) best = value;
      row[size_t(factor)] = best;
    }
    for (int a = 0; a < kFactors; ++a)
      for (int b = a + 1; b < kFactors; ++b) open.erase({a, row[size_t(a)], b, row[size_t(b)]});
    rows.push_back(row);
  }
  return rows;
}

inline TransportOptions options_of(const Choice& c) {
  TransportOptions o;
  o.max_edges = 5;
  o.plan = plan_at(size_t(c[kPlan]));
  const Heuristic heuristics[] = {Heuristic::Power, Heuristic::Balance, Heuristic::Cutoff, Heuristic::Maximum,
                                  Heuristic::Power};
  o.heuristic = heuristics[c[kHeuristic]];
  o.beta = c[kHeuristic] == 4 ? 1.5f : 2;
  o.cutoff = 0.1f;
  o.shadow_roulette = o.plan->chains ? Roulette::None : Roulette(c[kRoulette]);
  o.shadow_threshold = 0.05f;
  o.sampler = SamplerType(c[kSampler]);
  const int connections[] = {0, 1, 3};
  o.connections = o.plan->default_connections > 0 ? connections[c[kConnections]] : 0;
  o.light_samples = o.plan->chains ? 1 : 1 + c[kLightSamples];
  o.light_start = StartBy(c[kStart]);
  o.order = Order(c[kOrder]);
  o.partners = Partners(c[kOrder] % 2);
  o.roulette_start = c[kSubpathRoulette] == 1 ? 2 : 4;
  o.matrix = Matrix(c[kMatrix]);
  o.pool_pixels = c[kMatrix] == 1 && o.plan->resizable ? 64 : 0;
  o.adaptive = o.plan->chains ? Adaptive::None : Adaptive(c[kAdaptive]);
  o.pool_passes = o.plan->passes > 1 ? 2 : 0;
  return o;
}

inline std::string name_of(const Choice& c) {
  std::string name = plan_at(size_t(c[kPlan]))->name;
  for (int factor = 1; factor < kFactors; ++factor) name += ' ' + std::to_string(c[size_t(factor)]);
  return name;
}

struct CoverEffort {
  int seeds = 16, side = 16;
  uint64_t passes = 2;
  int combinatorial_seeds = 8;  // of one pass
  Effort reference{.passes = 16, .side = 16};
  TechniqueMask techniques{};
};

// All of them measure what Veach's plan does with many samples. left_out: a plan whose variance is not finite here.
inline void expect_cover_agrees(const ScenePointer& scene, const SensorPointer& camera, int max_edges,
                                const CoverEffort& effort = {}, const std::string& left_out = "") {
  const BlockMeans expected = block_means(scene, camera, options_for(effort.techniques, max_edges), effort.reference);
  const std::vector<Choice> rows = pairwise_cover(sizes());
  for (size_t i = 0; i < rows.size(); ++i) {
    TransportOptions options = options_of(rows[i]);
    if (options.plan->name == left_out) continue;
    options.max_edges = max_edges;
    options.techniques = effort.techniques;
    Effort own{.seeds = effort.seeds, .passes = effort.passes, .first_seed = 2 + i, .side = effort.side};
    if (options.plan->name == std::string("combinatorial")) own.passes = 1, own.seeds = effort.combinatorial_seeds;
    expect_same(block_means(scene, camera, options, own), expected, rows.size(), name_of(rows[i]));
  }
}

}  // namespace bdpt::cover
