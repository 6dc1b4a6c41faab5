// Multiplexed Metropolis light transport measures what bidirectional path tracing does, however short its chains are.
#include "rendering.h"
#include "transport/chain.h"
#include "transport/plan.h"

namespace bdpt::transport_mmlt_test {

using namespace rendering;
using scenes::Contents;

constexpr int kSize = 32;

TransportOptions chains_of(int max_edges, int chain_pixels = 0, int chain_candidates = 0) {
  TransportOptions o = options_for({}, max_edges);
  o.plan = find_plan("mmlt");
  o.pool_passes = 4;
  o.chain_pixels = chain_pixels;
  o.chain_candidates = chain_candidates;
  return o;
}

struct Room {
  ScenePointer scene;
  SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  explicit Room(Contents contents) : scene(scenes::room({.contents = contents, .points = true}).build()) {}
  BlockMeans measure(const TransportOptions& options, const Effort& effort) const {
    return block_means(scene, camera, options, effort);
  }
};

TEST(TransportMmlt, MeasuresPathsOfAnyLength) {
  // With caustics of the glass ball; many candidates, for little noise of the whole.
  for (const auto& [contents, edges] : {std::pair(Contents::Diffuse, 1), std::pair(Contents::Diffuse, 2),
                                        std::pair(Contents::Specular, 3), std::pair(Contents::Specular, 6)}) {
    const Room room(contents);
    const BlockMeans chains = room.measure(chains_of(edges, 4, 32), {.passes = 16}),
                     expected = room.measure(options_for({}, edges), {.passes = 32, .first_seed = 2});
    expect_same(chains, expected, 4, "at most " + std::to_string(edges) + " edges");
  }
}

TEST(TransportMmlt, MeasuresPathsOfUnlimitedLength) {
  const Room room(Contents::Diffuse);
  expect_same(room.measure(chains_of(0), {.passes = 16}),
              room.measure(options_for({}, 0), {.passes = 16, .first_seed = 2}), 1, "no limit");
}

// 4 mutations to a chain, and as many chains as candidates; then long chains that start from hardly any choice. What
// such starts lack must be made good by their weight.
TEST(TransportMmlt, IsUnbiasedHoweverShortTheChainsAndFewTheCandidates) {
  const Room room(Contents::Specular);
  const BlockMeans expected = room.measure(options_for({}, 5), {.seeds = 64, .passes = 32});
  expect_same(room.measure(chains_of(5, 1, 1), {.seeds = 64, .passes = 32, .first_seed = 2}), expected, 3, "4");
  expect_same(room.measure(chains_of(5, 256, 1), {.seeds = 64, .passes = 32, .first_seed = 3}), expected, 3,
              "4 chains");
  expect_same(room.measure(chains_of(5, 1024, 1), {.seeds = 64, .passes = 64, .first_seed = 4}), expected, 3,
              "one chain, one candidate");
}

// A chain's first proposal is the candidate: the same contribution, to the bit.
TEST(TransportMmlt, ChainsBeginAtTheirCandidates) {
  for (const auto& view : {scenes::room_view(), scenes::room_view_through_lens()}) {
    const ScenePointer scene =
        scenes::room({.contents = Contents::Specular, .points = true, .environment = true}).build();
    const SensorPointer camera = scenes::camera(view, kSize, kSize);
    Film film(film_desc(kSize, kSize), nullptr);
    const Engine engine(*scene, *camera, film, chains_of(5), 1);
    Block block(engine);
    std::vector<StreamPair> streams;
    for (uint32_t i = 0; i < 2000; ++i) streams.push_back({Stream(1, i), Stream(2, i)});
    const std::vector<Contribution> candidates = block.sample_film(streams);
    std::vector<Chain> chains(candidates.size());
    for (size_t i = 0; i < chains.size(); ++i)
      chains[i].begin(engine.options.techniques, streams[candidates[i].sample], {candidates[i].s, candidates[i].t}, i);
    const std::vector<Contribution>& first = block.sample_chains(chains);
    ASSERT_GT(candidates.size(), 1000u);
    ASSERT_EQ(first.size(), candidates.size());
    std::map<std::pair<uint32_t, uint32_t>, int> techniques;
    for (const Contribution& c : first) {
      const Contribution& expected = candidates[c.sample];
      EXPECT_EQ(c.value.r, expected.value.r);
      EXPECT_EQ(c.value.g, expected.value.g);
      EXPECT_EQ(c.value.b, expected.value.b);
      EXPECT_EQ(c.film.x, expected.film.x);
      EXPECT_EQ(c.film.y, expected.film.y);
      EXPECT_EQ(c.s, expected.s);
      EXPECT_EQ(c.t, expected.t);
      ++techniques[{c.s, c.t}];
    }
    EXPECT_GE(techniques.size(), 12u);
  }
}

// Where every proposal is accepted all coordinates stay uniform, the technique too, and independent from step to step
// where the steps are large.
TEST(TransportMmlt, ProposalsAreUniformWhereTheTargetIs) {
  constexpr int kChains = 20000, kSteps = 5, kBins = 16;
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  Film film(film_desc(kSize, kSize), nullptr);
  const Engine engine(*scene, *camera, film, chains_of(5), 1);
  const TechniqueMask mask = mask_of([](int s, int t) { return t >= 1 && s != 2; });  // of k = 5: s = 0, 1, 3, 4, 5
  std::vector<double> numbers(kBins), moves(kBins), techniques(7);
  for (int i = 0; i < kChains; ++i) {
    Chain chain;
    chain.begin(mask, {Stream(hash_values(i), 1), Stream(hash_values(i), 2)}, {uint32_t(i % 2), 6 - uint32_t(i % 2)},
                uint64_t(i));
    Four before = chain.draw(engine, true, 2, Purpose::Scatter), now{};
    for (int step = 0; step < kSteps; ++step) {
      chain.accept();
      chain.propose(mask, step == 0 ? 1.0f : 0.0f);
      now = chain.draw(engine, true, 2, Purpose::Scatter);
      if (step > 0) {
        EXPECT_LE(std::min(std::fabs(now[1] - before[1]), 1 - std::fabs(now[1] - before[1])), 1.001f / 64);
      }
      if (step == 1) moves[now[1] > before[1] ? 0 : 1] += 1;
      if (step < kSteps - 1) before = now;
    }
    for (int d = 0; d < 4; ++d) numbers[size_t(now[d] * kBins)] += 1;
    techniques[chain.technique().s] += 1;
    EXPECT_EQ(chain.technique().s + chain.technique().t, 6u);
  }
  EXPECT_GT(statistics::chi_square_test(numbers, std::vector<double>(kBins, 4.0 * kChains / kBins)),
            statistics::kSignificance);
  const double n = kChains / 5.0;
  EXPECT_GT(statistics::chi_square_test(techniques, {n, n, 0, n, n, n, 0}), statistics::kSignificance);
  EXPECT_LT(statistics::count_deviation(int64_t(moves[0]), kChains, 0.5), statistics::kMaxDeviation);
}

// The image is the sum of its pyramid, and its layers what their names say, though no sample belongs to a pixel.
TEST(TransportMmlt, TheImageIsTheSumOfItsPyramid) {
  const Room room(Contents::Diffuse);
  FilmDesc desc = film_desc(kSize, kSize, 4);
  desc.normalize_by_weights = true;
  RenderDesc render_desc;
  render_desc.transport = chains_of(4);
  const Picture picture = render(room.scene, room.camera, desc, render_desc, 8);
  EXPECT_GT(picture.stats.accepted, picture.stats.mutations / 10);
  EXPECT_EQ(picture.stats.mutations, uint64_t(kSize * kSize * 8));
  const std::vector<float> image = read(*picture.film), eye = read(*picture.film, FilmLayer::Eye),
                           light = read(*picture.film, FilmLayer::Light);
  std::vector<double> eye_sum(image.size()), light_sum(image.size());
  for (int s = 0; s <= 5; ++s)
    for (int t = 0; s + t <= 5; ++t)
      if (picture.film->has_technique(s, t)) {
        const std::vector<float> layer = read(*picture.film, FilmLayer::Technique, s, t);
        for (size_t i = 0; i < layer.size(); ++i) (t >= 2 ? eye_sum : light_sum)[i] += double(layer[i]);
      }
  double brightest = 0;
  for (size_t i = 0; i < image.size(); ++i) {
    EXPECT_NEAR(eye[i], eye_sum[i], 1e-5 * (1 + eye_sum[i]));
    EXPECT_NEAR(light[i], light_sum[i], 1e-5 * (1 + light_sum[i]));
    EXPECT_NEAR(image[i], eye_sum[i] + light_sum[i], 1e-5 * (1 + eye_sum[i] + light_sum[i]));
    brightest = std::max(brightest, eye_sum[i]);
  }
  EXPECT_GT(brightest, 1);
}

// Path tracing has no light subpaths to join, but a heuristic that is no sum keeps the vertices.
TEST(TransportMmlt, PathTracingByTheMaximumHeuristic) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), 32, 32);
  TransportOptions options = options_for(mask_of([](int s, int t) { return s <= 1 && t >= 2; }), 4);
  options.heuristic = Heuristic::Maximum;
  const BlockMeans expected = block_means(scene, camera, options, {.passes = 16});
  options.plan = find_plan("mmlt");
  options.pool_passes = 4;
  expect_same(block_means(scene, camera, options, {.passes = 16, .first_seed = 2}), expected, 1, "mmlt");
}

}  // namespace bdpt::transport_mmlt_test
