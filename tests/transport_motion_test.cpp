// Motion: what moves while the shutter is open is seen where it is at each sample's time, the same by all techniques.
#include "rendering.h"
#include "transport/plan.h"

namespace bdpt::transport_motion_test {

using namespace rendering;

constexpr int kSize = 24;

Transform moved(const Vec3& by, double turn = 0) {
  Transform t;
  const auto c = float(std::cos(turn)), s = float(std::sin(turn));
  t.m[0] = c, t.m[2] = s, t.m[8] = -s, t.m[10] = c;
  for (int i = 0; i < 3; ++i) t.m[4 * i + 3] = by[i];
  return t;
}

Transform times(const Transform& a, const Transform& b) {
  Transform t;
  for (int i = 0; i < 3; ++i) {
    const Vec3 column = a.vector(b.column(i));
    for (int row = 0; row < 3; ++row) t.m[4 * row + i] = column[row];
  }
  const Vec3 p = a.point(b.column(3));
  for (int row = 0; row < 3; ++row) t.m[4 * row + 3] = p[row];
  return t;
}

// A dark screen that moves before a lamp covers of each column the part of time in which it is there.
TEST(Motion, AScreenCoversItsPartOfTime) {
  scenes::Builder b;
  b.add(scenes::quad(Vec3(-2, -2, -2), Vec3(2, -2, -2), Vec3(2, 2, -2), Vec3(-2, 2, -2)), scenes::emitter(Rgb(1)));
  b.add(scenes::quad(Vec3(-2, -2, -1), Vec3(-1, -2, -1), Vec3(-1, 2, -1), Vec3(-2, 2, -1)), scenes::diffuse(0));
  b.moving(moved(Vec3(2, 0, 0)));  // its right edge goes from -1 to 1
  const SensorPointer camera = scenes::camera({Vec3(0), Vec3(0, 0, -1), 90}, 8, 8);
  for (const TechniqueMask& mask : {only(0, 2), only(1, 1)}) {
    const bool sampled = mask.allows(1, 1);
    const std::vector<float> pixels =
        read(*render(b.build(), camera, options_for(mask, 1), sampled ? 8192 : 2048, 7).film);
    for (int x = 0; x < 8; ++x) {
      double mean = 0;
      for (int y = 2; y < 6; ++y) mean += double(pixels[size_t(3 * (8 * y + x))]) / 4;
      // A column's middle is covered from the time when the edge passes it; a pixel spans an eighth of the way. The
      // left edge, from -2 to 0, uncovers again what lies left of the middle.
      const double place = (x + 0.5) / 8;  // of the right edge's way
      const double covered = x < 4 ? 1 - place - std::max(0.0, 1 - place - 0.5) : 1 - place;
      EXPECT_NEAR(mean, 1 - covered, 0.02) << x << (sampled ? " (1,1)" : " (0,2)");
    }
  }
}

TEST(Motion, ACameraThatMovesSeesWhatASceneThatMovesTheOtherWayShows) {
  const Transform turn = moved(Vec3(0.3f, 0.1f, -0.2f), 0.05);
  const auto scene = [&](bool moves) {
    scenes::Builder b;
    b.add_sphere(Vec3(0.2f, 0, -3), 0.7f, scenes::diffuse(0));
    if (moves) b.moving(invert(turn));
    b.environment(Rgb(1));
    return b.build();
  };
  CameraDesc desc = scenes::camera_desc({Vec3(0), Vec3(0, 0, -1), 50}, 12, 12);
  const SensorPointer still = make_camera(desc);
  desc.moves = true;
  desc.end = times(turn, desc.transform);
  const SensorPointer moving = make_camera(desc);
  TransportOptions options = options_for({}, 3);
  const BlockMeans a = block_means(scene(true), still, options, {.passes = 64, .first_seed = 1});
  const BlockMeans b = block_means(scene(false), moving, options, {.passes = 64, .first_seed = 2});
  // The matrix is interpolated in one, the turn in the other: for 3 degrees they differ by less than a thousandth.
  for (size_t i = 0; i < a.values.size(); ++i) {
    const double error = std::hypot(a.values[i].standard_error(), b.values[i].standard_error());
    EXPECT_NEAR(a.values[i].mean(), b.values[i].mean(), 5 * error + 2e-3) << i;
  }
}

TEST(Motion, RigidMotionGoesFromBeginToEnd) {
  const Transform begin = moved(Vec3(1, 2, 3), 0.4), end = moved(Vec3(-1, 0.5f, 2), 2.0);
  const RigidMotion motion(begin, end);
  const Vec3 p(0.3f, -0.7f, 1.1f);
  EXPECT_NEAR(length(motion.at(0).point(begin.point(p)) - begin.point(p)), 0, 1e-5);
  EXPECT_NEAR(length(motion.at(1).point(begin.point(p)) - end.point(p)), 0, 1e-5);
  const Vec3 half = motion.at(0.5f).point(begin.point(p));
  const Transform middle = moved(Vec3(0, 1.25f, 2.5f), 1.2);
  EXPECT_NEAR(length(half - middle.point(p)), 0, 1e-5);
  EXPECT_NEAR(length(motion.at(0.3f).back_point(motion.at(0.3f).point(p)) - p), 0, 1e-5);
}

struct Item {
  std::string name;
  bool instance, camera, lens;
};

class TransportMotion : public testing::TestWithParam<Item> {};

// By all techniques, and by plans whose samples share their time.
TEST_P(TransportMotion, AllTechniquesGiveOnePicture) {
  const Item& item = GetParam();
  scenes::Builder b = scenes::room({.points = true});
  b.add_sphere(Vec3(-0.3f, -0.2f, 0.1f), 0.25f, scenes::conductor(0.4f, 0.4f));
  if (item.instance) b.moving(moved(Vec3(0.5f, 0.1f, 0)));
  b.add(scenes::ball(Vec3(0.3f, -0.7f, 0.3f), 0.25f, 4, true), scenes::diffuse(Rgb(0.8f, 0.4f, 0.2f)));
  if (item.instance) b.moving(moved(Vec3(-0.2f, 0.3f, 0), 0.3));
  const ScenePointer scene = b.build();
  CameraDesc desc =
      scenes::camera_desc(item.lens ? scenes::room_view_through_lens() : scenes::room_view(), kSize, kSize);
  if (item.camera) desc.moves = true, desc.end = times(moved(Vec3(-0.1f, 0.05f, -0.1f), 0.1), desc.transform);
  const SensorPointer camera = make_camera(desc);
  std::vector<TechniqueSet> sets = technique_sets(8);
  sets.push_back({"pooled", [](int, int) { return true; }, 32, find_plan("pooled")});
  expect_one_picture(scene, camera, sets);
}

INSTANTIATE_TEST_SUITE_P(Items, TransportMotion,
                         testing::Values(Item{"instances", true, false, false}, Item{"camera", false, true, false},
                                         Item{"lens", true, true, true}),
                         [](const auto& info) { return info.param.name; });

}  // namespace bdpt::transport_motion_test
