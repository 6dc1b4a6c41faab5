// Direct lighting: however lights are chosen for s = 1, and however many, the picture is the same.
#include "rendering.h"
#include "transport/block.h"
#include "transport/plan.h"

namespace bdpt::transport_direct_test {

using namespace rendering;
using scenes::Builder;

constexpr int kSize = 32;

// A room with a mesh light of many triangles, lights of all kinds, and many small ones of different power.
ScenePointer hall() {
  Builder b = scenes::room({.contents = scenes::Contents::Glossy, .points = true, .environment = true});
  b.add(scenes::ball(Vec3(-0.6f, 0.5f, -0.6f), 0.15f, 5, false), scenes::emitter(Rgb(1.5f, 2, 1)));
  b.add(scenes::disk(Vec3(0.98f, 0, 0), Vec3(-1, 0, 0), 0.2f, 12), scenes::emitter(Rgb(2)));
  statistics::Uniform uniform(1);
  for (int i = 0; i < 30; ++i) {
    const Vec3 at((uniform() - 0.5f) * 1.6f, (uniform() - 0.5f) * 1.6f, -0.95f + 0.2f * uniform());
    const Frame f(unit(Vec3(uniform() - 0.5f, uniform() - 0.5f, 1)));
    const float side = 0.02f + 0.04f * uniform();
    const Vec3 s = f.t * side, t = f.b * side;
    b.add(scenes::quad(at - s - t, at + s - t, at + s + t, at - s + t),
          scenes::emitter(Rgb(1 + 10 * uniform(), 3, 2), i % 3 == 0));
  }
  return b.build();
}

struct Way {
  std::string plan;
  LightSelection selection;
  uint64_t passes;
  int samples = 1, candidates = 1;
  bool path = false;
  Heuristic heuristic = Heuristic::Power;
  std::string name() const {
    return std::string(path ? "path" : plan) + ", selection " + std::to_string(int(selection)) +
           ", n = " + std::to_string(samples) + ", M = " + std::to_string(candidates) + ", heuristic " +
           std::to_string(int(heuristic));
  }
};

TransportOptions options_of(const Way& way) {
  TransportOptions o = options_for({}, 5);
  if (way.path) o.techniques = mask_of([](int s, int) { return s <= 1; });
  o.plan = find_plan(way.plan.c_str());
  o.light_selection = way.selection;
  o.direct_samples = way.samples;
  o.direct_candidates = way.candidates;
  o.heuristic = way.heuristic;
  return o;
}

void expect_agreement(const ScenePointer& scene, const scenes::Viewpoint& view, const std::vector<Way>& ways,
                      uint64_t effort) {
  const SensorPointer camera = scenes::camera(view, kSize, kSize);
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : ways) {
    means.push_back(
        block_means(scene, camera, options_of(way), {.passes = effort * way.passes, .first_seed = means.size() + 1}));
    names.push_back(way.name());
  }
  expect_all_same(means, names);
}

using enum LightSelection;

TEST(TransportDirect, EverySelectionGivesTheSamePicture) {
  expect_agreement(hall(), scenes::room_view(),
                   {{.plan = "one-to-one", .selection = Uniform, .passes = 8, .path = true},
                    {.plan = "one-to-one", .selection = Tree, .passes = 4, .path = true},
                    {.plan = "one-to-one", .selection = Each, .passes = 1, .path = true},
                    {.plan = "one-to-one", .selection = Power, .passes = 4},
                    {.plan = "one-to-one", .selection = Tree, .passes = 4},
                    {.plan = "one-to-one", .selection = Each, .passes = 1},
                    {.plan = "two-way", .selection = Tree, .passes = 4},
                    {.plan = "pooled", .selection = Tree, .passes = 4},
                    {.plan = "matrix", .selection = Tree, .passes = 8},
                    {.plan = "one-to-one", .selection = Tree, .passes = 4, .heuristic = Heuristic::Maximum}},
                   3);
}

TEST(TransportDirect, SeveralSamplesAndCandidatesGiveTheSamePicture) {
  expect_agreement(
      hall(), scenes::room_view_through_lens(),
      {{.plan = "one-to-one", .selection = Uniform, .passes = 8, .path = true},
       {.plan = "one-to-one", .selection = Tree, .passes = 2, .samples = 3, .path = true},
       {.plan = "one-to-one", .selection = Tree, .passes = 2, .candidates = 4, .path = true},
       {.plan = "one-to-one", .selection = Uniform, .passes = 2, .samples = 2, .candidates = 4, .path = true},
       {.plan = "one-to-one", .selection = Each, .passes = 1, .samples = 2, .candidates = 2, .path = true},
       {.plan = "one-to-one", .selection = Tree, .passes = 2, .samples = 3},
       {.plan = "one-to-one", .selection = Power, .passes = 2, .candidates = 4},
       {.plan = "pooled", .selection = Tree, .passes = 2, .samples = 3, .candidates = 4},
       {.plan = "one-to-one", .selection = Tree, .passes = 2, .samples = 3, .heuristic = Heuristic::Maximum}},
      3);
}

// Direct lighting alone, without weights, where no two surfaces touch: samples counted as more or fewer than they are
// would show as less or more light, whatever other techniques do.
TEST(TransportDirect, AloneIsTheSameHoweverManySamples) {
  Builder b;
  b.add(scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1)), scenes::diffuse(0.8f));
  b.add(scenes::ball(Vec3(0.3f, 0.6f, 0), 0.1f, 6, false), scenes::emitter(Rgb(4)));
  b.add_sphere(Vec3(-0.4f, 0.5f, 0.2f), 0.1f, scenes::emitter(Rgb(2)));
  b.spot(Vec3(-0.5f, 1, -0.5f), Vec3(0.3f, -1, 0.3f), Rgb(1), 40, 20);
  b.add(scenes::quad(Vec3(-0.1f, 0.3f, 0), Vec3(0.1f, 0.3f, 0), Vec3(0.1f, 0.3f, -0.2f), Vec3(-0.1f, 0.3f, -0.2f)),
        scenes::diffuse(0.5f));  // a shadow
  b.environment(Rgb(0.2f));
  const ScenePointer scene = b.build();
  const SensorPointer camera = scenes::camera({Vec3(0, 1.2f, 2), Vec3(0, 0.1f, 0), 40}, kSize, kSize);
  const auto measure = [&](const Way& way, uint64_t seed) {
    TransportOptions options = options_of(way);
    options.techniques = only(1, 2);
    return block_means(scene, camera, options, {.passes = way.passes, .first_seed = seed});
  };
  const BlockMeans expected = measure({.plan = "one-to-one", .selection = Power, .passes = 64}, 1);
  const std::vector<Way> ways = {
      {.plan = "one-to-one", .selection = Uniform, .passes = 32},
      {.plan = "one-to-one", .selection = Tree, .passes = 16},
      {.plan = "one-to-one", .selection = Each, .passes = 8},
      {.plan = "one-to-one", .selection = Each, .passes = 8, .samples = 2, .candidates = 3},
      {.plan = "one-to-one", .selection = Tree, .passes = 8, .samples = 3},
      {.plan = "one-to-one", .selection = Tree, .passes = 8, .candidates = 4},
      {.plan = "one-to-one", .selection = Power, .passes = 8, .samples = 3, .candidates = 5}};
  uint64_t seed = 1;
  for (const Way& way : ways) expect_same(measure(way, ++seed), expected, ways.size(), way.name());
}

// What candidates are for: less variance without shadows, where lights differ in what they send.
TEST(TransportDirect, CandidatesAndSamplesLowerTheVariance) {
  Builder b;
  b.add(scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1)), scenes::diffuse(0.8f));
  for (int i = 0; i < 16; ++i)
    b.add_sphere(Vec3(float(i % 4) * 0.5f - 0.75f, 0.2f, float(i / 4) * 0.5f - 0.75f), 0.03f,
                 scenes::emitter(Rgb(float(1 + i))));
  const ScenePointer scene = b.build();
  const SensorPointer camera = scenes::camera({Vec3(0, 1.2f, 2), Vec3(0, 0.1f, 0), 40}, kSize, kSize);
  const auto variance = [&](const Way& way, uint64_t seed) {
    TransportOptions options = options_of(way);
    options.techniques = only(1, 2);
    const BlockMeans means = block_means(scene, camera, options, {.passes = 1, .first_seed = seed});
    double sum = 0;
    for (size_t i = 0; i + 4 < means.values.size(); ++i) sum += means.values[i].variance();
    return sum;
  };
  const double one = variance({.plan = "one-to-one", .selection = Uniform, .passes = 1}, 1);
  EXPECT_LT(3 * variance({.plan = "one-to-one", .selection = Uniform, .passes = 1, .samples = 8}, 2), one);
  EXPECT_LT(3 * variance({.plan = "one-to-one", .selection = Uniform, .passes = 1, .candidates = 8}, 3), one);
  EXPECT_LT(3 * variance({.plan = "one-to-one", .selection = Tree, .passes = 1}, 4), one);
}

// Old films go on: options that are not given leave the hash as it was.
TEST(TransportDirect, OnlyWhatIsNotTheDefaultEntersTheHash) {
  TransportOptions plain;
  EXPECT_EQ(plain.hash(), 0xd1bda028e88ff89dull);
  std::vector<uint64_t> hashes = {plain.hash()};
  const auto add = [&](const std::function<void(TransportOptions&)>& change) {
    TransportOptions o;
    change(o);
    for (uint64_t h : hashes) EXPECT_NE(o.hash(), h);
    hashes.push_back(o.hash());
  };
  for (LightSelection selection : {Uniform, Tree, Each}) add([&](auto& o) { o.light_selection = selection; });
  for (int n : {2, 3, 64}) {
    add([&](auto& o) { o.direct_samples = n; });
    add([&](auto& o) { o.direct_candidates = n; });
    add([&](auto& o) { o.light_samples = n; });
  }
}

}  // namespace bdpt::transport_direct_test
