// Every connection plan measures the same.
#include "rendering.h"
#include "transport/plan.h"

namespace bdpt {
namespace {

using namespace rendering;
using scenes::Contents;
using scenes::RoomOptions;

constexpr int kSize = 32;

struct Way {
  std::string plan;
  uint64_t passes;
  int connections = 0, light_samples = 1;
  std::string name() const {
    return plan + ", m = " + std::to_string(connections) + ", n = " + std::to_string(light_samples);
  }
};

// More and fewer samples of each kind than Veach's one.
const std::vector<Way> kWays = {{"one-to-one", 4},    {"one-to-one", 2, 0, 3}, {"two-way", 6},
                                {"two-way", 3, 0, 4}, {"pooled", 4},           {"pooled", 3, 5},
                                {"pooled", 3, 1, 2},  {"combinatorial", 1},    {"combinatorial", 1, 0, 2}};

TransportOptions options_of(const Way& way, int max_edges) {
  TransportOptions o = options_for({}, max_edges);
  o.plan = find_plan(way.plan.c_str());
  EXPECT_NE(o.plan, nullptr) << way.plan;
  o.connections = way.connections;
  o.light_samples = way.light_samples;
  return o;
}

void expect_agreement(const RoomOptions& room, const scenes::Viewpoint& view, uint64_t effort,
                      Heuristic heuristic = Heuristic::Power, float beta = 2) {
  const ScenePointer scene = scenes::room(room).build();
  const SensorPointer camera = scenes::camera(view, kSize, kSize);
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : kWays) {
    TransportOptions options = options_of(way, 5);
    options.heuristic = heuristic;
    options.beta = beta;
    means.push_back(
        block_means(scene, camera, options, {.passes = effort * way.passes, .first_seed = means.size() + 1}));
    names.push_back(way.name());
  }
  expect_all_same(means, names);
}

TEST(TransportPlan, AllGiveTheSamePictureOfADiffuseRoom) { expect_agreement({.points = true}, scenes::room_view(), 2); }
TEST(TransportPlan, AllGiveTheSamePictureThroughALensByTheBalanceHeuristic) {
  expect_agreement({.points = true}, scenes::room_view_through_lens(), 2, Heuristic::Balance);
}
TEST(TransportPlan, AllGiveTheSamePictureOfGlossySurfacesAndAnEnvironment) {
  expect_agreement({.contents = Contents::Glossy, .environment = true}, scenes::room_view(), 1);
}
TEST(TransportPlan, AllGiveTheSamePictureOfGlassAndMirrorsByTheMaximumHeuristic) {
  expect_agreement({.contents = Contents::Specular}, scenes::room_view_through_lens(), 1, Heuristic::Maximum);
}

// Samples of more than their number would show as more light, weights or not.
TEST(TransportPlan, EachTechniqueAloneIsThatOfVeachsPlan) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view_through_lens(), kSize, kSize);
  for (const auto& [s, t] : {std::pair{2, 2}, {3, 2}, {2, 3}, {3, 1}, {4, 0}}) {
    std::vector<BlockMeans> means;
    std::vector<std::string> names;
    for (const Way& way : kWays) {
      if (!find_plan(way.plan.c_str())->serves(s, t)) continue;
      TransportOptions options = options_of(way, 4);
      options.techniques = only(s, t);
      options.heuristic = Heuristic::None;
      means.push_back(block_means(scene, camera, options, {.passes = way.passes, .first_seed = means.size() + 1}));
      names.push_back(way.name() + " " + technique_name(s, t));
    }
    expect_all_same(means, names);
  }
}

TEST(TransportPlan, NamesAreUniqueAndFound) {
  size_t count = 0;
  for (; plan_at(count); ++count) {
    EXPECT_EQ(find_plan(plan_at(count)->name), plan_at(count));
    EXPECT_STRNE(plan_at(count)->summary, "");
  }
  EXPECT_EQ(count, 4u);
  EXPECT_EQ(find_plan("no such plan"), nullptr);
  EXPECT_STREQ(plan_at(0)->name, "one-to-one");
}

// A two-way path leaves nothing behind: a block takes no more memory however long its paths are.
TEST(TransportPlan, TwoWayKeepsNothing) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), 16, 16);
  const auto memory = [&](const char* plan, int edges) {
    TransportOptions options = options_of({plan, 1}, edges);
    options.roulette_start = 1000;
    Film film(film_desc(16, 16), nullptr);
    const Engine engine(*scene, *camera, film, options, 1);
    Block block(engine);
    block.run(0, {0, 0, 16, 16});
    return block.memory();
  };
  EXPECT_EQ(memory("two-way", 5), memory("two-way", 50));
  EXPECT_LT(memory("two-way", 50) * 4, memory("one-to-one", 50));
}

}  // namespace
}  // namespace bdpt
