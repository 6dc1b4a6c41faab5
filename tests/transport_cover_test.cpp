// Plans, heuristics, roulettes, samplers, numbers of samples, starts and rates, every pair of choices together at least
// once: all measure the same. The plain average is left out: its variance need not be finite.
#include "rendering.h"
#include "transport/plan.h"

#include <set>

namespace bdpt {
namespace {

using namespace rendering;
using scenes::Contents;

constexpr int kSize = 64, kSide = 16;

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
  kAdaptive,
  kFactors
};
using Choice = std::array<int, kFactors>;

int plans() {
  int n = 0;
  while (plan_at(size_t(n))) ++n;
  return n;
}
Choice sizes() { return {plans(), 5, 3, 3, 3, 2, 3, 3, 2, 2}; }

// Greedy: each row takes, factor by factor, what meets most pairs that are not met yet.
std::vector<Choice> pairwise_cover(const Choice& sizes) {
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

TransportOptions options_of(const Choice& c) {
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
  o.adaptive = o.plan->chains ? Adaptive::None : Adaptive(c[kAdaptive]);
  o.pool_passes = o.plan->passes > 1 ? 2 : 0;
  return o;
}

std::string name_of(const Choice& c) {
  std::string name = plan_at(size_t(c[kPlan]))->name;
  for (int factor = 1; factor < kFactors; ++factor) name += ' ' + std::to_string(c[size_t(factor)]);
  return name;
}

void expect_cover_agrees(const scenes::RoomOptions& room, const scenes::Viewpoint& view) {
  const ScenePointer scene = scenes::room(room).build();
  const SensorPointer camera = scenes::camera(view, kSize, kSize);
  const BlockMeans expected = block_means(scene, camera, options_for({}, 5), {.passes = 16, .side = kSide});
  const std::vector<Choice> rows = pairwise_cover(sizes());
  for (size_t i = 0; i < rows.size(); ++i)
    expect_same(
        block_means(scene, camera, options_of(rows[i]), {.seeds = 16, .passes = 2, .first_seed = 2 + i, .side = kSide}),
        expected, rows.size(), name_of(rows[i]));
}

TEST(TransportCover, DiffuseRoom) { expect_cover_agrees({.points = true}, scenes::room_view()); }
TEST(TransportCover, GlassAndMirrorThroughALens) {
  expect_cover_agrees({.contents = Contents::Specular}, scenes::room_view_through_lens());
}
TEST(TransportCover, GlossySurfacesAndAnEnvironment) {
  expect_cover_agrees({.contents = Contents::Glossy, .environment = true}, scenes::room_view());
}

TEST(TransportCover, HoldsEveryPair) {
  const Choice n = sizes();
  const std::vector<Choice> rows = pairwise_cover(n);
  for (size_t a = 0; a < kFactors; ++a)
    for (size_t b = a + 1; b < kFactors; ++b)
      for (int i = 0; i < n[a]; ++i)
        for (int j = 0; j < n[b]; ++j)
          EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const Choice& c) { return c[a] == i && c[b] == j; }));
  EXPECT_LT(rows.size(), 60u);
}

}  // namespace
}  // namespace bdpt
