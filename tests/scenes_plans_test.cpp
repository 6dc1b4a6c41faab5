// On the scenes of the experiments' table, too, every plan measures the same, with heuristics, roulettes, samplers and
// numbers in every pair.
#include "api/handles.h"
#include "plan_cover.h"
#include "scene_upload.h"
#include "scenes/scenes.h"
#include "stage.h"

namespace bdpt {
namespace {

using namespace cover;
namespace ex = bdpt_experiments;

// The longest paths that are compared: where a small lamp is seen through mirror or glass by way of a mirror or glass,
// or by chance alone, a few paths in millions carry the light, in every plan, and no error can be told from samples.
int edges_of(const std::string& scene) {
  if (scene == "spheres under a small lamp" || scene == "meshes under a small lamp" || scene == "egg room") return 3;
  if (scene == "bathroom" || scene == "door ajar") return 4;
  if (scene == "plates and lamps" || scene == "water caustic") return 2;
  return 6;
}

// A mirror shows a small lamp to one eye subpath in ten thousands: without them. Up to three edges all other paths are
// found by every plan.
TechniqueMask techniques_of(const std::string& scene) {
  const bool small = scene == "spheres under a small lamp" || scene == "meshes under a small lamp";
  return mask_of([=](int s, int) { return s > 0 || !small; });
}

std::vector<ex::NamedScene> table() {
  ex::Setting setting;
  setting.scenes = BDPT_SHARED_DIR "/scenes/bitterli";
  return ex::scenes_of_the_table(setting);
}

class ScenesPlans : public ::testing::TestWithParam<size_t> {};

TEST_P(ScenesPlans, AllMeasureTheSame) {
  const ex::NamedScene named = table()[GetParam()];
  ex::SceneDescription description;
  try {
    description = named.make();
  } catch (const ex::SceneMissing& missing) {
    GTEST_SKIP() << missing.what();
  }
  bdpt_tool::Diagnostics silent(false);
  const bdpt_tool::Context context = bdpt_tool::make_context(2, silent);
  const bdpt_tool::Scene scene = bdpt_tool::build_scene(context.get(), description);
  const bool square = description.film.width == description.film.height;
  const uint32_t width = square ? 64 : 80, height = square ? 64 : 48;  // in blocks of 16 x 16
  const bdpt_camera_desc camera = bdpt_tool::camera_desc(description, width, height, silent);
  const auto sensor = bdpt_tool::make<bdpt_tool::Sensor>("the camera", bdpt_camera_create, context.get(), &camera);
  expect_cover_agrees(scene->scene, sensor->sensor, edges_of(named.name), {.techniques = techniques_of(named.name)});
}

std::string name_of_case(const ::testing::TestParamInfo<size_t>& info) {
  std::string name = table()[info.param].name;
  std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
  return name;
}

INSTANTIATE_TEST_SUITE_P(Table, ScenesPlans, ::testing::Range(size_t{0}, table().size()), name_of_case);

}  // namespace
}  // namespace bdpt
