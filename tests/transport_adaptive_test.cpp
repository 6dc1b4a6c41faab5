// Adaptive sampling of the image plane: the picture stays, samples go where the noise is, and none is taken twice.
#include "rendering.h"
#include "transport/plan.h"
#include "transport/sample_rates.h"

namespace bdpt::transport_adaptive_test {

using namespace rendering;
using scenes::Contents;

constexpr int kSize = 32;

TransportOptions options_of(const Plan* plan, Adaptive adaptive) {
  TransportOptions o = options_for({}, 5);
  o.plan = plan;
  o.pool_passes = 2;
  o.adaptive = adaptive;
  return o;
}

std::vector<size_t> plans_with_pixels() {
  std::vector<size_t> plans;
  for (size_t i = 0; plan_at(i); ++i)
    if (!plan_at(i)->chains) plans.push_back(i);
  return plans;
}

class AdaptiveOf : public ::testing::TestWithParam<size_t> {
 protected:
  const Plan* plan_ = plan_at(GetParam());
  bool is_slow() const { return std::string(plan_->name) == "combinatorial"; }
};

// With glass, a lens and a point light: eye image and light image alike. Two passes leave fractions of samples.
TEST_P(AdaptiveOf, LeavesThePictureAsItWas) {
  const ScenePointer scene = scenes::room({.contents = Contents::Specular, .points = true}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view_through_lens(), kSize, kSize);
  std::vector<BlockMeans> means;
  const int seeds = is_slow() ? 16 : 32;
  for (const auto& [adaptive, by_weights, passes] : std::vector<std::tuple<Adaptive, bool, uint64_t>>{
           {Adaptive::None, false, 4}, {Adaptive::TwoStages, false, 2}, {Adaptive::TwoStages, true, 4}}) {
    FilmDesc film = film_desc(kSize, kSize);
    film.normalize_by_weights = by_weights;
    means.push_back(block_means(scene, camera, film, options_of(plan_, adaptive),
                                {.seeds = seeds, .passes = passes, .first_seed = 10 * GetParam() + means.size() + 1}));
  }
  expect_all_same(means, {"one each", "adaptive", "adaptive, by weights"});
}

// The noise is small enough to tell two per cent, of the picture and of the light image; five where samples are slow.
TEST_P(AdaptiveOf, CountsSamplesInFull) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  for (bool light : {false, true}) {
    std::vector<BlockMeans> means;
    for (Adaptive adaptive : {Adaptive::None, Adaptive::TwoStages}) {
      TransportOptions options = options_of(plan_, adaptive);
      // Without s = 0 and s = 1 the light image has most of the light.
      if (light) options.techniques = mask_of([](int s, int) { return s >= 2; });
      means.push_back(block_means(
          scene, camera, options,
          {.passes = is_slow() ? 2u : 16u, .first_seed = 100 + 10 * GetParam() + means.size(), .side = kSize}));
    }
    expect_all_same(means, {"one each", "adaptive"});
    const double error = std::hypot(means[0].whole().standard_error(), means[1].whole().standard_error());
    EXPECT_LT(4 * error, (is_slow() ? 0.05 : 0.02) * means[0].whole().mean());
  }
}

TEST_P(AdaptiveOf, TakesAsManySamplesWhereTheyAreWanted) {
  const ScenePointer scene = scenes::room({.points = true}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  const auto film = std::make_shared<Film>(film_desc(kSize, kSize), nullptr);
  RenderDesc desc;
  desc.transport = options_of(plan_, Adaptive::TwoStages);
  Render render(scene, camera, film, caller(), nullptr, desc);
  AdvanceDesc advance;
  advance.passes = 8;
  render.advance(advance);
  const SampleRates& rates = render.engine().rates;
  ASSERT_TRUE(rates.are_set());
  double sum = 0, least = 4, most = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const double r = rates.rate(x, y);
      sum += r, least = std::min(least, r), most = std::max(most, r);
    }
  EXPECT_DOUBLE_EQ(rates.mean() * kSize * kSize, sum);
  EXPECT_EQ(render.stats().samples, uint64_t(8 * sum));
  EXPECT_NEAR(rates.mean(), 1, 0.05);
  EXPECT_LT(least, most);
}

INSTANTIATE_TEST_SUITE_P(Plans, AdaptiveOf, ::testing::ValuesIn(plans_with_pixels()), [](const auto& info) {
  std::string name = plan_at(info.param)->name;
  std::erase(name, '-');
  return name;
});

// Light tracing gains nothing by eye samples.
TEST(Adaptive, AllAreAlikeWhereThereIsNothingToGain) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  TransportOptions options = options_for(mask_of([](int, int t) { return t <= 1; }), 4);
  const std::vector<float> without = read(*render(scene, camera, options, 3, 1).film);
  options.adaptive = Adaptive::TwoStages;
  EXPECT_EQ(read(*render(scene, camera, options, 3, 1).film), without);
}

// --- Rates ---

constexpr RegionMeasure kCalm{1, 1, 10};

SampleRates rates_of(const std::vector<RegionMeasure>& eye, const RegionGrid& grid, uint64_t seed = 1) {
  SampleRates rates;
  rates.set(grid, eye, eye, seed);
  return rates;
}

// Left half: four times the variance, or a quarter of the rays.
TEST(SampleRates, GoWithDeviationOverRootOfRays) {
  const RegionGrid grid({0, 0, 128, 64});
  for (const RegionMeasure& noisy :
       {RegionMeasure{1, 4, 10}, RegionMeasure{1, 1, 2.5}, RegionMeasure{0.5, 0.9902, 10}}) {
    std::vector<RegionMeasure> eye(grid.count(), kCalm);
    for (size_t i = 0; i < eye.size(); ++i)
      if (i % 16 < 8) eye[i] = noisy;
    const SampleRates rates = rates_of(eye, grid);
    EXPECT_NEAR(rates.mean(), 1, 0.05);
    EXPECT_NEAR(rates.rate(10, 30) / rates.rate(100, 30), 2, 0.35) << noisy.mean;
    EXPECT_GE(rates.rate(62, 30), rates.rate(66, 30));
  }
}

TEST(SampleRates, StayWithinTheirLimits) {
  const RegionGrid grid({-1, -1, 127, 63});
  std::vector<RegionMeasure> eye(grid.count(), kCalm);
  eye[grid.region({20, 20})].variance = 1e12;  // one rare bright sample
  for (int empty = 0; empty < 3; ++empty) {
    if (empty == 1)
      for (RegionMeasure& m : eye) m.variance = m.variance > 1 ? 1e12 : 0;
    if (empty == 2)
      for (RegionMeasure& m : eye) m = {0, 0, 1};
    const SampleRates rates = rates_of(eye, grid);
    for (int y = -1; y < 63; ++y)
      for (int x = -1; x < 127; ++x) {
        EXPECT_GE(rates.rate(x, y), 0.5);
        EXPECT_LE(rates.rate(x, y), 4);
        if (empty == 2) {
          EXPECT_EQ(rates.rate(x, y), 1);
        }
      }
    EXPECT_NEAR(rates.mean(), 1, 0.125) << empty;  // nearly all regions go up by a quarter at once
  }
}

TEST(SampleRates, EverySampleIsTakenOnce) {
  const RegionGrid grid({-2, -2, 62, 62});
  std::vector<RegionMeasure> eye(grid.count());
  for (size_t i = 0; i < eye.size(); ++i) eye[i] = {1, std::pow(1.3, double(i % 24)), 10};
  const SampleRates rates = rates_of(eye, grid);
  for (uint64_t group = 0; group < 5; ++group)
    for (int y = -2; y < 62; ++y)
      for (int x = -2; x < 62; ++x) {
        uint64_t next = 0;
        for (uint64_t index = 0; index < 12; ++index) {
          const SampleRates::Numbers n = rates.numbers({group, index}, x, y);
          ASSERT_EQ(n.begin, next);
          ASSERT_LE(n.begin, n.end);
          next = n.end;
          ASSERT_GE(next, index / 2);
          if (index % 4 == 3) {
            ASSERT_EQ(double(next), double(index + 1) * rates.rate(x, y));
          }
        }
      }
}

// The first pass has r samples of a pixel, in the mean over seeds.
TEST(SampleRates, FractionsAreFair) {
  const RegionGrid grid({0, 0, 64, 64});
  std::vector<RegionMeasure> eye(grid.count());
  for (size_t i = 0; i < eye.size(); ++i) eye[i] = {1, std::pow(1.3, double(i % 24)), 10};
  constexpr uint64_t kSeeds = 4000;
  for (const auto& [x, y] : std::vector<std::pair<int, int>>{{0, 0}, {13, 4}, {50, 7}, {37, 33}, {63, 63}}) {
    uint64_t samples = 0;
    double rate = 0;
    for (uint64_t seed = 0; seed < kSeeds; ++seed) {
      const SampleRates rates = rates_of(eye, grid, seed);
      const SampleRates::Numbers n = rates.numbers({1, 0}, x, y);
      samples += n.end - n.begin;
      rate = rates.rate(x, y);
    }
    EXPECT_NEAR(double(samples) / kSeeds, rate, 5 * 0.5 / std::sqrt(double(kSeeds)));
  }
}

TEST(PassInGroup, HasItsPass) {
  for (uint64_t pool : {1u, 2u, 8u})
    for (int groups : {1, 2, 3, 16})
      for (uint64_t pass = 0; pass < 200; ++pass)
        ASSERT_EQ(pass_of(pass_in_group(pass, pool, groups), pool, groups), pass);
}

}  // namespace bdpt::transport_adaptive_test
