// Every technique alone, unweighted, gives the same picture of all paths of its length.
#include "rendering.h"

namespace bdpt::transport_technique_test {

using namespace rendering;

// No two surfaces touch, so that no connection's geometry factor is without bounds. A lens of a third of the width.
ScenePointer separate_panels() {
  scenes::Builder b;
  b.add(scenes::quad(Vec3(-1, -1, 1), Vec3(1, -1, 1), Vec3(1, -1, -1), Vec3(-1, -1, -1)), scenes::diffuse(0.7f));
  b.add(scenes::quad(Vec3(-1.3f, -0.7f, -1), Vec3(-1.3f, 0.8f, -1), Vec3(-1.3f, 0.8f, 1), Vec3(-1.3f, -0.7f, 1)),
        scenes::diffuse(Rgb(0.8f, 0.5f, 0.5f)));
  b.add(scenes::quad(Vec3(-1, -0.7f, -1.4f), Vec3(1, -0.7f, -1.4f), Vec3(1, 0.8f, -1.4f), Vec3(-1, 0.8f, -1.4f)),
        scenes::conductor(0.6f, 0.5f));
  b.add(scenes::ball(Vec3(0.3f, -0.2f, 0), 0.4f, 3, true), scenes::diffuse(0.8f));
  b.add(scenes::quad(Vec3(-1, 1.2f, -1), Vec3(1, 1.2f, -1), Vec3(1, 1.2f, 1), Vec3(-1, 1.2f, 1)),
        scenes::emitter(Rgb(2), false, 0.5f));
  b.add_sphere(Vec3(0.8f, 0.1f, 0.3f), 0.2f, scenes::emitter(Rgb(3)));
  return b.build();
}

class TransportTechnique : public ::testing::TestWithParam<int> {};

TEST_P(TransportTechnique, AloneGivesThePictureOfItsPaths) {
  const int k = GetParam();
  const ScenePointer scene = separate_panels();
  scenes::Viewpoint view{Vec3(0.1f, 0.1f, 1.9f), Vec3(0.1f, -0.3f, 0), 50};
  view.lens_radius = 0.4f;
  view.focus = 2;
  const SensorPointer camera = scenes::camera(view, 16, 16);
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (int s = 0; s <= k + 1; ++s) {
    TransportOptions options = options_for(only(s, k + 1 - s), k);
    options.heuristic = Heuristic::None;
    options.sampler = SamplerType::Sobol;  // the seeds are independent; each is the better for it
    options.roulette_start = 20;
    // Hits are rare where the other techniques choose, and little of the light comes into the picture.
    const uint64_t passes = s >= 2 ? 512 : 256;
    means.push_back(block_means(scene, camera, options, {.passes = passes, .first_seed = uint64_t(10 * k + s)}));
    names.push_back(technique_name(s, k + 1 - s));
  }
  expect_all_same(means, names);
}

INSTANTIATE_TEST_SUITE_P(OfEdges, TransportTechnique, ::testing::Values(1, 2, 3));

}  // namespace bdpt::transport_technique_test
