// Every connection plan measures the same.
#include "rendering.h"
#include "transport/plan.h"
#include "transport/subpath_order.h"

#include <array>

namespace bdpt::transport_plan_test {

using namespace rendering;
using scenes::Builder;
using scenes::Contents;
using scenes::RoomOptions;

constexpr int kSize = 32;

struct Way {
  std::string plan;
  uint64_t passes;
  int connections = 0, light_samples = 1;
  Order order = Order::Metric;
  Partners partners = Partners::Sobol;
  Matrix matrix = Matrix::PerTechnique;
  int pool_pixels = 0;
  PoolSelection selection = PoolSelection::Uniform;
  bool correlation_aware = false;
  std::string name() const {
    return plan + ", m = " + std::to_string(connections) + ", n = " + std::to_string(light_samples) + ", order " +
           std::to_string(int(order)) + ", partners " + std::to_string(int(partners)) +
           (selection == PoolSelection::Importance ? ", by importance" : "") +
           (correlation_aware ? ", aware of correlation" : "") + ", matrix " + std::to_string(int(matrix)) +
           ", pixels " + std::to_string(pool_pixels);
  }
};

// More and fewer samples of each kind than Veach's one.
const std::vector<Way> kWays = {
    {"one-to-one", 4},
    {"one-to-one", 4, 0, 3},
    {"two-way", 8},
    {"two-way", 4, 0, 4},
    {"pooled", 4},
    {"pooled", 4, 5},
    {"pooled", 4, 1, 2},
    {.plan = "pooled", .passes = 4, .connections = 3, .selection = PoolSelection::Importance},
    {"combinatorial", 1},
    {"combinatorial", 1, 0, 2},
    {.plan = "pooled", .passes = 2, .connections = 32, .correlation_aware = true},
    {.plan = "combinatorial", .passes = 1, .correlation_aware = true},
    {"matrix", 4},
    {"matrix", 4, 3, 1, Order::Hilbert, Partners::LatinHypercube},
    {"matrix", 4, 1, 2, Order::None},
    {"matrix", 4, 1, 1, Order::Metric, Partners::Sobol, Matrix::AllLengths, 16},
    {"matrix", 4, 2, 2, Order::Hilbert, Partners::LatinHypercube, Matrix::AllLengths, 1024},
    {"mmlt", 4},
    {"automatic", 4},
};

TransportOptions options_of(const Way& way, int max_edges) {
  TransportOptions o = options_for({}, max_edges);
  o.plan = find_plan(way.plan.c_str());
  EXPECT_NE(o.plan, nullptr) << way.plan;
  o.connections = way.connections;
  o.light_samples = way.light_samples;
  o.order = way.order;
  o.partners = way.partners;
  o.correlation_aware = way.correlation_aware;
  o.pool_selection = way.selection;
  o.matrix = way.matrix;
  o.pool_pixels = way.pool_pixels;
  o.pool_passes = 4;
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

// Two plates with a lamp between them: no two surfaces touch, so that techniques of inner vertices have little noise.
class TransportPlanInner : public ::testing::Test {
 protected:
  TransportPlanInner() {
    Builder b;
    b.add(scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1)), scenes::diffuse(0.8f));
    b.add(scenes::quad(Vec3(-1, 1, -1), Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(-1, 1, 1)), scenes::diffuse(0.8f));
    b.add(scenes::quad(Vec3(-0.1f, 0.5f, 0.1f), Vec3(0.1f, 0.5f, 0.1f), Vec3(0.1f, 0.5f, -0.1f),
                       Vec3(-0.1f, 0.5f, -0.1f)),
          scenes::emitter(Rgb(9), true));
    scene_ = b.build();
  }
  BlockMeans measure(const Way& way, const std::function<bool(int, int)>& techniques, uint64_t passes,
                     uint64_t seed) const {
    TransportOptions options = options_of(way, 4);
    options.techniques = mask_of(techniques);
    return block_means(scene_, camera_, options, {.passes = passes, .first_seed = seed, .side = kSize});
  }

 private:
  ScenePointer scene_;
  SensorPointer camera_ = scenes::camera({Vec3(0, 0.8f, 2), Vec3(0, 0.2f, 0), 40}, kSize, kSize);
};

// Samples counted as more or fewer than they are would show as less or more light: what plans do differently, alone.
TEST_F(TransportPlanInner, TechniquesAloneAreThoseOfVeachsPlan) {
  const auto inner = [](int s, int t) { return s >= 2 && t >= 2; };
  const BlockMeans expected = measure(kWays[0], inner, 32, 1);
  uint64_t seed = 1;
  for (const Way& way : kWays)
    if (find_plan(way.plan.c_str())->serves(2, 2))
      expect_same(measure(way, inner, 8, ++seed), expected, kWays.size(), way.name());
}

// Neither a pair that is masked nor one that is too long may be counted as met.
TEST_F(TransportPlanInner, OneMatrixForAllLengthsServesMasks) {
  const auto two = [](int s, int t) { return (s == 2 && t == 3) || (s == 3 && t == 2); };
  const BlockMeans expected = measure(kWays[0], two, 32, 1);
  for (int pixels : {16, 256})
    expect_same(measure({"matrix", 1, 1, 1, Order::Metric, Partners::Sobol, Matrix::AllLengths, pixels}, two, 16, 2),
                expected, 2, std::to_string(pixels));
}

TEST(SubpathOrder, HilbertCurveStepsFromCellToCell) {
  // Every cell of a corner of the grid once, and each next to the one before.
  constexpr uint32_t side = 16;
  std::vector<std::pair<uint64_t, std::array<int, 3>>> cells;
  for (uint32_t x = 0; x < side; ++x)
    for (uint32_t y = 0; y < side; ++y)
      for (uint32_t z = 0; z < side; ++z) cells.push_back({hilbert_index(x, y, z), {int(x), int(y), int(z)}});
  std::sort(cells.begin(), cells.end());
  for (size_t i = 0; i < cells.size(); ++i) {
    EXPECT_EQ(cells[i].first, i);
    if (i == 0) continue;
    int steps = 0;
    for (size_t k = 0; k < 3; ++k) steps += std::abs(cells[i].second[k] - cells[i - 1].second[k]);
    EXPECT_EQ(steps, 1) << i;
  }
}

TEST(SubpathOrder, IsByTheMetricAndHoldsEveryVertexThatCanBeJoined) {
  const ScenePointer scene = scenes::room({.contents = Contents::Specular}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), 16, 16);
  Film film(film_desc(16, 16), nullptr);
  const Engine engine(*scene, *camera, film, options_of({"one-to-one", 1}, 6), 1);
  Block block(engine);
  block.run(0, {0, 0, 16, 16});
  size_t joinable = 0, found = 0;
  for (const Vertex& v : block.light().vertices) joinable += v.joinable;
  OrderedVertices order;
  order_subpaths(block.light(), scene->info(), Order::Metric, Lengths::Apart, order);
  for (size_t s = 0; s < order.size(); ++s) {
    double before = 0;
    for (const OrderedVertex& o : order[s]) {
      double metric = 0;
      for (uint32_t i = o.vertex; i != kNoVertex; i = block.light().vertices[i].previous_index) {
        const Vertex& v = block.light().vertices[i];
        const Vec3 from = v.previous_index == kNoVertex ? block.light().starts[o.sample].origin
                                                        : block.light().vertices[v.previous_index].p;
        metric += double(length_squared(v.p - from));
      }
      EXPECT_EQ(block.light().vertices[o.vertex].count, s);
      EXPECT_GE(metric, before * (1 - 1e-12));
      before = metric;
    }
    found += order[s].size();
  }
  EXPECT_GT(joinable, 100u);
  EXPECT_EQ(found, joinable);
}

TEST(TransportPlan, NamesAreUniqueAndFound) {
  size_t count = 0;
  for (; plan_at(count); ++count) {
    EXPECT_EQ(find_plan(plan_at(count)->name), plan_at(count));
    EXPECT_STRNE(plan_at(count)->summary, "");
  }
  EXPECT_EQ(count, 7u);
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

}  // namespace bdpt::transport_plan_test
