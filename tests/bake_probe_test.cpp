// Balls in space: their closed forms, and each technique of theirs against each other.
#include "baking.h"

#include "bake/balls.h"

namespace bdpt::bake_probe_test {

using namespace baking;
using scenes::Builder;

MeasuredPoint ball(const Vec3& center, float radius) { return {center, Vec3(0), radius}; }

std::vector<OutputDesc> fluence_and_harmonics() {
  return {OutputDesc{OutputKind::Fluence}, OutputDesc{OutputKind::RadianceSh2}};
}

// Each measurement and plane over independent seeds.
BlockMeans ball_means(const ScenePointer& scene, const SensorPointer& sensor, const TransportOptions& options,
                      uint64_t passes, int seeds, uint64_t first_seed) {
  std::vector<Picture> pictures(static_cast<size_t>(seeds));
  in_parallel(pictures.size(),
              [&](size_t i) { pictures[i] = render(scene, sensor, options, passes, first_seed * 1000 + i); });
  BlockMeans means;
  means.values.resize(size_t(sensor->planes()) * sensor->count());
  for (const Picture& p : pictures) {
    size_t value = 0;
    for (int plane = 0; plane < sensor->planes(); ++plane) {
      const std::vector<float> map = read(*p.film, FilmLayer::Color, 0, 0, plane);
      for (size_t i = 0; i < sensor->count(); ++i) means.values[value++].add(grey(&map[3 * i]));
    }
    means.rejected += p.film->rejected() + p.stats.rejected;
  }
  return means;
}

struct Asked {
  std::vector<Way> ways;
  SensorPointer sensor;
  uint64_t passes = 64;
  int seeds = 32;
};
std::vector<BlockMeans> expect_agreement(const ScenePointer& scene, const Asked& asked) {
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : asked.ways) {
    const uint64_t passes = way.name == "s = 0" ? 4 * asked.passes : asked.passes;
    means.push_back(ball_means(scene, asked.sensor, way.options, passes, asked.seeds, means.size()));
    names.push_back(way.name);
  }
  expect_all_same(means, names);
  return means;
}

// Fluence 4 pi in a furnace of radiance 1, from balls that lie within, reach through walls, and hold one another.
TEST(BakeProbe, FurnaceByEveryTechniqueAndPlan) {
  Builder b;
  b.add(scenes::box(Vec3(-1), Vec3(1), true), scenes::emitter(Rgb(1), false, 0.5f));
  const ScenePointer scene = b.build();
  const SensorPointer sensor =
      points({ball(Vec3(0), 0.4f), ball(Vec3(0.1f, 0, 0), 0.8f), ball(Vec3(0.5f, -0.6f, 0.3f), 0.1f)},
             {OutputDesc{OutputKind::Fluence}});
  const std::vector<Way> all = ways(0);
  for (size_t i = 0; i < all.size(); ++i) {
    const BlockMeans means = ball_means(scene, sensor, all[i].options, 1024, 32, i);
    EXPECT_EQ(means.rejected, 0u);
    // Few light subpaths cross a small ball.
    const double most = all[i].name == "t = 0" ? 0.04 : all[i].name == "t = 1" ? 0.02 : 0.005;
    for (const Estimate& e : means.values) {
      expect_value(e, 8 * M_PI, 3 * all.size(), all[i].name, 1e-4);
      EXPECT_LT(e.standard_error(), most * 8 * M_PI) << all[i].name;
    }
  }
}

// A square lamp and a ball: the fluence is the mean solid angle times the radiance.
TEST(BakeProbe, DirectLightOfALampByEachTechnique) {
  Builder b;
  b.add(
      scenes::quad(Vec3(-0.3f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, 0.4f), Vec3(-0.3f, 0.6f, 0.4f)),
      scenes::emitter(Rgb(3)));
  const ScenePointer scene = b.build();
  const SensorPointer sensor = points({ball(Vec3(0.1f, 0, 0), 0.3f)}, fluence_and_harmonics());
  // The solid angle of a rectangle from a corner above the point, summed over four; by points of a ball.
  const auto corner = [](double x, double y, double h) {
    return std::atan(x * y / (h * std::sqrt(x * x + y * y + h * h)));
  };
  double mean = 0, weight = 0;
  constexpr int n = 60;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const double x = (2 * (i + 0.5) / n - 1) * 0.3, y = (2 * (j + 0.5) / n - 1) * 0.3,
                     z = (2 * (k + 0.5) / n - 1) * 0.3;
        if (x * x + y * y + z * z > 0.09) continue;
        const double px = 0.1 + x, h = 0.6 - y;
        mean += corner(0.5 - px, 0.4 - z, h) - corner(-0.3 - px, 0.4 - z, h) - corner(0.5 - px, -0.2 - z, h) +
                corner(-0.3 - px, -0.2 - z, h);
        weight += 1;
      }
  std::vector<Way> all = {{"s = 0", options_for(only(0, 2), 1)},
                          {"(1,1)", options_for(only(1, 1), 1)},
                          {"(2,0)", options_for(only(2, 0), 1)},
                          {"all", options_for({}, 1)},
                          {"balance", options_for({}, 1)},
                          {"cutoff", options_for({}, 1)},
                          {"(2,0) and (1,1)", options_for(mask_of([](int, int t) { return t <= 1; }), 1)},
                          {"(2,0) and (0,2)", options_for(mask_of([](int s, int) { return s != 1; }), 1)}};
  all[4].options.heuristic = Heuristic::Balance;
  all[5].options.heuristic = Heuristic::Cutoff, all[5].options.cutoff = 0.1f;
  const std::vector<BlockMeans> means = expect_agreement(scene, {all, sensor, 8192, 32});
  for (size_t i = 0; i < all.size(); ++i) {
    expect_value(means[i].values[0], 3 * mean / weight, all.size(), all[i].name, 1e-4);
    EXPECT_LT(means[i].values[0].standard_error(), 4e-3 * 3 * mean / weight) << all[i].name;
  }
}

// The sky starts its rays on a disk as large as the scene: balls within it, half out of it, and far above.
TEST(BakeProbe, ASkyByEachTechniqueEvenOutsideOfTheScene) {
  Builder b;
  b.add(scenes::quad(Vec3(-1, -0.5f, 1), Vec3(1, -0.5f, 1), Vec3(1, -0.5f, -1), Vec3(-1, -0.5f, -1)),
        scenes::diffuse(0.6f));
  b.environment(Rgb(1));
  const ScenePointer scene = b.build();
  const SensorPointer sensor = points({ball(Vec3(0, 0.2f, 0), 0.3f), ball(Vec3(1.2f, 0, 0.3f), 0.6f),
                                       ball(Vec3(0, 2.6f, 0), 1), ball(Vec3(0, -0.5f, 0), 0.4f)},
                                      fluence_and_harmonics());
  std::vector<Way> all;
  for (int edges : {1, 0})
    for (const Way& way : {Way{"all", options_for({}, edges)},
                           Way{"s = 0", options_for(mask_of([](int s, int) { return s == 0; }), edges)},
                           Way{"not s = 0", options_for(mask_of([](int s, int) { return s > 0; }), edges)},
                           Way{"not s = 1", options_for(mask_of([](int s, int) { return s != 1; }), edges)},
                           Way{"t <= 1", options_for(mask_of([](int, int t) { return t <= 1; }), edges)},
                           Way{"cutoff", options_for({}, edges)}}) {
      all.push_back(way);
      if (way.name == "cutoff") all.back().options.heuristic = Heuristic::Cutoff, all.back().options.cutoff = 0.1f;
    }
  const std::vector<Way> direct(all.begin(), all.begin() + 6), whole(all.begin() + 6, all.end());
  expect_agreement(scene, {direct, sensor, 1024, 32});
  expect_agreement(scene, {whole, sensor, 1024, 32});
}

struct Room {
  bool glass = false, sky = false, spot = false;
};
ScenePointer lit_room(const Room& room = {}) {
  Builder b;
  b.add(scenes::box(Vec3(-1), Vec3(1), true, room.sky ? 63 - 2 : 63), scenes::diffuse(Rgb(0.7f, 0.5f, 0.4f)));
  const float half = room.glass ? 0.1f : 0.3f;
  b.add(
      scenes::quad(Vec3(-half, 0.9f, -half), Vec3(half, 0.9f, -half), Vec3(half, 0.9f, half), Vec3(-half, 0.9f, half)),
      scenes::emitter(Rgb(4, 3.5f, 3)));
  b.add(scenes::box(Vec3(-0.6f, -1, -0.5f), Vec3(-0.1f, -0.4f, 0.1f), false), scenes::diffuse(0.6f));
  if (room.glass) b.add_sphere(Vec3(0.1f, 0.2f, 0.1f), 0.3f, scenes::dielectric(1.5f));
  if (room.sky) b.environment(Rgb(1, 1.5f, 2), 1);
  if (room.spot) b.spot(Vec3(-0.5f, 0.5f, 0.5f), Vec3(0.5f, -1, -0.3f), Rgb(2, 1, 1), 60, 25);
  return b.build();
}

// One in the open, one through which the box reaches, one that touches the floor, and points that are no balls.
SensorPointer room_probes(const std::vector<OutputDesc>& outputs, bool points_too) {
  std::vector<MeasuredPoint> all = {ball(Vec3(0.1f, -0.5f, 0.2f), 0.25f), ball(Vec3(-0.2f, -0.4f, 0.1f), 0.2f),
                                    ball(Vec3(0.6f, -0.9f, 0.5f), 0.1f)};
  if (points_too) all.insert(all.end(), {{Vec3(0.1f, -0.5f, 0.2f)}, {Vec3(0.5f, 0, 0), Vec3(0, 1, 0), 0.1f}});
  return points(all, outputs);
}

TEST(BakeProbe, EveryTechniqueAndPlanMeasureTheSame) {
  expect_agreement(lit_room(), {ways(4), room_probes(fluence_and_harmonics(), false), 512, 32});
}

TEST(BakeProbe, PointsAndDisksBesideBalls) {
  std::vector<Way> all = ways(4);
  std::erase_if(all, [](const Way& w) { return w.name == "t = 0"; });  // they have none
  all.push_back({"no t = 0", options_for(mask_of([](int, int t) { return t > 0; }), 4)});
  all.push_back({"cutoff", options_for({}, 4)});
  all.back().options.heuristic = Heuristic::Cutoff, all.back().options.cutoff = 0.1f;
  expect_agreement(lit_room(), {all, room_probes(fluence_and_harmonics(), true), 512, 32});
}

// A small lamp over a sphere of glass: light behind it is found by s = 0 and by t = 0.
TEST(BakeProbe, CausticsOfAGlassSphere) {
  std::vector<Way> all = ways(5);
  std::erase_if(all, [](const Way& w) { return w.name == "s <= 1, t >= 1" || w.name == "t = 1"; });
  const std::vector<BlockMeans> means =
      expect_agreement(lit_room({.glass = true}), {all, room_probes(fluence_and_harmonics(), false), 512, 32});
  // What it is for: of path tracing's noise a part remains.
  const TransportOptions eye = options_for(mask_of([](int s, int t) { return s <= 1 && t >= 1; }), 5);
  const BlockMeans path =
      ball_means(lit_room({.glass = true}), room_probes(fluence_and_harmonics(), false), eye, 512, 32, 9);
  EXPECT_LT(means[2].values[0].standard_error(), 0.3 * path.values[0].standard_error());
}

TEST(BakeProbe, SkyThroughAMissingWall) {
  expect_agreement(lit_room({.sky = true}), {ways(4), room_probes(fluence_and_harmonics(), false), 512, 32});
}

TEST(BakeProbe, ASpotIsNotHit) {
  std::vector<Way> all = ways(4);
  std::erase_if(all, [](const Way& w) { return w.name == "s = 0"; });
  expect_agreement(lit_room({.spot = true}), {all, room_probes(fluence_and_harmonics(), false), 512, 32});
}

// Options that must not change what is measured.
TEST(BakeProbe, HeuristicsAndCounts) {
  const ScenePointer scene = lit_room({.sky = true});
  std::vector<Way> all = {{"power", options_for({}, 4)}};
  const auto add = [&](const char* name, const char* plan, const std::function<void(TransportOptions&)>& change) {
    all.push_back({name, with_plan(options_for({}, 4), plan)});
    change(all.back().options);
  };
  add("balance", "one-to-one", [](auto& o) { o.heuristic = Heuristic::Balance; });
  for (const char* plan : {"one-to-one", "two-way", "pooled", "matrix", "combinatorial"})
    add("cutoff", plan, [](auto& o) { o.heuristic = Heuristic::Cutoff, o.cutoff = 0.1f; });
  add("maximum", "one-to-one", [](auto& o) { o.heuristic = Heuristic::Maximum; });
  add("tree", "one-to-one", [](auto& o) { o.light_selection = LightSelection::Tree; });
  add("three light subpaths", "one-to-one", [](auto& o) { o.light_samples = 3; });
  add("seven in the pool", "pooled", [](auto& o) { o.connections = 7, o.light_samples = 2; });
  add("aware of correlation", "combinatorial", [](auto& o) { o.correlation_aware = true; });
  for (const char* plan : {"one-to-one", "two-way", "pooled", "matrix"})
    add("t <= 1", plan, [](auto& o) { o.techniques = mask_of([](int, int t) { return t <= 1; }); });
  add("Sobol", "matrix", [](auto& o) { o.sampler = SamplerType::Sobol; });
  expect_agreement(scene, {all, room_probes({OutputDesc{OutputKind::Fluence}}, false), 512, 32});
}

// Running sums and the plain loop are two codes for one weight.
TEST(BakeProbe, RunningSumsAreTheReference) {
  for (const bool sky : {false, true}) {
    const ScenePointer scene = lit_room({.sky = sky});
    const SensorPointer sensor = room_probes({OutputDesc{OutputKind::Fluence}}, true);
    TransportOptions sums = options_for({}, 4), loop = sums;
    loop.correlation_aware = true;  // which changes nothing where a vertex meets one other
    const std::vector<float> a = read(*render(scene, sensor, sums, 256, 3).film),
                             b = read(*render(scene, sensor, loop, 256, 3).film);
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 2e-5f * a[i]) << i;
  }
}

// What a cone sees of a sky of radiance 1: pi sin² of its angle, and 2 pi (1 - cos) without the cosine; of a lamp that
// it sees in part; and of all light in a room, by every plan.
TEST(BakeProbe, ConesByEveryTechniqueAndPlan) {
  Builder sky;
  sky.environment(Rgb(1));
  const ScenePointer open = sky.build();
  std::vector<MeasuredPoint> cones;
  const std::vector<double> angles = {0.5, 20, 45, 89, 90};
  for (const double degrees : angles) cones.push_back({Vec3(0), unit(Vec3(1, 2, -1)), 0, float(degrees * M_PI / 180)});
  const SensorPointer both = points(cones, {OutputDesc{OutputKind::Irradiance}, OutputDesc{OutputKind::Fluence}});
  for (const Way& way : ways(1)) {
    if (way.name == "t = 0" || way.name == "t = 1") continue;
    const BlockMeans means = ball_means(open, both, way.options, 256, 32, 1);
    for (size_t i = 0; i < angles.size(); ++i) {
      const double a = angles[i] * M_PI / 180, half = std::sin(a / 2);
      expect_value(means.values[i], M_PI * std::pow(std::sin(a), 2), 60, way.name, 1e-5);
      expect_value(means.values[angles.size() + i], 4 * M_PI * half * half, 60, way.name, 1e-5);
      EXPECT_LT(means.values[i].standard_error(), 0.02 * means.values[i].mean()) << way.name;
    }
  }
  // By direct light alone, which looks at directions that it did not choose.
  const BlockMeans direct = ball_means(open, both, options_for(only(1, 1), 1), 8192, 32, 2);
  for (size_t i = 1; i < angles.size(); ++i) {
    const double half = std::sin(angles[i] * M_PI / 360);
    expect_value(direct.values[angles.size() + i], 4 * M_PI * half * half, 60, "(1,1)", 1e-5);
  }
  std::vector<Way> all = ways(4);
  std::erase_if(all, [](const Way& w) { return w.name == "t = 0"; });
  const SensorPointer placed =
      points({{Vec3(0.2f, 0, 0.1f), Vec3(0, 1, 0), 0, 0.3f}, {Vec3(0, -0.5f, 0.5f), Vec3(0, 0, -1), 0.1f, 0.9f}},
             {OutputDesc{OutputKind::Irradiance}, OutputDesc{OutputKind::Fluence}});
  expect_agreement(lit_room({.sky = true}), {all, placed, 512, 32});
}

// The two sides know one density: a ray's chord, and that of any of its points seen from there.
TEST(BakeProbe, BothSidesKnowTheChord) {
  statistics::Uniform u(5);
  const auto sensor = points({ball(Vec3(1, 2, 3), 0.5f), ball(Vec3(1.2f, 2, 3), 1.5f), {Vec3(1, 2, 3)}},
                             {OutputDesc{OutputKind::Fluence}});
  size_t found = 0, within = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin = Vec3(1, 2, 3) + Vec3(u() - 0.5f, u() - 0.5f, u() - 0.5f) * 4.0f;
    const Vec3 d = unit(Vec3(u() - 0.5f, u() - 0.5f, u() - 0.5f));
    std::vector<Crossing> crossings;
    sensor->cross(origin, d, 3e38f, crossings);
    for (const Crossing& c : crossings) {
      const double t = c.begin + (c.end - c.begin) * double(u());
      EyeStart z0;
      static_cast<SensorPlace&>(z0) = sensor->point_in(c.number, origin + d * float(t));
      if (c.end - c.begin < 0.2 || t < 0.01) continue;  // roundings
      ASSERT_NEAR(double(sensor->chord_density(z0, -d, float(t))) * (c.end - c.begin), 1, 1e-4);
      ++found, within += c.begin == 0;
    }
  }
  EXPECT_GT(found, 2000u);
  EXPECT_GT(within, 500u);
  EXPECT_LT(within, found - 500);
}

// The tree finds what a plain loop does.
TEST(BakeProbe, TheTreeFindsEveryBall) {
  statistics::Uniform u(7);
  std::vector<Ball> balls;
  for (uint32_t i = 0; i < 500; ++i)
    balls.push_back({Vec3(u(), u(), u()) * 10.0f, i % 7 == 0 ? 2 * u() : 0.2f * u() + 0.01f, i});
  balls.push_back(balls[0]);
  const BallTree tree(balls);
  size_t found = 0;
  for (int ray = 0; ray < 2000; ++ray) {
    const Vec3 origin = Vec3(u(), u(), u()) * 10.0f;
    Vec3 d = unit(Vec3(u() - 0.5f, u() - 0.5f, u() - 0.5f));
    if (ray % 4 == 0) d = Vec3(0), d[ray / 4 % 3] = ray % 8 ? 1.0f : -1.0f;
    const float tmax = ray % 3 ? 3e38f : 10 * u();
    std::vector<uint32_t> seen, expected;
    double begin, end;
    tree.each(origin, d, tmax, [&](const Ball& b, double, double) { seen.push_back(b.number); });
    for (const Ball& b : balls)
      if (chord(origin, d, b, begin, end) && begin < double(tmax)) expected.push_back(b.number);
    std::sort(seen.begin(), seen.end()), std::sort(expected.begin(), expected.end());
    ASSERT_EQ(seen, expected) << ray;
    found += seen.size();
  }
  EXPECT_GT(found, 3000u);
}

}  // namespace bdpt::bake_probe_test
