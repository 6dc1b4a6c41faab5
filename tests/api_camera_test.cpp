// Cameras: what is refused, and what a transform means.
#include "api_scene.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace bdpt_api::api_camera_test {

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

const bdpt_lens_surface kSinglet[2] = {{25.85f, 6, 1.517f, 24}, {0, 47, 0, 24}};

void set_lens(bdpt_camera_desc& d) {
  d.type = BDPT_CAMERA_LENS;
  d.lens_surface_count = 2;
  d.lens_surfaces = kSinglet;
}

TEST_F(ApiCamera, EveryTypeIsTaken) {
  EXPECT_OK(try_camera([](auto& d) { d.type = BDPT_CAMERA_ORTHOGRAPHIC, d.field_height = 3, d.shift[0] = 0.1f; }));
  EXPECT_OK(try_camera([](auto& d) { d.type = BDPT_CAMERA_EQUIDISTANT, d.shift[0] = 0.1f; }));
  EXPECT_OK(try_camera([](auto& d) { d.type = BDPT_CAMERA_EQUISOLID, d.field_of_view = 360; }));
  EXPECT_OK(try_camera([](auto& d) { d.type = BDPT_CAMERA_EQUIRECTANGULAR; }));
  EXPECT_OK(try_camera([](auto& d) { d.type = BDPT_CAMERA_CUBE, d.width = 6 * d.height; }));
  EXPECT_OK(try_camera([](auto& d) { d.type = BDPT_CAMERA_CUBE, d.height = 6 * d.width; }));
  EXPECT_OK(try_camera(set_lens));
  EXPECT_OK(try_camera([](auto& d) { set_lens(d), d.focus_distance = 2, d.film_height = 10, d.lens_unit = 0.01f; }));
  EXPECT_OK(try_camera([](auto& d) { set_lens(d), d.aperture_blades = 5, d.shift[1] = 0.2f; }));
  EXPECT_OK(try_camera(
      [](auto& d) { d.lens_radius = 0.1f, d.focus_distance = 2, d.focus_tilt[0] = 80, d.focus_tilt[1] = -20; }));
}

TEST_F(ApiCamera, FieldsOfOtherTypesAreRefused) {
  const auto refused = [&](bdpt_camera_type type, const char* field,
                           const std::function<void(bdpt_camera_desc&)>& change) {
    const auto all = [&](bdpt_camera_desc& d) {
      d.type = type;
      if (type == BDPT_CAMERA_ORTHOGRAPHIC) d.field_height = 3;
      if (type == BDPT_CAMERA_LENS) set_lens(d);
      change(d);
    };
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_camera(all)) << type << field;
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), field)) << bdpt_last_error();
  };
  for (const bdpt_camera_type type : {BDPT_CAMERA_ORTHOGRAPHIC, BDPT_CAMERA_EQUIRECTANGULAR, BDPT_CAMERA_LENS})
    refused(type, "field_of_view", [](auto& d) { d.field_of_view = 40; });
  for (const bdpt_camera_type type : {BDPT_CAMERA_ORTHOGRAPHIC, BDPT_CAMERA_EQUIDISTANT, BDPT_CAMERA_EQUIRECTANGULAR}) {
    refused(type, "lens_radius", [](auto& d) { d.lens_radius = 1; });
    refused(type, "focus_distance", [](auto& d) { d.focus_distance = 1; });
    refused(type, "aperture_blades", [](auto& d) { d.aperture_blades = 5; });
    refused(type, "aperture_rotation", [](auto& d) { d.aperture_rotation = 5; });
    refused(type, "focus_tilt", [](auto& d) { d.focus_tilt[1] = 5; });
    refused(type, "film_height", [](auto& d) { d.film_height = 5; });
    refused(type, "lens_unit", [](auto& d) { d.lens_unit = 5; });
    refused(type, "lens_surface_count", [](auto& d) { d.lens_surface_count = 1; });
    refused(type, "lens_surface_stride", [](auto& d) { d.lens_surface_stride = 16; });
    refused(type, "lens_surfaces", [](auto& d) { d.lens_surfaces = kSinglet; });
  }
  refused(BDPT_CAMERA_EQUIRECTANGULAR, "shift", [](auto& d) { d.shift[0] = 0.1f; });
  refused(BDPT_CAMERA_PERSPECTIVE, "field_height", [](auto& d) { d.field_height = 1; });
  refused(BDPT_CAMERA_LENS, "lens_radius", [](auto& d) { d.lens_radius = 1; });
}

TEST_F(ApiCamera, FieldsOfTheirOwnTypeAreChecked) {
  const auto refused = [&](const char* field, const std::function<void(bdpt_camera_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_camera(change)) << field;
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), field)) << bdpt_last_error();
  };
  refused("type", [](auto& d) { d.type = 7; });
  refused("type", [](auto& d) { d.type = -1; });
  refused("field_height", [](auto& d) { d.type = BDPT_CAMERA_ORTHOGRAPHIC; });
  refused("field_height", [](auto& d) { d.type = BDPT_CAMERA_ORTHOGRAPHIC, d.field_height = kNan; });
  refused("field_of_view", [](auto& d) { d.type = BDPT_CAMERA_EQUIDISTANT, d.field_of_view = 361; });
  refused("width", [](auto& d) { d.type = BDPT_CAMERA_CUBE; });
  refused("focus_tilt", [](auto& d) { d.focus_tilt[0] = 10; });
  refused("focus_tilt", [](auto& d) { d.lens_radius = 1, d.focus_distance = 2, d.focus_tilt[0] = 90; });
  refused("focus_tilt", [](auto& d) { d.lens_radius = 1, d.focus_distance = 2, d.focus_tilt[1] = 64; });
  refused("focus_tilt", [](auto& d) { d.lens_radius = 1, d.focus_distance = 2, d.focus_tilt[1] = kNan; });
  const auto lens = [&](const char* field, const std::function<void(bdpt_camera_desc&, bdpt_lens_surface*)>& change) {
    bdpt_lens_surface surfaces[2] = {kSinglet[0], kSinglet[1]};
    refused(field, [&](auto& d) {
      set_lens(d);
      d.lens_surfaces = surfaces;
      change(d, surfaces);
    });
  };
  lens("lens_surface_count", [](auto& d, auto*) { d.lens_surface_count = 0; });
  lens("lens_surface_count", [](auto& d, auto*) { d.lens_surface_count = 65; });
  lens("lens_surface_stride", [](auto& d, auto*) { d.lens_surface_stride = 12; });
  lens("lens_surfaces", [](auto& d, auto*) { d.lens_surfaces = nullptr; });
  lens("lens_surfaces[0].aperture", [](auto&, auto* s) { s[0].aperture = 0; });
  lens("lens_surfaces[0].aperture", [](auto&, auto* s) { s[0].aperture = 52; });
  lens("lens_surfaces[1].aperture", [](auto&, auto* s) { s[1].aperture = kNan; });
  lens("lens_surfaces[0].radius", [](auto&, auto* s) { s[0].radius = kNan; });
  lens("lens_surfaces[0].thickness", [](auto&, auto* s) { s[0].thickness = -1; });
  lens("lens_surfaces[0].ior", [](auto&, auto* s) { s[0].ior = 0.9f; });
  lens("lens_surfaces[0].ior", [](auto&, auto* s) { s[0].ior = kNan; });
  lens("lens_surfaces", [](auto&, auto* s) { s[1].ior = 1.3f; });
  lens("lens_surfaces", [](auto&, auto* s) { s[1].thickness = 0; });
  lens("focus_distance", [](auto& d, auto*) { d.focus_distance = 0.04f; });
  lens("focus_distance", [](auto& d, auto*) { d.focus_distance = -1; });
  lens("film_height", [](auto& d, auto*) { d.film_height = -1; });
  lens("lens_unit", [](auto& d, auto*) { d.lens_unit = kNan; });
  lens("lens_unit", [](auto& d, auto*) { d.lens_unit = 1e7f; });
  lens("film_height", [](auto& d, auto*) { d.film_height = 1e7f; });
  lens("lens_surfaces[0].thickness", [](auto&, auto* s) { s[0].thickness = 1e7f; });
}

TEST_F(ApiCamera, FacesOfACubeAreNotFiltered) {
  bdpt_camera_desc desc = camera_desc(24, 4);
  desc.type = BDPT_CAMERA_CUBE;
  const Sensor sensor = make_camera(context_.get(), desc);
  make_film(sensor.get());
  bdpt_film_desc film = make<bdpt_film_desc>();
  bdpt_film* none = nullptr;
  film.filter_radius = 1;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_create(sensor.get(), &film, &none));
  film.filter = BDPT_FILTER_GAUSSIAN, film.filter_radius = 0;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_create(sensor.get(), &film, &none));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "cube")) << bdpt_last_error();
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

}  // namespace bdpt_api::api_camera_test
