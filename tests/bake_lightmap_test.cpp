// Lightmaps against closed forms, and each technique of theirs against each other.
#include "baking.h"

namespace bdpt::bake_lightmap_test {

using namespace baking;
using scenes::Builder;

scenes::MeshData room_of_quads() { return scenes::unwrapped(scenes::box(Vec3(-1), Vec3(1), true), 3, 0.02f); }

// Irradiance over that of the furnace, pi L / (1 - albedo), in every texel.
TEST(BakeLightmap, FurnaceByEveryTechniqueAndPlan) {
  Builder b;
  b.add(room_of_quads(), scenes::emitter(Rgb(1), false, 0.5f));
  const ScenePointer scene = b.build();
  const SensorPointer sensor = lightmap(scene, 12);
  const std::vector<Way> all = ways(0);
  for (const Way& way : all) {
    Effort effort;
    effort.seeds = 16, effort.passes = 16;
    Estimate whole;
    for (int seed = 0; seed < effort.seeds; ++seed) {
      const std::vector<float> map = read(*render(scene, sensor, way.options, effort.passes, uint64_t(seed)).film);
      double sum = 0, area = 0;
      for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) {
          const double a = double(static_cast<const Lightmap&>(*sensor).texels().area(x, y));
          sum += a * double(map[3 * size_t(y * 12 + x)]), area += a;
        }
      whole.add(sum / area);
      EXPECT_NEAR(area, 24, 1e-4);
    }
    expect_value(whole, 2 * M_PI, all.size(), way.name, 1e-4);
    // Its 1 / r^2 has no finite variance, but all techniques together have.
    if (way.name == "t = 1") continue;
    EXPECT_LT(whole.standard_error(), 0.002 * 2 * M_PI) << way.name;
  }
}

// A room with a lamp, a box and a ball; the walls are mapped, the rest casts shadows and scatters.
struct Room {
  bool glass = false, sky = false, spot = false;
};
ScenePointer lit_room(const Room& room = {}) {
  Builder b;
  scenes::MeshData walls = scenes::unwrapped(scenes::box(Vec3(-1), Vec3(1), true, room.sky ? 63 - 2 : 63), 3, 0.02f);
  b.add(walls, scenes::diffuse(Rgb(0.7f, 0.5f, 0.4f)));
  b.add(
      scenes::quad(Vec3(-0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, 0.1f), Vec3(-0.4f, 0.9f, 0.1f)),
      scenes::emitter(Rgb(4, 3.5f, 3)));
  b.add(scenes::box(Vec3(-0.6f, -1, -0.5f), Vec3(-0.1f, -0.4f, 0.1f), false), scenes::diffuse(0.6f));
  if (room.glass)
    b.add_sphere(Vec3(0.4f, -0.5f, 0.3f), 0.4f, scenes::dielectric(1.5f));
  else
    b.add(scenes::ball(Vec3(0.4f, -0.5f, 0.3f), 0.4f, 4, true), scenes::conductor(0.5f, 0.5f));
  if (room.sky) {
    b.environment(Rgb(1, 1.5f, 2), 1);
    LightDesc sun = scenes::directional(20, Rgb(0.5f)), clouds = scenes::environment_map(0.1f);
    sun.direction = unit(Vec3(-1, -0.6f, 0.2f));
    sun.group = clouds.group = 1;
    b.light(sun).light(clouds);
  }
  if (room.spot) b.spot(Vec3(-0.5f, 0.5f, 0.5f), Vec3(0.5f, -1, -0.3f), Rgb(2, 1, 1), 60, 25);
  return b.build();
}

struct Asked {
  std::vector<Way> ways;
  SensorPointer sensor;
  int side = 4;
  uint64_t passes = 16;
  int seeds = 24;
};
void expect_agreement(const ScenePointer& scene, const Asked& asked) {
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : asked.ways) {
    Effort effort;
    effort.seeds = asked.seeds, effort.side = asked.side, effort.first_seed = means.size();
    effort.passes = way.name == "s = 0" ? 4 * asked.passes : asked.passes;
    means.push_back(block_means(scene, asked.sensor, way.options, effort));
    names.push_back(way.name);
  }
  expect_all_same(means, names);
}

TEST(BakeLightmap, EveryTechniqueAndPlanMeasureTheSame) {
  const ScenePointer scene = lit_room();
  expect_agreement(scene, {ways(4), lightmap(scene, 12)});
}

// Without a technique that finds no caustics.
std::vector<Way> ways_with_glass() {
  std::vector<Way> all = ways(5);
  std::erase_if(all, [](const Way& w) { return w.name == "s <= 1, t >= 1" || w.name == "t = 1"; });
  return all;
}

TEST(BakeLightmap, CausticsOfAGlassSphere) {
  const ScenePointer scene = lit_room({.glass = true});
  expect_agreement(scene, {ways_with_glass(), lightmap(scene, 12)});
}

TEST(BakeLightmap, SkyThroughAMissingWall) {
  const ScenePointer scene = lit_room({.sky = true});
  expect_agreement(scene, {ways(4), lightmap(scene, 12)});
}

TEST(BakeLightmap, ASpotIsNotHit) {
  const ScenePointer scene = lit_room({.spot = true});
  std::vector<Way> all = ways(4);
  std::erase_if(all, [](const Way& w) { return w.name == "s = 0"; });
  expect_agreement(scene, {all, lightmap(scene, 12)});
}

// Options that must not change what is measured.
TEST(BakeLightmap, HeuristicsCountsRoulettesAndLightSelections) {
  const ScenePointer scene = lit_room({.sky = true});
  std::vector<Way> all = {{"power", options_for({}, 4)}};
  const auto add = [&](const char* name, const char* plan, const std::function<void(TransportOptions&)>& change) {
    all.push_back({name, with_plan(options_for({}, 4), plan)});
    change(all.back().options);
  };
  add("balance", "one-to-one", [](auto& o) { o.heuristic = Heuristic::Balance; });
  add("cutoff", "matrix", [](auto& o) { o.heuristic = Heuristic::Cutoff, o.cutoff = 0.1f; });
  add("maximum", "two-way", [](auto& o) { o.heuristic = Heuristic::Maximum; });
  add("cutoff, tree", "one-to-one",
      [](auto& o) { o.heuristic = Heuristic::Cutoff, o.cutoff = 0.5f, o.light_selection = LightSelection::Tree; });
  add("maximum, tree", "one-to-one",
      [](auto& o) { o.heuristic = Heuristic::Maximum, o.light_selection = LightSelection::Tree; });
  add("cutoff, pooled", "pooled", [](auto& o) { o.heuristic = Heuristic::Cutoff, o.cutoff = 0.1f; });
  add("three light subpaths", "one-to-one", [](auto& o) { o.light_samples = 3; });
  add("three light subpaths, two-way", "two-way", [](auto& o) { o.light_samples = 3; });
  add("seven in the pool", "pooled", [](auto& o) { o.connections = 7, o.light_samples = 2; });
  add("four columns", "matrix", [](auto& o) { o.connections = 4, o.light_selection = LightSelection::Tree; });
  add("all lengths", "matrix", [](auto& o) { o.matrix = Matrix::AllLengths; });
  add("each light, candidates", "one-to-one",
      [](auto& o) { o.light_selection = LightSelection::Each, o.direct_samples = 2, o.direct_candidates = 3; });
  add("efficient roulette", "one-to-one", [](auto& o) { o.shadow_roulette = Roulette::Efficiency; });
  add("starts by importance", "one-to-one", [](auto& o) { o.light_start = StartBy::Importance; });
  add("aware of correlation", "combinatorial", [](auto& o) { o.correlation_aware = true; });
  for (const char* plan : {"one-to-one", "two-way", "pooled", "matrix"})
    add("t <= 1", plan, [](auto& o) { o.techniques = mask_of([](int, int t) { return t <= 1; }); });
  add("Sobol", "matrix", [](auto& o) { o.sampler = SamplerType::Sobol; });
  expect_agreement(scene, {all, lightmap(scene, 9), 9, 8});
}

// All planes of many outputs, one mean each.
BlockMeans plane_means(const ScenePointer& scene, const SensorPointer& sensor, const TransportOptions& options,
                       uint64_t passes, int seeds, uint64_t first_seed) {
  BlockMeans means;
  means.values.resize(size_t(sensor->planes()));
  for (int seed = 0; seed < seeds; ++seed) {
    const Picture p = render(scene, sensor, options, passes, first_seed * 1000 + uint64_t(seed));
    for (int plane = 0; plane < sensor->planes(); ++plane) {
      const std::vector<float> map = read(*p.film, FilmLayer::Color, 0, 0, plane);
      double sum = 0;
      for (float v : map) sum += double(v);
      means.values[size_t(plane)].add(sum / double(map.size()));
    }
    means.rejected += p.film->rejected() + p.stats.rejected;
  }
  return means;
}

std::vector<OutputDesc> many_outputs() {
  std::vector<OutputDesc> outputs = {OutputDesc{OutputKind::RadianceSh2}, OutputDesc{OutputKind::IrradianceSh1},
                                     OutputDesc{OutputKind::Irradiance}};
  OutputDesc direct{OutputKind::Irradiance}, indirect{OutputKind::IrradianceOverPi}, sky{OutputKind::Fluence};
  direct.indirect = false, indirect.direct = false, sky.groups = 2;
  outputs.insert(outputs.end(), {direct, indirect, sky});
  return outputs;
}

TEST(BakeLightmap, OutputsByEveryTechniqueAndPlan) {
  const ScenePointer scene = lit_room({.sky = true});
  const SensorPointer sensor = lightmap(scene, 9, {placed(0)}, many_outputs());
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : ways(3)) {
    means.push_back(plane_means(scene, sensor, way.options, way.name == "s = 0" ? 64 : 16, 24, means.size()));
    names.push_back(way.name);
  }
  expect_all_same(means, names);
}

// The densities of directions are not those of a cosine here, and the weights must know: with direct light alone a
// fault of theirs shows.
TEST(BakeLightmap, HarmonicsOfALampByEveryTechnique) {
  Builder b;
  b.add(scenes::unwrapped(scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1)), 1, 0),
        scenes::diffuse(0.5f));
  b.add(
      scenes::quad(Vec3(-0.9f, 0.5f, -0.9f), Vec3(0.9f, 0.5f, -0.9f), Vec3(0.9f, 0.5f, 0.9f), Vec3(-0.9f, 0.5f, 0.9f)),
      scenes::emitter(Rgb(1)));
  const ScenePointer scene = b.build();
  const SensorPointer sensor = lightmap(scene, 4, {placed(0)}, {OutputDesc{OutputKind::RadianceSh2}});
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  std::vector<Way> all = ways(1);
  std::erase_if(all, [](const Way& w) { return w.name == "s <= 1, t >= 1" || w.name == "combinatorial"; });
  all.push_back({"not s = 0", options_for(mask_of([](int s, int) { return s > 0; }), 1)});
  all.push_back({"not s = 1", options_for(mask_of([](int s, int) { return s != 1; }), 1)});
  all.push_back({"balance", options_for({}, 1)});
  all.back().options.heuristic = Heuristic::Balance;
  for (Way& way : all) {
    way.options.sampler = SamplerType::Sobol;
    means.push_back(plane_means(scene, sensor, way.options, 512, 32, means.size()));
    names.push_back(way.name);
    EXPECT_LT(means.back().values[0].standard_error(), 0.002 * means.back().values[0].mean()) << way.name;
  }
  expect_all_same(means, names);
}

}  // namespace bdpt::bake_lightmap_test
