// t = 0: light that finds the lens by itself measures what light tracing and eye subpaths do.
#include "rendering.h"

namespace bdpt::transport_lens_test {

using namespace rendering;
using scenes::Builder;
using scenes::Viewpoint;

constexpr int kMaxEdges = 4;

// A box of half the room's width before a lens a tenth of it wide; a pane of glass stands between them.
Builder box_before_lens(bool glass) {
  Builder b;
  b.add(scenes::box(Vec3(-1), Vec3(1), true, 63 & ~8), scenes::diffuse(0.7f));
  b.add(scenes::box(Vec3(-0.5f, -1, -0.6f), Vec3(0.5f, 0, 0.1f), false), scenes::diffuse(Rgb(0.7f, 0.5f, 0.3f)));
  b.add(scenes::quad(Vec3(-1, 1, -1), Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(-1, 1, 1)), scenes::emitter(Rgb(2)));
  if (glass) b.add(scenes::box(Vec3(-0.6f, -0.6f, 0.5f), Vec3(0.6f, 0.6f, 0.6f), false), scenes::dielectric(1.5f));
  return b;
}

Viewpoint lens(int blades) {
  Viewpoint view{Vec3(0, 0, 0.95f), Vec3(0, -0.3f, -0.6f), 70};
  view.lens_radius = 0.1f;
  view.focus = 1;
  view.blades = blades;
  view.rotation = 20;
  return view;
}

BlockMeans measure(bool glass, int blades, const std::function<bool(int, int)>& allows, uint64_t passes, uint64_t seed,
                   int edges) {
  Effort effort;
  effort.passes = passes;
  effort.first_seed = seed;
  TransportOptions options = options_for(mask_of(allows), edges);
  return block_means(box_before_lens(glass).build(), scenes::camera(lens(blades), 32, 32), options, effort);
}

// Of a path with k >= 1 edges each side's techniques take all.
TEST(TransportLens, LightHittingTheLensGivesThePictureOfLightTracingAndOfPathTracing) {
  for (int blades : {0, 5}) {
    const std::string name = blades ? "bladed, " : "round, ";
    const BlockMeans hits = measure(
        false, blades, [](int, int t) { return t == 0; }, 80, 1, kMaxEdges);
    const BlockMeans traced = measure(
        false, blades, [](int, int t) { return t == 1; }, 8, 2, kMaxEdges);
    const BlockMeans eye = measure(
        false, blades, [](int, int t) { return t >= 2; }, 4, 3, kMaxEdges);
    const BlockMeans all = measure(
        false, blades, [](int, int) { return true; }, 4, 4, kMaxEdges);
    expect_same(hits, eye, 6, name + "t = 0 and t >= 2");
    expect_same(traced, eye, 6, name + "t = 1 and t >= 2");
    expect_same(all, eye, 6, name + "all and t >= 2");
  }
}

// Through the glass light finds the lens by hits only, and eye subpaths find the light by hits or connections beyond.
TEST(TransportLens, LightHittingTheLensThroughGlassGivesThePictureOfPathTracing) {
  const BlockMeans hits = measure(
      true, 6, [](int, int t) { return t == 0; }, 96, 1, 7);
  const BlockMeans eye = measure(
      true, 6, [](int, int t) { return t >= 2; }, 6, 2, 7);
  const BlockMeans light = measure(
      true, 6, [](int, int t) { return t <= 1; }, 12, 3, 7);
  expect_same(hits, eye, 2, "t = 0 and t >= 2");
  expect_same(light, eye, 2, "t <= 1 and t >= 2");
}

}  // namespace bdpt::transport_lens_test
