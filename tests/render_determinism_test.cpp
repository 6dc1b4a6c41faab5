// The same seed and passes give the same film, bit for bit, however the work was done.
#include "rendering.h"
#include "temp_folder.h"
#include "transport/plan.h"

#include <fstream>
#include <iterator>

namespace bdpt::render_determinism_test {

using namespace rendering;

constexpr int kWidth = 29, kHeight = 23;
constexpr uint64_t kPasses = 7;

struct Kind {
  std::string name;
  SamplerType sampler;
  const char* plan;
  int light_samples = 1;
  uint64_t pool_passes = 1;  // all numbers of passes below are times this
  Roulette roulette = Roulette::None;
  LightSelection selection = LightSelection::Power;
  int direct_samples = 1;
  Adaptive adaptive = Adaptive::None;
  StartBy light_start = StartBy::Power;
  PoolSelection pool_selection = PoolSelection::Uniform;
  bool correlation_aware = false;
  Matrix matrix = Matrix::PerTechnique;
  int pool_pixels = 0;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class RenderDeterminism : public ::testing::TestWithParam<Kind> {
 protected:
  struct Work {
    uint64_t first = 0, passes = kPasses;
    uint32_t block_size = 0;
    std::shared_ptr<Executor> executor = threads(2);
  };

  RenderDesc desc(const Work& work) const {
    RenderDesc d;
    d.transport.sampler = GetParam().sampler;
    d.transport.plan = find_plan(GetParam().plan);
    d.transport.light_samples = GetParam().light_samples;
    d.transport.pool_passes = int(GetParam().pool_passes);
    d.transport.shadow_roulette = GetParam().roulette;
    d.transport.light_selection = GetParam().selection;
    d.transport.direct_samples = d.transport.direct_candidates = GetParam().direct_samples;
    d.transport.adaptive = GetParam().adaptive;
    d.transport.light_start = GetParam().light_start;
    d.transport.pool_selection = GetParam().pool_selection;
    d.transport.correlation_aware = GetParam().correlation_aware;
    d.transport.matrix = GetParam().matrix;
    d.transport.pool_pixels = GetParam().pool_pixels;
    d.transport.strata = 2;
    d.transport.max_edges = 5;
    d.seed = 99;
    d.first_pass = work.first * unit();
    d.block_size = work.block_size;
    return d;
  }
  static uint64_t unit() { return GetParam().pool_passes; }
  std::shared_ptr<Film> new_film() const {
    FilmDesc d = film_desc(kWidth, kHeight, 3);
    d.filter.type = FilterType::Mitchell;
    d.normalize_by_weights = true;
    d.groups = 3;
    return std::make_shared<Film>(d, nullptr);
  }
  std::shared_ptr<Film> filled(const Work& work) const {
    auto film = new_film();
    Render render(scene_, camera_, film, work.executor, nullptr, desc(work));
    AdvanceDesc advance;
    advance.passes = work.passes * unit();
    EXPECT_EQ(render.advance(advance).passes, work.passes * unit());
    return film;
  }
  std::string bytes(const Film& film) const {
    const std::string path = folder_.file("film");
    film.save(path);
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  std::string expected() const { return bytes(*filled({.block_size = 64, .executor = threads(1)})); }

  ScenePointer scene_ =
      scenes::room({.contents = scenes::Contents::Specular, .points = true, .environment = true}).build();
  SensorPointer camera_ = scenes::camera(scenes::room_view_through_lens(), kWidth, kHeight);
  TempFolder folder_;
};

// Runs the bodies one by one, backwards; calls `between` after each.
struct Backwards {
  std::function<void()> between;
  static void run(void* user, uint32_t n, void (*body)(void*, uint32_t), void* body_user) {
    for (uint32_t i = n; i-- > 0;) {
      body(body_user, i);
      if (static_cast<Backwards*>(user)->between) static_cast<Backwards*>(user)->between();
    }
  }
  std::shared_ptr<Executor> executor() { return make_host_executor({1, &run, this, nullptr}); }
};

TEST_P(RenderDeterminism, AnyNumberOfThreads) {
  const std::string one = expected();
  for (uint32_t n : {2u, 3u}) EXPECT_TRUE(bytes(*filled({.block_size = 64, .executor = threads(n)})) == one) << n;
}

TEST_P(RenderDeterminism, AnyBlockSize) {
  const std::string one = expected();
  for (uint32_t n : {1u, 7u, 256u, 1000u}) EXPECT_TRUE(bytes(*filled({.block_size = n})) == one) << n;
}

TEST_P(RenderDeterminism, AnyOrderOfBlocks) {
  Backwards backwards;
  EXPECT_TRUE(bytes(*filled({.block_size = 64, .executor = backwards.executor()})) == expected());
}

TEST_P(RenderDeterminism, RangesMerge) {
  const std::string one = expected();
  for (uint64_t k : {1u, 3u, 6u}) {
    auto film = filled({.passes = k});
    film->merge(*filled({.first = k, .passes = kPasses - k}));
    EXPECT_TRUE(bytes(*film) == one) << k;
  }
}

TEST_P(RenderDeterminism, RangesMergeInAnyOrder) {
  const std::string one = expected();
  const std::shared_ptr<Film> parts[] = {filled({.passes = 2}), filled({.first = 2, .passes = 3}),
                                         filled({.first = 5, .passes = 2})};
  int order[] = {0, 1, 2};
  do {
    auto film = new_film();
    for (int i : order) film->merge(*parts[i]);
    EXPECT_TRUE(bytes(*film) == one) << order[0] << order[1] << order[2];
  } while (std::next_permutation(order, order + 3));
}

TEST_P(RenderDeterminism, AGapIsFilledLater) {
  auto film = filled({.passes = 2});
  film->merge(*filled({.first = 4, .passes = 3}));
  {
    Render render(scene_, camera_, film, threads(2), nullptr, desc({}));
    AdvanceDesc advance;
    advance.passes = 2 * unit();
    EXPECT_EQ(render.advance(advance).next_pass, kPasses * unit());
  }
  EXPECT_TRUE(bytes(*film) == expected());
}

TEST_P(RenderDeterminism, CancelledAndResumed) {
  std::atomic<bool> cancel = false;
  int calls = 0;
  Backwards backwards;
  backwards.between = [&] {
    if (++calls % 31 == 0) cancel = true;
  };
  auto film = new_film();
  Render render(scene_, camera_, film, backwards.executor(), nullptr, desc({.block_size = 64}));
  AdvanceDesc advance;
  advance.cancel = &cancel;
  int stops = 0;
  while (film->passes() < kPasses * unit()) {
    advance.passes = kPasses * unit() - film->passes();
    cancel = false;
    if (render.advance(advance).reason == StopReason::Cancelled) ++stops;
    ASSERT_LT(stops, 1000);
  }
  EXPECT_GT(stops, 2);
  EXPECT_TRUE(bytes(*film) == expected());
}

TEST_P(RenderDeterminism, CancelledAndLeft) {
  std::atomic<bool> cancel = false;
  int calls = 0;
  Backwards backwards;
  backwards.between = [&] {
    if (++calls == 33) cancel = true;
  };
  auto film = new_film();
  {
    Render render(scene_, camera_, film, backwards.executor(), nullptr, desc({.block_size = 64}));
    AdvanceDesc advance;
    advance.cancel = &cancel;
    EXPECT_EQ(render.advance(advance).reason, StopReason::Cancelled);
  }
  const uint64_t done = film->passes();
  ASSERT_GT(done, 0u);
  ASSERT_LT(done, kPasses * unit());
  Render render(scene_, camera_, film, threads(2), nullptr, desc({}));
  AdvanceDesc advance;
  advance.passes = kPasses * unit() - done;
  render.advance(advance);
  EXPECT_TRUE(bytes(*film) == expected());
}

TEST_P(RenderDeterminism, AnotherSeedIsAnotherFilm) {
  auto film = new_film();
  RenderDesc other = desc({});
  other.seed = 100;
  Render render(scene_, camera_, film, threads(2), nullptr, other);
  AdvanceDesc advance;
  advance.passes = kPasses * unit();
  render.advance(advance);
  EXPECT_FALSE(bytes(*film) == expected());
  EXPECT_NE(mean_of(*film), mean_of(*filled({})));
}

INSTANTIATE_TEST_SUITE_P(
    All, RenderDeterminism,
    ::testing::Values(
        Kind{"Sobol", SamplerType::Sobol, "one-to-one"}, Kind{"independent", SamplerType::Independent, "one-to-one", 2},
        Kind{"stratified", SamplerType::Stratified, "one-to-one"}, Kind{"two-way", SamplerType::Sobol, "two-way"},
        Kind{"pooled", SamplerType::Sobol, "pooled", 2}, Kind{"matrix", SamplerType::Independent, "matrix", 1, 2},
        Kind{.name = "matrix for all lengths",
             .sampler = SamplerType::Sobol,
             .plan = "matrix",
             .pool_passes = 2,
             .matrix = Matrix::AllLengths,
             .pool_pixels = 100},
        Kind{"tree", SamplerType::Sobol, "one-to-one", 1, 1, Roulette::None, LightSelection::Tree, 3},
        Kind{.name = "importance",
             .sampler = SamplerType::Sobol,
             .plan = "pooled",
             .light_start = StartBy::Importance,
             .pool_selection = PoolSelection::Importance,
             .correlation_aware = true},
        Kind{"mmlt", SamplerType::Sobol, "mmlt", 1, 2}, Kind{"automatic", SamplerType::Sobol, "automatic", 1, 2},
        Kind{"automatic_efficient", SamplerType::Sobol, "automatic", 1, 2, Roulette::Efficiency},
        Kind{"combinatorial", SamplerType::Independent, "combinatorial"},
        Kind{"roulette", SamplerType::Sobol, "one-to-one", 2, 1, Roulette::Efficiency},
        Kind{"pooled roulette", SamplerType::Sobol, "pooled", 1, 1, Roulette::Efficiency},
        Kind{"matrix roulette", SamplerType::Sobol, "matrix", 1, 2, Roulette::Efficiency},
        Kind{.name = "adaptive",
             .sampler = SamplerType::Stratified,
             .plan = "one-to-one",
             .light_samples = 2,
             .adaptive = Adaptive::TwoStages},
        Kind{.name = "adaptive pooled",
             .sampler = SamplerType::Sobol,
             .plan = "pooled",
             .adaptive = Adaptive::TwoStages},
        Kind{.name = "adaptive matrix with roulette",
             .sampler = SamplerType::Sobol,
             .plan = "matrix",
             .pool_passes = 2,
             .roulette = Roulette::Efficiency,
             .adaptive = Adaptive::TwoStages}));

}  // namespace bdpt::render_determinism_test
