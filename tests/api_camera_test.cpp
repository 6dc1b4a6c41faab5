// Cameras: what is refused, and what a transform means.
#include "api_scene.h"

#include <cmath>
#include <functional>
#include <limits>

namespace bdpt_api {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class ApiCamera : public testing::Test {
 protected:
  Context context_ = make_context();

  bdpt_result try_camera(const std::function<void(bdpt_camera_desc&)>& change) {
    bdpt_camera_desc desc = camera_desc();
    change(desc);
    bdpt_sensor* sensor = nullptr;
    const bdpt_result result = bdpt_camera_create(context_.get(), &desc, &sensor);
    EXPECT_EQ(result == BDPT_OK, sensor != nullptr);
    bdpt_sensor_release(sensor);
    return result;
  }
};

TEST_F(ApiCamera, FieldsAreChecked) {
  const auto refused = [&](const std::function<void(bdpt_camera_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_camera(change)) << bdpt_last_error();
  };
  refused([](auto& d) { d.width = 0; });
  refused([](auto& d) { d.height = 65537; });
  refused([](auto& d) { d.crop[2] = 4; });
  refused([](auto& d) { d.crop[2] = 25, d.crop[3] = 16; });
  refused([](auto& d) { d.crop[0] = 3, d.crop[2] = 3, d.crop[3] = 16; });
  refused([](auto& d) { d.crop[0] = 5, d.crop[2] = 3, d.crop[3] = 16; });
  refused([](auto& d) { d.field_of_view = 180; });
  refused([](auto& d) { d.field_of_view = -1; });
  refused([](auto& d) { d.field_of_view = kNan; });
  refused([](auto& d) { d.lens_radius = -1; });
  refused([](auto& d) { d.lens_radius = 0.1f; });
  refused([](auto& d) { d.lens_radius = 0.1f, d.focus_distance = -1; });
  refused([](auto& d) { d.focus_distance = kNan; });
  refused([](auto& d) { d.aperture_blades = 2; });
  refused([](auto& d) { d.aperture_blades = 33; });
  refused([](auto& d) { d.aperture_rotation = kNan; });
  refused([](auto& d) { d.shift[1] = kNan; });
  refused([](auto& d) { d.transform[0] = kNan; });
  refused([](auto& d) { d.transform[0] = 0; });
  refused([](auto& d) { d.transform[0] = 1.01f; });
  refused([](auto& d) { d.transform[1] = 0.01f; });
}

TEST_F(ApiCamera, WhatIsAllowedIsTaken) {
  EXPECT_OK(try_camera([](auto& d) { std::memset(d.transform, 0, sizeof d.transform); }));
  EXPECT_OK(try_camera([](auto& d) { d.focus_distance = 3; }));
  EXPECT_OK(try_camera([](auto& d) { d.lens_radius = 0.1f, d.focus_distance = 3, d.aperture_blades = 6; }));
  EXPECT_OK(try_camera([](auto& d) { d.transform[0] = -1; }));
  EXPECT_OK(try_camera([](auto& d) { d.transform[0] = 1.0005f; }));
  EXPECT_OK(try_camera([](auto& d) { d.crop[0] = 23, d.crop[1] = 15, d.crop[2] = 24, d.crop[3] = 16; }));
}

std::vector<float> picture(const World& world, const bdpt_camera_desc& desc) {
  const Sensor sensor = make_camera(world.context.get(), desc);
  const Film film = make_film(sensor.get());
  const Render render = make_render(world.scene.get(), sensor.get(), film.get());
  EXPECT_OK(advance(render.get(), 4));
  return pixels_of(film.get());
}

TEST_F(ApiCamera, UniformScaleIsTakenOut) {
  const World world;
  bdpt_camera_desc scaled = camera_desc();
  for (const int i : {0, 5, 10}) scaled.transform[i] = 8;
  EXPECT_EQ(picture(world, camera_desc()), picture(world, scaled));
}

TEST_F(ApiCamera, AFocusDistanceMeansNothingToAPinhole) {
  const World world;
  bdpt_camera_desc focused = camera_desc();
  focused.focus_distance = 7;
  EXPECT_EQ(picture(world, camera_desc()), picture(world, focused));
}

TEST_F(ApiCamera, TheFilmHasTheSizeOfTheCropWindow) {
  bdpt_camera_desc desc = camera_desc();
  const uint32_t crop[4] = {3, 4, 10, 9};
  std::memcpy(desc.crop, crop, sizeof crop);
  const Sensor sensor = make_camera(context_.get(), desc);
  const Film film = make_film(sensor.get());
  EXPECT_EQ(7u, info_of(film.get()).width);
  EXPECT_EQ(5u, info_of(film.get()).height);
}

}  // namespace
}  // namespace bdpt_api
