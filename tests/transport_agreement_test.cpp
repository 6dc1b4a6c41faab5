// Every subset of techniques that covers the paths gives the same picture, by whatever weights.
#include "rendering.h"

namespace bdpt::transport_agreement_test {

using namespace rendering;
using scenes::Contents;
using scenes::RoomOptions;

constexpr int kSize = 32;

struct Way {
  std::string name;
  TransportOptions options;
  uint64_t passes;
};

Way way(const std::string& name, uint64_t passes, const std::function<bool(int, int)>& allows) {
  return {name, options_for(mask_of(allows), 5), passes};
}
Way path() {
  return way("path, s <= 1", 4, [](int s, int) { return s <= 1; });
}
Way light(uint64_t passes = 8) {
  return way("light, t <= 1", passes, [](int, int t) { return t <= 1; });
}
Way two_way() {
  return way("two-way", 4, [](int s, int t) { return s <= 1 || t <= 1; });
}
Way no_light_image() {
  return way("t >= 2", 4, [](int, int t) { return t >= 2; });
}
Way no_hits() {
  return way("s >= 1", 4, [](int s, int) { return s >= 1; });
}
Way whole() {
  return way("bidirectional", 4, [](int, int) { return true; });
}
Way odd() {  // no class of techniques is whole: the plain loop
  return way("s <= 1, and s + t odd", 4, [](int s, int t) { return s <= 1 || (s + t) % 2 == 1; });
}
Way by(const std::string& name, Heuristic heuristic, float beta = 2, float cutoff = 0) {
  Way w = whole();
  w.name = name;
  w.options.heuristic = heuristic;
  w.options.beta = beta;
  w.options.cutoff = cutoff;
  return w;
}
std::vector<Way> heuristics() {
  return {by("balance", Heuristic::Balance), by("power 1", Heuristic::Power, 1),
          by("power 3.5", Heuristic::Power, 3.5f), by("cutoff", Heuristic::Cutoff, 2, 0.1f),
          by("maximum", Heuristic::Maximum)};
}

// Each way against each other and against all techniques; `effort` multiplies the passes.
void expect_agreement(const RoomOptions& room, const scenes::Viewpoint& view, std::vector<Way> ways, uint64_t effort,
                      StartBy light_start = StartBy::Power) {
  const ScenePointer scene = scenes::room(room).build();
  const SensorPointer camera = scenes::camera(view, kSize, kSize);
  ways.push_back(whole());
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& w : ways) {
    TransportOptions options = w.options;
    options.light_start = light_start;
    means.push_back(block_means(scene, camera, options, {.passes = effort * w.passes, .first_seed = means.size() + 1}));
    names.push_back(w.name);
  }
  expect_all_same(means, names);
}

TEST(TransportAgreement, EverySubsetOfTechniquesGivesTheSamePictureOfADiffuseRoom) {
  expect_agreement({.points = true}, scenes::room_view(),
                   {path(), light(), two_way(), no_light_image(), no_hits(), odd()}, 4);
}

TEST(TransportAgreement, EverySubsetOfTechniquesGivesTheSamePictureThroughALens) {
  expect_agreement({.points = true}, scenes::room_view_through_lens(),
                   {path(), light(), two_way(), no_light_image(), no_hits()}, 3);
}

TEST(TransportAgreement, EveryHeuristicGivesTheSamePicture) {
  expect_agreement({.contents = Contents::Glossy, .points = true}, scenes::room_view(), heuristics(), 2);
}

TEST(TransportAgreement, EveryHeuristicGivesTheSamePictureThroughALensWithUniformLightStart) {
  expect_agreement({.points = true, .environment = true}, scenes::room_view_through_lens(), heuristics(), 2,
                   StartBy::Uniform);
}

TEST(TransportAgreement, GlossySurfacesAndAnEnvironment) {
  expect_agreement({.contents = Contents::Glossy, .environment = true}, scenes::room_view(),
                   {path(), light(), two_way(), no_light_image(), no_hits()}, 3, StartBy::Uniform);
}

TEST(TransportAgreement, GlassAndMirrors) {
  expect_agreement({.contents = Contents::Specular, .environment = true}, scenes::room_view(),
                   {path(), two_way(), no_light_image(), odd()}, 2);
}

TEST(TransportAgreement, GlassAndMirrorsThroughALens) {
  expect_agreement({.contents = Contents::Specular}, scenes::room_view_through_lens(),
                   {path(), light(), two_way(), no_light_image()}, 2);
}

// Points that are stratified, and numbers shared or used twice, would show where eye and light subpaths meet.
TEST(TransportAgreement, EverySamplerGivesTheSamePicture) {
  const ScenePointer scene = scenes::room({.points = true}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view_through_lens(), kSize, kSize);
  std::vector<BlockMeans> means;
  for (SamplerType sampler : {SamplerType::Independent, SamplerType::Sobol, SamplerType::Stratified}) {
    TransportOptions options = options_for({}, 5);
    options.sampler = sampler;
    means.push_back(block_means(scene, camera, options, {.passes = 12, .first_seed = means.size() + 1}));
  }
  for (size_t i = 1; i < means.size(); ++i) expect_same(means[i], means[0], 2, "sampler " + std::to_string(i));
}

// Only direct lighting by techniques whose variance is finite: the average bounds none.
TEST(TransportAgreement, PlainAverageOfDirectLighting) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  const TechniqueMask mask = mask_of([](int s, int t) { return s + t <= 3 && t >= 1; });
  TransportOptions options = options_for(mask, 2);
  const BlockMeans power = block_means(scene, camera, options, {});
  options.heuristic = Heuristic::Average;
  expect_same(block_means(scene, camera, options, {.passes = 16, .first_seed = 2}), power, 1,
              "average against power 2");
}

}  // namespace bdpt::transport_agreement_test
