// Instances that receive, but that no ray meets.
#include "baking.h"

namespace bdpt::bake_invisible_test {

using namespace baking;
using scenes::Builder;

scenes::MeshData level(float y, float half) {
  return scenes::quad(Vec3(-half, y, half), Vec3(half, y, half), Vec3(half, y, -half), Vec3(-half, y, -half));
}

// A floor, and a plate over it that would shade it.
ScenePointer plate_over_floor(bool plate, bool invisible = true) {
  Builder b;
  b.add(scenes::unwrapped(level(0, 1), 1, 0), scenes::diffuse(0.5f));
  b.add(scenes::quad(Vec3(-0.5f, 2, -0.5f), Vec3(0.5f, 2, -0.5f), Vec3(0.5f, 2, 0.5f), Vec3(-0.5f, 2, 0.5f)),
        scenes::emitter(Rgb(5)));
  b.environment(Rgb(0.2f), 1);
  if (plate) b.add(scenes::unwrapped(level(0.5f, 0.5f), 1, 0), scenes::diffuse(0.5f));
  if (plate && invisible) b.invisible();
  return b.build();
}

TEST(BakeInvisible, NothingElseChangesABit) {
  const ScenePointer alone = plate_over_floor(false), with = plate_over_floor(true),
                     seen = plate_over_floor(true, false);
  const auto floor = [](const ScenePointer& scene) {
    return read(*render(scene, lightmap(scene, 8), options_for({}, 4), 4, 1).film);
  };
  EXPECT_EQ(floor(alone), floor(with));
  EXPECT_NE(floor(alone), floor(seen));
}

// The plate measures what a plate measures that neither shades nor scatters: light from above alone.
TEST(BakeInvisible, EveryPlanMeasuresTheSameThere) {
  const ScenePointer scene = plate_over_floor(true);
  const SensorPointer sensor = lightmap(scene, 4, {placed(2)});
  EXPECT_FALSE(sensor->is_hittable());
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : ways(4)) {
    if (way.name == "t = 0" || way.name == "t = 1") continue;
    means.push_back(
        block_means(scene, sensor, way.options, {.seeds = 24, .passes = 32, .first_seed = means.size(), .side = 2}));
    names.push_back(way.name);
  }
  expect_all_same(means, names);
}

// Its back sees the floor: the second half of a mesh that is measured on both sides.
TEST(BakeInvisible, ASecondPlacementMeasuresTheBack) {
  const ScenePointer scene = plate_over_floor(true);
  LightmapInstance back = placed(2);
  back.flip = true;
  const auto mean = [&](const LightmapInstance& side) {
    const SensorPointer sensor = lightmap(scene, 4, {side});
    Estimate e;
    for (uint64_t seed = 1; seed <= 8; ++seed) {
      double sum = 0;
      for (const float v : read(*render(scene, sensor, options_for({}, 4), 64, seed).film)) sum += double(v) / 48;
      e.add(sum);
    }
    return e;
  };
  const Estimate top = mean(placed(2)), under = mean(back);
  EXPECT_GT(top.mean(), 1.5 * under.mean());
  EXPECT_GT(under.mean(), 0.2 * double(kPi) * 0.2);  // some of the sky past the floor's edge, and the floor's light
}

TEST(BakeInvisible, LightThatNoRayFindsIsRefused) {
  Builder b;
  b.add(level(0, 1), scenes::emitter(Rgb(1))).invisible();
  EXPECT_THROW(b.build(), Error);
}

TEST(BakeInvisible, ASceneOfNothingElse) {
  Builder b;
  b.add(scenes::unwrapped(level(0, 1), 1, 0), scenes::diffuse(0.5f)).invisible();
  b.environment(Rgb(1), 1);
  const ScenePointer scene = b.build();
  Estimate e;
  for (uint64_t seed = 1; seed <= 16; ++seed) {
    double sum = 0;
    for (const float v : read(*render(scene, lightmap(scene, 2), options_for({}, 4), 256, seed).film))
      sum += double(v) / 12;
    e.add(sum);
  }
  expect_value(e, M_PI, 1, "under the sky", 1e-4);
}

}  // namespace bdpt::bake_invisible_test
