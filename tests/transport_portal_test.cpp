// Portals are hints: every technique gives the picture that it gives without them, with less noise where they help.
#include "baking.h"
#include "light_testing.h"
#include "rendering.h"
#include "transport/plan.h"

namespace bdpt::transport_portal_test {

using namespace rendering;
using baking::with_plan;

constexpr int kSize = 32;

std::vector<LightDesc> with(std::vector<LightDesc> lights, const std::vector<Portal>& portals) {
  for (LightDesc& l : lights) l.portals = portals;
  return lights;
}

struct Case {
  std::string name;
  std::vector<LightDesc> lights;
  std::vector<Portal> portals;
  bool every_plan = false;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::vector<Case> cases() {
  const LightDesc sky = lights::environment(Rgb(1.5f, 1.5f, 2)), map = scenes::environment_map();
  const Portal hole = scenes::skylight(), half = scenes::skylight(0, 0.5f), above = scenes::skylight(0.5f),
               astray = {Vec3(-0.9f, -0.8f, -0.7f), Vec3(1.2f, 0.3f, 0), Vec3(-0.2f, 0.8f, 0.5f)};
  return {{"hole", {sky}, {hole}},
          {"half_of_the_hole", {sky}, {half}},
          {"astray", {sky}, {astray}},
          {"one_after_the_other", {sky}, {hole, above}},
          {"map", {map}, {hole, above, astray}, true},
          {"sun_and_sky", {map, scenes::directional(3), scenes::directional(0)}, {half}}};
}

class TransportPortal : public testing::TestWithParam<Case> {};

TEST_P(TransportPortal, AllTechniquesGiveThePictureWithoutPortals) {
  const auto scene = [&](const std::vector<Portal>& portals) -> ScenePointer {
    return scenes::room(
               {.contents = scenes::Contents::Glossy, .lamps = false, .lights = with(GetParam().lights, portals)})
        .build();
  };
  const ScenePointer plain = scene({}), hinted = scene(GetParam().portals);
  const SensorPointer camera = scenes::camera(scenes::room_view_through_lens(), kSize, kSize);
  const TechniqueMask all,
      path = mask_of([](int s, int) { return s <= 1; }), light = mask_of([](int, int t) { return t <= 1; }),
      next = mask_of([](int s, int) { return s >= 1; }), rest = mask_of([](int s, int) { return s != 1; });
  const struct {
    const char* name;
    ScenePointer scene;
    TechniqueMask mask;
    const char* plan;
  } ways[] = {{"without", plain, all, nullptr},    {"path", hinted, path, nullptr},
              {"light", hinted, light, nullptr},   {"bidirectional", hinted, all, nullptr},
              {"s >= 1", hinted, next, nullptr},   {"s != 1", hinted, rest, nullptr},
              {"two-way", hinted, all, "two-way"}, {"pooled", hinted, all, "pooled"},
              {"matrix", hinted, all, "matrix"},   {"automatic", hinted, all, "automatic"}};
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const auto& way : ways) {
    if (way.plan && !GetParam().every_plan) continue;
    TransportOptions options = options_for(way.mask, 4);
    if (way.plan) options = with_plan(options, way.plan);
    options.light_selection = means.size() % 2 ? LightSelection::Tree : LightSelection::Power;
    options.light_start = means.size() % 3 ? StartBy::Power : StartBy::Importance;
    means.push_back(
        block_means(way.scene, camera, options, {.seeds = 20, .passes = 8, .first_seed = means.size() + 1}));
    names.push_back(way.name);
  }
  EXPECT_GT(means[0].whole().mean(), 0.01);
  expect_all_same(means, names);
}

INSTANTIATE_TEST_SUITE_P(All, TransportPortal, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

// Balls within a room and outside of the scene, where rays start beside them or behind; a portal reaches out of the
// scene.
TEST(TransportPortal, BallsMeasureTheSameByEveryTechnique) {
  const Portal wide = {Vec3(-3, 1.1f, 0.4f), Vec3(6, 0, 0), Vec3(0, 0, 4)};
  const SensorPointer balls = baking::points({{Vec3(0, -0.2f, 0.6f), Vec3(0), 0.3f}, {Vec3(0, 1.6f, 0), Vec3(0), 0.4f}},
                                             {OutputDesc{OutputKind::Fluence}});
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (bool hinted : {false, true}) {
    LightDesc sky = lights::environment(Rgb(1));
    if (hinted) sky.portals = {wide, scenes::skylight()};
    const ScenePointer scene = scenes::room({.lamps = false, .lights = {sky}}).build();
    for (const baking::Way& way : baking::ways(4)) {
      if (!hinted && way.name != "all") continue;
      BlockMeans m;
      m.values.resize(2);
      for (uint64_t seed = 0; seed < 24; ++seed) {
        const Picture p = render(scene, balls, way.options, 512, 100 * means.size() + seed);
        const std::vector<float> map = read(*p.film);
        for (size_t i = 0; i < 2; ++i) m.values[i].add(grey(&map[3 * i]));
        m.rejected += p.film->rejected() + p.stats.rejected;
      }
      means.push_back(m);
      names.push_back(way.name + (hinted ? " with portals" : ""));
    }
  }
  expect_all_same(means, names);
}

// A room of 4 x 4 x 4 with a window of half a unit: the mean variance of a pixel's samples.
double variance(bool hinted, const TechniqueMask& mask, const LightDesc& light, uint64_t first_seed = 1) {
  scenes::Builder b;
  const Vec3 low(-2), high(2), a(-0.25f, 0.5f, 2), c(0.25f, 1, 2);
  b.add(scenes::box(low, high, true, 31), scenes::diffuse(0.6f));
  scenes::MeshData wall = scenes::quad(Vec3(-2, -2, 2), Vec3(-2, a.y, 2), Vec3(2, a.y, 2), Vec3(2, -2, 2));
  wall.add_quad(Vec3(-2, c.y, 2), Vec3(-2, 2, 2), Vec3(2, 2, 2), Vec3(2, c.y, 2));
  wall.add_quad(Vec3(-2, a.y, 2), Vec3(-2, c.y, 2), Vec3(a.x, c.y, 2), Vec3(a.x, a.y, 2));
  wall.add_quad(Vec3(c.x, a.y, 2), Vec3(c.x, c.y, 2), Vec3(2, c.y, 2), Vec3(2, a.y, 2));
  b.add(wall, scenes::diffuse(0.6f));
  LightDesc l = light;
  if (hinted) l.portals.push_back({a, Vec3(c.x - a.x, 0, 0), Vec3(0, c.y - a.y, 0)});
  b.light(l);
  const SensorPointer camera = scenes::camera({Vec3(0, 0, 1.8f), Vec3(0.2f, -0.3f, -1), 80}, kSize, kSize);
  const BlockMeans means = block_means(b.build(), camera, options_for(mask, 5),
                                       {.seeds = 48, .passes = 4, .first_seed = first_seed, .side = 1});
  double sum = 0;
  for (size_t i = 0; i + 4 < means.values.size(); ++i) sum += means.values[i].variance();
  return sum;
}

// What docs/performance.md tells, a third of it.
TEST(TransportPortal, ASmallWindowHasLessNoise) {
  const TechniqueMask all, path = mask_of([](int s, int) { return s <= 1; }),
                           light = mask_of([](int, int t) { return t <= 1; });
  LightDesc sun = scenes::directional(0.5);
  sun.direction = unit(Vec3(0.2f, -0.6f, -1));
  const struct {
    const char* name;
    TechniqueMask mask;
    LightDesc light;
    double measured;
  } ways[] = {{"path, sky", path, lights::environment(Rgb(1)), 200},
              {"light, sky", light, lights::environment(Rgb(1)), 90},
              {"bidirectional, sky", all, lights::environment(Rgb(1)), 200},
              {"bidirectional, sun", all, sun, 39}};
  for (const auto& way : ways) {
    const double gain = variance(false, way.mask, way.light) / variance(true, way.mask, way.light);
    EXPECT_GT(gain, way.measured / 3) << way.name;
  }
}

}  // namespace bdpt::transport_portal_test
