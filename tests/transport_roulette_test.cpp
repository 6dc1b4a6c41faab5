// Roulette of shadow rays: the picture stays, rays are saved, and its pilot finds what it should.
#include "rendering.h"
#include "transport/image_pilot.h"
#include "transport/plan.h"
#include "transport/strategy_pilot.h"

namespace bdpt::transport_roulette_test {

using namespace rendering;
using scenes::Contents;

constexpr int kSize = 32;

TransportOptions options_of(const Plan* plan, Roulette roulette, float threshold = 0) {
  TransportOptions o = options_for({}, 5);
  o.plan = plan;
  o.pool_passes = 4;
  o.shadow_roulette = roulette;
  o.shadow_threshold = threshold;
  return o;
}

std::vector<size_t> plans_with_roulette() {
  std::vector<size_t> plans;
  for (size_t i = 0; plan_at(i); ++i)
    if (!plan_at(i)->chains) plans.push_back(i);
  return plans;
}

class ShadowRouletteOf : public ::testing::TestWithParam<size_t> {
 protected:
  const Plan* plan_ = plan_at(GetParam());
};

// The fixed threshold is above nearly all contributions, of a room with glass.
TEST_P(ShadowRouletteOf, LeavesThePictureAsItWas) {
  const ScenePointer scene = scenes::room({.contents = Contents::Specular, .points = true}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view_through_lens(), kSize, kSize);
  const uint64_t passes = std::string(plan_->name) == "combinatorial" ? 4 : 16;
  std::vector<BlockMeans> means;
  const auto add = [&](Roulette roulette, float threshold) {
    means.push_back(block_means(scene, camera, options_of(plan_, roulette, threshold),
                                {.passes = passes, .first_seed = 10 * GetParam() + means.size() + 1}));
  };
  add(Roulette::None, 0);
  add(Roulette::Fixed, 0.2f);
  add(Roulette::Efficiency, 0);
  expect_all_same(means, {"no roulette", "fixed threshold", "efficiency"});
}

// The threshold is above most contributions, and the noise small enough to tell two per cent.
TEST_P(ShadowRouletteOf, CountsSurvivorsInFull) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  const uint64_t passes = std::string(plan_->name) == "combinatorial" ? 8 : 32;
  std::vector<BlockMeans> means;
  for (Roulette roulette : {Roulette::None, Roulette::Fixed})
    means.push_back(block_means(scene, camera, options_of(plan_, roulette, roulette == Roulette::Fixed ? 0.1f : 0),
                                {.passes = passes, .first_seed = 10 * GetParam() + means.size() + 1, .side = kSize}));
  expect_all_same(means, {"no roulette", "fixed threshold"});
}

TEST_P(ShadowRouletteOf, SavesRays) {
  const ScenePointer scene = scenes::room({.points = true}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  const auto stats = [&](Roulette roulette, float threshold) {
    return render(scene, camera, options_of(plan_, roulette, threshold), 4, 1).stats;
  };
  // A plan that chooses has a pilot of its own, which plays no roulette.
  uint64_t pilot = 0;
  if (plan_->chooses) {
    Film film(film_desc(kSize, kSize), nullptr);
    const Engine engine(*scene, *camera, film, options_of(plan_, Roulette::None), 1);
    StrategyPilot strategies(engine);
    for (uint32_t i = 0; i < strategies.tasks(); ++i) pilot += strategies.run(i).shadow_rays;
  }
  const TransportStats none = stats(Roulette::None, 0), efficient = stats(Roulette::Efficiency, 0);
  const TransportStats high = stats(Roulette::Fixed, 1e3f), low = stats(Roulette::Fixed, 1e-30f);
  EXPECT_EQ(none.shadow_rays_skipped, 0u);
  EXPECT_EQ(low.shadow_rays_skipped, 0u);
  EXPECT_EQ(none.shadow_rays, high.shadow_rays + high.shadow_rays_skipped);
  EXPECT_LT((high.shadow_rays - pilot) * 50, none.shadow_rays - pilot);
  EXPECT_GT(efficient.shadow_rays_skipped * 20, none.shadow_rays - pilot);
  EXPECT_LT(efficient.shadow_rays_skipped, none.shadow_rays - pilot);
  EXPECT_EQ(efficient.samples, none.samples);
}

// Its measures are those of the film, found by other numbers.
TEST_P(ShadowRouletteOf, PilotMeasuresTheImage) {
  constexpr size_t kSeeds = 64;
  const ScenePointer scene = scenes::room({.points = true}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  statistics::Estimate mean, variance, rays, film_mean, film_variance, film_rays;
  for (size_t seed = 0; seed < kSeeds; ++seed) {
    RenderDesc desc;
    desc.transport = options_of(plan_, Roulette::None);
    desc.transport.pool_passes = 1;
    desc.seed = seed;
    const auto film = std::make_shared<Film>(film_desc(kSize, kSize), nullptr);
    Render render(scene, camera, film, caller(), nullptr, desc);
    const Engine& engine = render.engine();
    if (plan_->chooses) {
      StrategyPilot strategies(engine);
      for (uint32_t i = 0; i < strategies.tasks(); ++i) strategies.run(i);
      render.set_strategies(strategies.choose());
    }
    ImagePilot pilot(engine);
    Block block(engine);
    for (uint32_t i = 0; i < pilot.pool_tasks(); ++i) pilot.fill_pool(block, i);
    pilot.finish_pool();
    for (uint32_t i = 0; i < pilot.row_tasks(); ++i) pilot.run_row(block, i);
    double m = 0, v = 0, r = 0;
    const std::vector<RegionMeasure> measures = pilot.measures();
    for (const RegionMeasure& region : measures) {
      m += region.mean / double(measures.size());
      v += region.variance / double(measures.size());
      r += region.rays / double(measures.size());
    }
    mean.add(m), variance.add(v), rays.add(r);

    // The variance from two pictures of one pass each.
    const uint64_t before = render.stats().rays();
    AdvanceDesc advance;
    advance.passes = 1;
    render.advance(advance);
    film_rays.add(double(render.stats().rays() - before) / (kSize * kSize));
    const std::vector<float> a = read(*film);
    const std::vector<float> b = read(*rendering::render(scene, camera, desc.transport, 1, 1000 + seed).film);
    double sum = 0, squares = 0;
    for (size_t i = 0; i < a.size(); i += 3) {
      const double x = double(norm(Rgb(a[i], a[i + 1], a[i + 2]))), y = double(norm(Rgb(b[i], b[i + 1], b[i + 2])));
      sum += x, squares += (x - y) * (x - y) / 2;
    }
    film_mean.add(sum / (kSize * kSize));
    film_variance.add(squares / (kSize * kSize));
  }
  EXPECT_GT(chance(mean, film_mean), statistics::kSignificance) << mean.mean() << ' ' << film_mean.mean();
  EXPECT_GT(chance(rays, film_rays), statistics::kSignificance) << rays.mean() << ' ' << film_rays.mean();
  EXPECT_GT(chance(variance, film_variance), statistics::kSignificance)
      << variance.mean() << " +- " << variance.standard_error() << ' ' << film_variance.mean() << " +- "
      << film_variance.standard_error();
}

INSTANTIATE_TEST_SUITE_P(Plans, ShadowRouletteOf, ::testing::ValuesIn(plans_with_roulette()), [](const auto& info) {
  std::string name = plan_at(info.param)->name;
  std::erase(name, '-');
  return name;
});

// delta* = sqrt(sigma^2 / n) where the regions are alike; a region whose few samples found a rare bright one stops its
// rays no more than its neighbours do.
TEST(ShadowRoulette, ThresholdIsTheDeviationPerRay) {
  const RegionGrid grid({0, 0, 64, 64});
  std::vector<RegionMeasure> measures(grid.count(), {1, 16, 4});
  ShadowRoulette roulette;
  EXPECT_FALSE(roulette.plays());
  roulette.set_efficient(grid, measures);
  ASSERT_TRUE(roulette.plays());
  EXPECT_FLOAT_EQ(roulette.probability({3, 3}, Rgb(0.5f, 0.25f, 0)), 0.25f);
  EXPECT_EQ(roulette.probability({3, 3}, Rgb(2)), 1);
  EXPECT_EQ(roulette.probability({60, 10}, Rgb(5)), 1);
  measures[grid.region({36, 36})].variance = 16e8;
  roulette.set_efficient(grid, measures);
  EXPECT_FLOAT_EQ(roulette.probability({36, 36}, Rgb(1)), float(0.5 / std::pow(1e4, 1.0 / 9)));
  EXPECT_FLOAT_EQ(roulette.probability({3, 3}, Rgb(1)), 0.5f);
}

TEST(RegionGrid, CoversEveryPixelOnce) {
  for (const auto& [w, h] : std::vector<std::pair<int, int>>{{1, 1}, {7, 9}, {64, 20}, {1000, 333}}) {
    const PixelRect bounds{-2, 3, w - 2, h + 3};
    const RegionGrid grid(bounds);
    int covered = 0;
    for (int row = 0; row < grid.rows(); ++row)
      for (int column = 0; column < grid.columns(); ++column) {
        const PixelRect r = grid.rect(column, row);
        ASSERT_LT(r.x0, r.x1);
        ASSERT_LT(r.y0, r.y1);
        covered += (r.x1 - r.x0) * (r.y1 - r.y0);
        for (const auto& [x, y] : std::vector<std::pair<int, int>>{{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}})
          EXPECT_EQ(grid.region({float(x) + 0.5f, float(y) + 0.5f}), size_t(row * grid.columns() + column));
      }
    EXPECT_EQ(covered, w * h);
  }
}

}  // namespace bdpt::transport_roulette_test
