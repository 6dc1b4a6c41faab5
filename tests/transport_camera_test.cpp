// Every kind of camera gives the same picture by all techniques.
#include "camera_kinds.h"
#include "rendering.h"
#include "transport/plan.h"

namespace bdpt::transport_camera_test {

using namespace rendering;

class TransportCamera : public testing::TestWithParam<scenes::CameraKind> {
 protected:
  SensorPointer camera_ = make_camera(GetParam().desc);

  BlockMeans measure(const ScenePointer& scene, const std::function<bool(int, int)>& allows, uint64_t passes,
                     uint64_t seed, int edges, const FilmDesc& film) const {
    return block_means(scene, camera_, film, options_for(mask_of(allows), edges),
                       {.passes = passes, .first_seed = seed});
  }
  BlockMeans measure(const ScenePointer& scene, const std::function<bool(int, int)>& allows, uint64_t passes,
                     uint64_t seed, int edges) const {
    return measure(scene, allows, passes, seed, edges, film_for(*camera_));
  }
};

std::vector<scenes::CameraKind> kinds() { return scenes::camera_kinds(scenes::room_view()); }

TEST_P(TransportCamera, EveryTechniqueGivesTheSamePicture) {
  const ScenePointer scene = scenes::room({.points = true}).build();
  constexpr int kEdges = 4;
  std::vector<BlockMeans> means;
  means.push_back(measure(
      scene, [](int s, int) { return s <= 1; }, 4, 1, kEdges));
  means.push_back(measure(
      scene, [](int, int t) { return t <= 1; }, 8, 2, kEdges));
  // Wide views hold the points of the lights, which (1,1) alone can join.
  means.push_back(measure(
      scene, [](int s, int t) { return t >= 2 || (s == 1 && t == 1); }, 4, 3, kEdges));
  means.push_back(measure(
      scene, [](int, int) { return true; }, 4, 4, kEdges));
  expect_all_same(means, {"s <= 1", "t <= 1", "t >= 2", "all"});
  if (!camera_->is_hittable()) return;
  const BlockMeans hits = measure(
      scene, [](int, int t) { return t == 0; }, 80, 5, kEdges);
  expect_same(hits, means[2], 1, "t = 0 against t >= 2");
}

// Plans that share light subpaths among pixels, choose by a pilot, or take more samples where it is dark or difficult.
TEST_P(TransportCamera, EveryPlanGivesTheSamePicture) {
  const ScenePointer scene = scenes::room({}).build();
  constexpr int kEdges = 3;
  const BlockMeans plain = measure(
      scene, [](int s, int) { return s <= 1; }, 8, 1, kEdges);
  uint64_t seed = 2;
  for (const char* plan : {"automatic", "pooled", "mmlt"}) {
    TransportOptions options = options_for({}, kEdges);
    options.plan = find_plan(plan);
    if (plan == std::string("automatic")) options.adaptive = Adaptive::TwoStages;
    // A Markov chain's picture is one sample: more seeds' worth of passes.
    const BlockMeans means =
        block_means(scene, camera_, options, {.passes = plan == std::string("mmlt") ? 32u : 8u, .first_seed = seed++});
    expect_same(means, plain, 3, plan);
  }
}

// With a filter whose margin lies outside of the picture.
TEST_P(TransportCamera, LightAndEyeGiveTheSamePictureThroughAFilter) {
  if (camera_->has_seams()) GTEST_SKIP() << "no filter mixes its faces";
  const ScenePointer scene = scenes::room({}).build();
  FilmDesc film = film_for(*camera_);
  film.filter = {FilterType::Gaussian, 2.5f, 0, 0};
  const BlockMeans eye = measure(
      scene, [](int s, int) { return s <= 1; }, 4, 1, 3, film);
  const BlockMeans light = measure(
      scene, [](int, int t) { return t <= 1; }, 8, 2, 3, film);
  const BlockMeans both = measure(
      scene, [](int, int) { return true; }, 4, 3, 3, film);
  expect_all_same({eye, light, both}, {"s <= 1", "t <= 1", "all"});
}

// Eye subpaths that meet the light, points of the light that see the camera, and light that hits the lens.
TEST_P(TransportCamera, AUniformWorldIsUniformByEachTechnique) {
  scenes::Builder b;
  b.add(scenes::box(Vec3(-1.5f), Vec3(1.5f), true), scenes::emitter(Rgb(1)));
  const ScenePointer scene = b.build();
  const auto by = [&](int only_s, uint64_t passes) {
    return measure(
        scene, [=](int s, int t) { return s == only_s && s + t == 2; }, passes, uint64_t(only_s) + 1, 1);
  };
  const BlockMeans eye = by(0, 8), points = by(1, 40);
  expect_same(points, eye, 2, "(1,1) against (0,2)");
  if (camera_->is_hittable()) expect_same(by(2, 80), eye, 2, "(2,0) against (0,2)");
  const double bright = 1 - double(GetParam().darkness);
  if (GetParam().desc.type == CameraType::Lens)
    EXPECT_LT(eye.whole().mean(), bright);
  else
    expect_value(eye.whole(), bright, 1, "(0,2)", 1e-6);
}

std::string test_name(const testing::TestParamInfo<scenes::CameraKind>& info) {
  std::string name;
  for (const char c : info.param.name)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
}
INSTANTIATE_TEST_SUITE_P(Kinds, TransportCamera, testing::ValuesIn(kinds()), test_name);

}  // namespace bdpt::transport_camera_test
