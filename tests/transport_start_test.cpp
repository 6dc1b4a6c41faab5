// Light subpaths that choose their light by importance: the pilot finds the lights that matter, and whatever it finds
// the picture stays the same.
#include "rendering.h"
#include "transport/plan.h"
#include "transport/start_pilot.h"

namespace bdpt::transport_start_test {

using namespace rendering;
using scenes::Builder;

constexpr int kSize = 32;

scenes::MeshData square(const Vec3& center, float half) {
  const Vec3 x(half, 0, 0), z(0, 0, half);
  return scenes::quad(center - x - z, center + x - z, center + x + z, center - x + z);  // faces down
}

// A floor and a ceiling with two lamps between them, and lamps of `vain` times their power under a floor of their own,
// far below, of which nothing is seen.
ScenePointer lamps(float vain, int hidden = 2) {
  Builder b;
  b.add(scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1)), scenes::diffuse(0.8f));
  b.add(scenes::quad(Vec3(-1, 1, -1), Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(-1, 1, 1)), scenes::diffuse(0.8f));
  b.add(square(Vec3(-0.5f, 0.7f, 0), 0.1f), scenes::emitter(Rgb(9), true));
  b.add(square(Vec3(0.6f, 0.4f, -0.3f), 0.1f), scenes::emitter(Rgb(2, 4, 5), false));
  b.add(square(Vec3(0, -4, 0), 20), scenes::diffuse(0.5f));
  for (int i = 0; i < hidden; ++i) b.add(square(Vec3(float(i), -6, 0), 0.1f), scenes::emitter(Rgb(vain), false));
  return b.build();
}
SensorPointer view(int size = kSize) { return scenes::camera({Vec3(0, 0.8f, 2), Vec3(0, 0.2f, 0), 40}, size, size); }

TransportOptions by_importance(int max_edges = 4) {
  TransportOptions o = options_for({}, max_edges);
  o.light_start = StartBy::Importance;
  return o;
}

Discrete pilot(const ScenePointer& scene, const TransportOptions& options, uint64_t seed = 1) {
  const SensorPointer camera = view();
  Film film(film_desc(kSize, kSize), nullptr);
  const Engine engine(*scene, *camera, film, options, seed);
  return pilot_starts(engine).starts;
}

TEST(LightStarts, LampsInVainKeepLittleMoreThanATenthOfTheirPower) {
  const Discrete starts = pilot(lamps(90), by_importance());
  ASSERT_EQ(starts.size(), 4u);
  double sum = 0;
  for (size_t i = 0; i < 4; ++i) sum += double(starts.probability(i));
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_GT(starts.probability(0), 0.3f);
  EXPECT_GT(starts.probability(1), 0.1f);
  for (size_t i : {2u, 3u}) {
    EXPECT_GT(starts.probability(i), 0.03f);
    EXPECT_LT(starts.probability(i), 0.1f);  // by power: 0.44
  }
}

TEST(LightStarts, WithoutAChoiceThereIsNoPilot) {
  EXPECT_TRUE(
      pilot(scenes::room({}).build(), options_for(mask_of([](int s, int t) { return s <= 1 && t >= 2; }), 4)).empty());
  Builder b;
  b.add(square(Vec3(0, 1, 0), 0.2f), scenes::emitter(Rgb(1), true));
  EXPECT_TRUE(pilot(b.build(), by_importance()).empty());
}

// A view of the dark: nothing arrives, and power decides.
TEST(LightStarts, WhereNothingArrivesPowerDecides) {
  Builder b;
  b.add(square(Vec3(0, 50, 0), 0.2f), scenes::emitter(Rgb(1), false));
  b.add(square(Vec3(1, 50, 0), 0.2f), scenes::emitter(Rgb(1), false));
  b.add(square(Vec3(0, 60, 0), 0.2f), scenes::diffuse(0.5f));
  EXPECT_TRUE(pilot(b.build(), by_importance()).empty());
}

TEST(LightStarts, ThePilotIsTheSameEachTimeAndFollowsTheSeed) {
  const ScenePointer scene = lamps(9);
  const Discrete a = pilot(scene, by_importance(), 3), b = pilot(scene, by_importance(), 3),
                 c = pilot(scene, by_importance(), 4);
  bool differs = false;
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.probability(i), b.probability(i));
    EXPECT_NEAR(a.probability(i), c.probability(i), 0.1f);
    differs = differs || a.probability(i) != c.probability(i);
  }
  EXPECT_TRUE(differs);
}

// Each kind of technique that a light subpath makes, alone and weighed, and every plan.
TEST(LightStarts, ThePictureIsThatOfStartsByPower) {
  const ScenePointer scene = lamps(9);
  const SensorPointer camera = view();
  struct Way {
    std::string plan;
    uint64_t passes;
    TechniqueMask mask = {};
  };
  const TechniqueMask light = mask_of([](int, int t) { return t <= 1; });
  const TechniqueMask inner = mask_of([](int s, int t) { return s >= 2 && t >= 2; });
  const std::vector<std::vector<Way>> families = {
      {{"one-to-one", 8}, {"two-way", 8}, {"pooled", 8}, {"matrix", 8}, {"combinatorial", 2}, {"mmlt", 16}},
      {{"one-to-one", 64, inner}, {"pooled", 32, inner}},
      {{"one-to-one", 64, light}, {"pooled", 64, light}}};
  uint64_t seed = 0;
  for (size_t f = 0; f < families.size(); ++f) {
    const std::vector<Way>& family = families[f];
    TransportOptions options = options_for(family[0].mask, 4);
    const BlockMeans expected =
        block_means(scene, camera, options, {.passes = 4 * family[0].passes, .first_seed = ++seed, .side = kSize});
    for (const Way& way : family) {
      options = by_importance();
      options.plan = find_plan(way.plan.c_str());
      options.techniques = way.mask;
      options.pool_passes = options.plan->passes > 1 ? 8 : 0;
      const BlockMeans means =
          block_means(scene, camera, options, {.passes = way.passes, .first_seed = ++seed, .side = kSize});
      expect_same(means, expected, 10, way.plan + ", " + "family " + std::to_string(f));
      const double error = means.whole().standard_error() / means.whole().mean();
      EXPECT_LT(error, 0.006) << way.plan;  // 3 % would be seen
    }
  }
}

// With ten lamps in vain light tracing has less noise, by as much as fewer subpaths go in vain.
TEST(LightStarts, LampsInVainCostLittle) {
  const ScenePointer scene = lamps(9, 10);
  const SensorPointer camera = view();
  TransportOptions options = options_for(mask_of([](int, int t) { return t <= 1; }), 3);
  const auto variance = [&](StartBy by) {
    options.light_start = by;
    return block_means(scene, camera, options, {.seeds = 48, .passes = 4, .side = kSize}).whole().variance();
  };
  EXPECT_GT(variance(StartBy::Power), 2.5 * variance(StartBy::Importance));
}

}  // namespace bdpt::transport_start_test
