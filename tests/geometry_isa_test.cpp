// Every instruction set that the machine has finds what the others find, however few rays a packet holds.
#include <gtest/gtest.h>

#include "geometry/embree.h"
#include "scenes.h"
#include "statistics.h"

namespace bdpt::geometry_isa_test {

// A ball and a floor below it.
class EveryIsa : public testing::TestWithParam<Isa> {};

std::unique_ptr<RayScene> scene_for(Isa isa) {
  static const std::shared_ptr<const Mesh> meshes[] = {
      scenes::make_mesh(scenes::ball(Vec3(0, 1, 0), 1, 8, false)),
      scenes::make_mesh(scenes::quad(Vec3(-3, 0, 3), Vec3(3, 0, 3), Vec3(3, 0, -3), Vec3(-3, 0, -3)))};
  std::vector<RayGeometry> geometries;
  for (const auto& mesh : meshes) {
    geometries.emplace_back();
    geometries.back().mesh = mesh.get();
    geometries.back().world_positions = mesh->positions;
  }
  return std::make_unique<RayScene>(std::make_shared<const RayDevice>(isa, std::make_shared<MemoryMeter>(0)),
                                    geometries, [](double) { return true; });
}

std::vector<Ray> random_rays(size_t count) {
  statistics::Uniform u(1);
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    ray.origin = Vec3(float(4 * u() - 2), float(3 * u() + 0.1), float(4 * u() - 2));
    ray.direction = Vec3(float(u() - 0.5), float(u() - 0.5), float(u() - 0.5));
    ray.tmax = float(20 * u());
  }
  return rays;
}

TEST_P(EveryIsa, FindsWhatTheOthersFind) {
  std::unique_ptr<RayScene> scene;
  try {
    scene = scene_for(GetParam());
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  const auto best = scene_for(Isa::Best);
  const std::vector<Ray> rays = random_rays(1000);
  std::vector<Hit> hits(rays.size()), expected(rays.size());
  std::vector<uint8_t> blocked(rays.size());
  best->intersect(rays.data(), expected.data(), rays.size());
  size_t first = 0;
  for (size_t count = 1; first + count <= rays.size(); first += count, count = count % 20 + 1) {
    scene->intersect(&rays[first], &hits[first], count);
    scene->occluded(&rays[first], &blocked[first], count);
  }
  size_t met = 0;
  for (size_t i = 0; i < first; ++i) {
    ASSERT_EQ(hits[i].instance, expected[i].instance) << "ray " << i;
    ASSERT_EQ(blocked[i] != 0, expected[i].instance != kMiss) << "ray " << i;
    if (expected[i].instance == kMiss) continue;
    ++met;
    EXPECT_NEAR(hits[i].t, expected[i].t, 1e-5f * expected[i].t) << "ray " << i;
  }
  EXPECT_GT(met, first / 4);
}

INSTANTIATE_TEST_SUITE_P(Sets, EveryIsa, testing::Values(Isa::Sse42, Isa::Avx2, Isa::Avx512),
                         [](const testing::TestParamInfo<Isa>& info) {
                           return info.param == Isa::Sse42  ? std::string("sse42")
                                  : info.param == Isa::Avx2 ? std::string("avx2")
                                                            : std::string("avx512");
                         });

}  // namespace bdpt::geometry_isa_test
