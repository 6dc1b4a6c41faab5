// Strategies by tiles: whatever they are, the picture is the same; and a pilot chooses sensibly.
#include "baking.h"
#include "transport/block.h"
#include "transport/plan.h"
#include "transport/strategy_pilot.h"

namespace bdpt::transport_automatic_test {

using namespace baking;
using scenes::Builder;

constexpr int kWidth = 64, kHeight = 48;  // 4 x 3 tiles

TransportOptions automatic(Heuristic heuristic = Heuristic::Power, int max_edges = 5) {
  TransportOptions o = options_for({}, max_edges);
  o.plan = find_plan("automatic");
  o.heuristic = heuristic;
  o.pool_passes = 2;
  return o;
}

// All strategies side by side, so that light subpaths land on each.
StrategyMap mixed(const Engine& engine, int light_samples) {
  StrategyMap map;
  map.tiles = Tiles(engine.bounds);
  map.light_samples = light_samples;
  TransportOptions counts = engine.options;
  counts.light_samples = counts.connections = light_samples;
  for (const Plan* plan : {&kPath, find_plan("two-way"), find_plan("one-to-one"), find_plan("matrix")})
    map.strategies.push_back(engine.make_strategy(*plan, counts));
  for (size_t i = 0; i < map.tiles.count(); ++i) map.choices.push_back(uint8_t((i + i / 4) % 4));
  return map;
}

BlockMeans mixed_means(const ScenePointer& scene, const SensorPointer& sensor, const TransportOptions& options, int n,
                       int seeds, uint64_t passes) {
  std::vector<std::shared_ptr<Film>> films(static_cast<size_t>(seeds));
  in_parallel(films.size(), [&](size_t i) {
    RenderDesc desc;
    desc.transport = options;
    desc.seed = 5000 + i;
    films[i] = std::make_shared<Film>(film_for(*sensor), nullptr);
    Render render(scene, sensor, films[i], caller(), nullptr, desc);
    render.set_strategies(mixed(render.engine(), n));
    AdvanceDesc advance;
    advance.passes = passes;
    render.advance(advance);
  });
  BlockMeans means;
  for (const auto& film : films) means.add(*film, 8);
  return means;
}

// A lamp of some size, so that path tracing has little noise.
scenes::RoomOptions room() { return {}; }

class TransportAutomatic : public ::testing::TestWithParam<Heuristic> {};

TEST_P(TransportAutomatic, StrategiesSideBySideGiveOnePicture) {
  const ScenePointer scene = scenes::room(room()).build();
  const SensorPointer camera = scenes::camera(scenes::room_view_through_lens(), kWidth, kHeight);
  TransportOptions reference = options_for({}, 5);
  reference.heuristic = GetParam();
  const BlockMeans expected = block_means(scene, camera, reference, {.seeds = 32, .passes = 8, .first_seed = 7});
  for (int n : {1, 2})
    expect_same(mixed_means(scene, camera, automatic(GetParam()), n, 32, 8), expected, 2, "n = " + std::to_string(n));
}

// The same of texels: light that lands in another tile than its own, and light that meets the texel's z_0.
scenes::MeshData walls() { return scenes::unwrapped(scenes::box(Vec3(-1), Vec3(1), true), 3, 0.02f); }
ScenePointer mapped_room() {
  Builder b;
  b.add(walls(), scenes::diffuse(Rgb(0.7f, 0.5f, 0.4f)));
  b.add(
      scenes::quad(Vec3(-0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, 0.1f), Vec3(-0.4f, 0.9f, 0.1f)),
      scenes::emitter(Rgb(4, 3.5f, 3)));
  b.add(scenes::ball(Vec3(0.4f, -0.5f, 0.3f), 0.4f, 4, true), scenes::conductor(0.5f, 0.5f));
  return b.build();
}
constexpr int kMap = 64;  // texels a side: 4 x 4 tiles

TEST_P(TransportAutomatic, StrategiesSideBySideGiveOneLightmap) {
  const ScenePointer scene = mapped_room();
  const SensorPointer sensor = lightmap(scene, kMap);
  TransportOptions reference = options_for({}, 4);
  reference.heuristic = GetParam();
  const BlockMeans expected = block_means(scene, sensor, reference, {.seeds = 24, .passes = 4, .first_seed = 7});
  for (int n : {1, 2})
    expect_same(mixed_means(scene, sensor, automatic(GetParam(), 4), n, 24, 4), expected, 2,
                "n = " + std::to_string(n));
}

INSTANTIATE_TEST_SUITE_P(Heuristics, TransportAutomatic, ::testing::Values(Heuristic::Power, Heuristic::Maximum));

// The running sums of splats know two kinds of strategy; the plain loop knows none. Each contribution must be the same.
void expect_plain_weights(const ScenePointer& scene, const SensorPointer& sensor) {
  Film film(film_for(*sensor), nullptr);
  Engine sums(*scene, *sensor, film, automatic(), 3), plain(*scene, *sensor, film, automatic(), 3);
  sums.choose(mixed(sums, 2)), plain.choose(mixed(plain, 2));
  plain.running_sums = false;
  Block a(sums), b(plain);
  std::map<std::pair<bool, bool>, int> seen;  // splat, joins inner
  const Tiles& tiles = sums.map->tiles;
  for (int row = 0; row < tiles.rows(); ++row)
    for (int column = 0; column < tiles.columns(); ++column) {
      const PixelRect r = sums.map->tiles.pixels(column, row);
      const PixelRect rect{r.x0, r.y0, r.x1, r.y1};
      const std::vector<Contribution> x = a.sample_pilot(2, rect, nullptr), y = b.sample_pilot(2, rect, nullptr);
      ASSERT_EQ(x.size(), y.size());
      for (size_t i = 0; i < x.size(); ++i) {
        ASSERT_EQ(x[i].s, y[i].s);
        ASSERT_EQ(x[i].t, y[i].t);
        EXPECT_NEAR(norm(x[i].value), norm(y[i].value), 2e-3f * norm(y[i].value))
            << technique_name(int(x[i].s), int(x[i].t));
        ++seen[{x[i].t <= 1, sums.strategy_at(x[i].film).joins_inner()}];
      }
    }
  EXPECT_EQ(seen.size(), 4u);
  for (const auto& [kind, count] : seen) EXPECT_GT(count, 1000);
}
TEST(TransportAutomaticWeights, RunningSumsAreThoseOfThePlainLoop) {
  expect_plain_weights(scenes::room({.contents = scenes::Contents::Glossy}).build(),
                       scenes::camera(scenes::room_view_through_lens(), kWidth, kHeight));
}
TEST(TransportAutomaticWeights, RunningSumsAreThoseOfThePlainLoopForTexels) {
  const ScenePointer scene = mapped_room();
  expect_plain_weights(scene, lightmap(scene, kMap));
}

StrategyMap choice_for(const ScenePointer& scene, const SensorPointer& sensor) {
  Film film(film_for(*sensor), nullptr);
  const Engine engine(*scene, *sensor, film, automatic(), 1);
  StrategyPilot pilot(engine);
  for (uint32_t i = 0; i < pilot.tasks(); ++i) pilot.run(i);
  return pilot.choose();
}
size_t tiles_of(const StrategyMap& map, const char* plan) {
  size_t count = 0;
  for (uint8_t choice : map.choices) count += std::string(map.strategies[choice].plan->name) == plan;
  return count;
}

TEST(TransportAutomaticChoice, APlaneUnderTheSkyIsForPathTracing) {
  Builder b;
  b.add(scenes::quad(Vec3(-9, 0, 9), Vec3(9, 0, 9), Vec3(9, 0, -9), Vec3(-9, 0, -9)), scenes::diffuse(0.5f));
  b.environment(Rgb(1));
  const StrategyMap map = choice_for(b.build(), scenes::camera({Vec3(0, 2, 3), Vec3(0, 0, 0), 60}, kWidth, kHeight));
  EXPECT_EQ(map.light_samples, 0);
  EXPECT_EQ(tiles_of(map, "path"), map.choices.size());
}

// A room seen by the light that a lamp behind a shade throws at its ceiling: only light subpaths find it soon.
TEST(TransportAutomaticChoice, ALampTurnedToTheCeilingIsForLightSubpaths) {
  Builder b;
  for (float y : {0.0f, 2.0f})
    b.add(scenes::quad(Vec3(-2, y, 2), Vec3(2, y, 2), Vec3(2, y, -2), Vec3(-2, y, -2)), scenes::diffuse(0.7f));
  b.add(scenes::quad(Vec3(-0.02f, 1.99f, -0.02f), Vec3(0.02f, 1.99f, -0.02f), Vec3(0.02f, 1.99f, 0.02f),
                     Vec3(-0.02f, 1.99f, 0.02f)),
        scenes::emitter(Rgb(1000), true));
  const StrategyMap map =
      choice_for(b.build(), scenes::camera({Vec3(0, 1, 1.9f), Vec3(0, 0.6f, 0), 70}, kWidth, kHeight));
  EXPECT_GT(map.light_samples, 0);
  EXPECT_LT(tiles_of(map, "path"), map.choices.size() / 2);
}

// A lightmap of a floor with room round its charts, whose tiles hold few texels or none.
ScenePointer floor_under(const scenes::MeshData& lamp, const std::function<void(Builder&)>& more = {}) {
  Builder b;
  b.add(scenes::unwrapped(scenes::quad(Vec3(-1, -1, 1), Vec3(1, -1, 1), Vec3(1, -1, -1), Vec3(-1, -1, -1)), 1, 0.3f),
        scenes::diffuse(0.6f));
  b.add(scenes::box(Vec3(-1), Vec3(1), true, 63 - 4), scenes::diffuse(0.6f));
  b.add(lamp, scenes::emitter(Rgb(10)));
  if (more) more(b);
  return b.build();
}
scenes::MeshData lamp(float half) {
  return scenes::quad(Vec3(-half, 0.99f, -half), Vec3(half, 0.99f, -half), Vec3(half, 0.99f, half),
                      Vec3(-half, 0.99f, half));
}

TEST(TransportAutomaticChoice, ATexelUnderAWideLampIsForPathTracing) {
  const ScenePointer scene = floor_under(lamp(0.5f));
  const StrategyMap map = choice_for(scene, lightmap(scene, kMap));
  EXPECT_EQ(map.light_samples, 0);
}

TEST(TransportAutomaticChoice, ATexelInACausticIsForLightSubpaths) {
  const ScenePointer scene =
      floor_under(lamp(0.1f), [](Builder& b) { b.add_sphere(Vec3(0, -0.3f, 0), 0.4f, scenes::dielectric(1.5f)); });
  const StrategyMap map = choice_for(scene, lightmap(scene, kMap));
  EXPECT_GT(map.light_samples, 0);
}

// Light of a point by way of a mirror: neither path tracing nor two-way finds it.
TEST(TransportAutomaticChoice, PathsThatAStrategyCannotFindRuleItOut) {
  const ScenePointer scene = scenes::room({.contents = scenes::Contents::Specular, .points = true}).build();
  const StrategyMap map = choice_for(scene, scenes::camera(scenes::room_view(), kWidth, kHeight));
  EXPECT_EQ(tiles_of(map, "path") + tiles_of(map, "two-way"), 0u);
  EXPECT_EQ(tiles_of(map, "one-to-one") + tiles_of(map, "matrix"), map.choices.size());
}

}  // namespace bdpt::transport_automatic_test
