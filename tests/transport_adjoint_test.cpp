// Light subpaths scatter by the adjoint: refraction scales radiance and not importance, and shading normals need
// Veach's correction (chapter 5). Where a single boundary or bend parts the ends, techniques agree only with both.
#include "rendering.h"

namespace bdpt::transport_adjoint_test {

using namespace rendering;

void expect_techniques_agree(const ScenePointer& scene, const SensorPointer& camera, int k, int first_s, int last_s) {
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (int s = first_s; s <= last_s; ++s) {
    TransportOptions options = options_for(only(s, k + 1 - s), k);
    options.heuristic = Heuristic::None;
    options.sampler = SamplerType::Sobol;
    means.push_back(
        block_means(scene, camera, options, {.passes = s > k ? 256u : 128u, .first_seed = uint64_t(s) + 1}));
    names.push_back(technique_name(s, k + 1 - s));
  }
  expect_all_same(means, names);
}

SensorPointer wide_lens() {
  scenes::Viewpoint view{Vec3(0, 0, 1.5f), Vec3(0), 50};
  view.lens_radius = 0.4f;
  view.focus = 1.5f;
  return scenes::camera(view, 16, 16);
}

// Seen through one boundary, from within to without: its radiance falls by the squared ratio of indices.
TEST(TransportAdjoint, EmitterWithinRoughGlass) {
  scenes::Builder b;
  b.add_sphere(Vec3(0), 0.5f, scenes::dielectric(1.5f, 0.5f));
  b.add_sphere(Vec3(0.05f, 0, 0), 0.3f, scenes::emitter(Rgb(2)));
  expect_techniques_agree(b.build(), wide_lens(), 2, 0, 3);
}

TEST(TransportAdjoint, EmitterWithinSmoothGlass) {
  scenes::Builder b;
  b.add_sphere(Vec3(0), 0.5f, scenes::dielectric(1.5f));
  b.add_sphere(Vec3(0.05f, 0, 0), 0.3f, scenes::emitter(Rgb(2)));
  const ScenePointer scene = b.build();
  const auto measure = [&](int s, uint64_t passes) {
    TransportOptions options = options_for(only(s, 3 - s), 2);
    options.heuristic = Heuristic::None;
    return block_means(scene, wide_lens(), options, {.passes = passes, .first_seed = uint64_t(s) + 1});
  };
  expect_same(measure(0, 32), measure(3, 256), 1, "(0,3) against (3,0)");
}

// The floor is lit by what a coarse ball with smooth normals scatters, once and nothing else.
TEST(TransportAdjoint, LightFromASmoothShadedBall) {
  for (const bool glossy : {false, true}) {
    scenes::Builder b;
    b.add(scenes::quad(Vec3(-1, -1, 1), Vec3(1, -1, 1), Vec3(1, -1, -1), Vec3(-1, -1, -1)), scenes::diffuse(0.8f));
    b.add(scenes::ball(Vec3(0, 0, 0), 0.5f, 3, true), glossy ? scenes::conductor(0.5f, 0.5f) : scenes::diffuse(0.8f));
    b.spot(Vec3(-1.5f, -0.3f, 0), Vec3(1.5f, 0.25f, 0), Rgb(20), 14, 10);
    const SensorPointer camera = scenes::camera({Vec3(-0.8f, -0.2f, 1.2f), Vec3(-0.4f, -1, 0), 35}, 16, 16);
    expect_techniques_agree(b.build(), camera, 3, 1, 3);
  }
}

}  // namespace bdpt::transport_adjoint_test
