// Lightmaps against closed forms, and each technique of theirs against each other.
#include "baking.h"

namespace bdpt {
namespace {

using namespace baking;
using scenes::Builder;

scenes::MeshData room_of_quads() { return scenes::unwrapped(scenes::box(Vec3(-1), Vec3(1), true), 3, 0.02f); }

// Irradiance over that of the furnace, pi L / (1 - albedo), in every texel.
TEST(BakeLightmap, FurnaceByEveryTechniqueAndPlan) {
  Builder b;
  b.add(room_of_quads(), scenes::emitter(Rgb(1), false, 0.5f));
  const ScenePointer scene = b.build();
  const SensorPointer sensor = lightmap(scene, 12);
  const std::vector<Way> all = ways(0);
  for (const Way& way : all) {
    Effort effort;
    effort.seeds = 16, effort.passes = 16;
    Estimate whole;
    for (int seed = 0; seed < effort.seeds; ++seed) {
      const std::vector<float> map = read(*render(scene, sensor, way.options, effort.passes, uint64_t(seed)).film);
      double sum = 0, area = 0;
      for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) {
          const double a = double(static_cast<const Lightmap&>(*sensor).texels().area(x, y));
          sum += a * double(map[3 * size_t(y * 12 + x)]), area += a;
        }
      whole.add(sum / area);
      EXPECT_NEAR(area, 24, 1e-4);
    }
    expect_value(whole, 2 * M_PI, all.size(), way.name, 1e-4);
    // Its 1 / r^2 has no finite variance, but all techniques together have.
    if (way.name != "t = 1") EXPECT_LT(whole.standard_error(), 0.002 * 2 * M_PI) << way.name;
  }
}

// A room with a lamp, a box and a ball; the floor and the walls are mapped, the rest casts shadows and scatters.
ScenePointer lit_room() {
  Builder b;
  b.add(room_of_quads(), scenes::diffuse(Rgb(0.7f, 0.5f, 0.4f)));
  b.add(
      scenes::quad(Vec3(-0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, 0.1f), Vec3(-0.4f, 0.9f, 0.1f)),
      scenes::emitter(Rgb(4, 3.5f, 3)));
  b.add(scenes::box(Vec3(-0.6f, -1, -0.5f), Vec3(-0.1f, -0.4f, 0.1f), false), scenes::diffuse(0.6f));
  b.add(scenes::ball(Vec3(0.4f, -0.5f, 0.3f), 0.4f, 4, true), scenes::conductor(0.5f, 0.5f));
  return b.build();
}

TEST(BakeLightmap, EveryTechniqueAndPlanMeasureTheSame) {
  const ScenePointer scene = lit_room();
  const SensorPointer sensor = lightmap(scene, 12);
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : ways(4)) {
    Effort effort;
    effort.seeds = 24, effort.passes = way.name == "s = 0" ? 64 : 16, effort.side = 4, effort.first_seed = means.size();
    means.push_back(block_means(scene, sensor, way.options, effort));
    names.push_back(way.name);
  }
  expect_all_same(means, names);
}

}  // namespace
}  // namespace bdpt
