// Lights by the C ABI: what is refused and why, what holds a texture, and that light arrives.
#include "api_scene.h"

#include <cmath>
#include <functional>
#include <limits>

namespace bdpt_api::api_light_test {

constexpr float kVertical[] = {0, 45, 90}, kHorizontal[] = {0, 90};
constexpr float kIntensities[] = {1, 2, 3, 4, 5, 6};
constexpr float kSky[2 * 4 * 3] = {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3};

bdpt_photometry photometry() {
  bdpt_photometry p = make<bdpt_photometry>();
  p.vertical_count = 3, p.horizontal_count = 2;
  p.vertical_angles = kVertical, p.horizontal_angles = kHorizontal;
  p.intensities = kIntensities;
  return p;
}

class ApiLight : public testing::Test {
 protected:
  bdpt_texture_id add_sky() {
    bdpt_texture_desc desc = make<bdpt_texture_desc>();
    desc.channels = 3, desc.width = 4, desc.height = 2;
    desc.texel = BDPT_TEXEL_FLOAT, desc.encoding = BDPT_ENCODING_LINEAR;
    desc.pixels = kSky;
    bdpt_texture_id texture{};
    EXPECT_OK(bdpt_texture_add(builder_.get(), &desc, &texture));
    return texture;
  }
  bdpt_light_desc desc_of(bdpt_light_type type) {
    bdpt_light_desc desc = make<bdpt_light_desc>();
    desc.type = type;
    desc.label = "lamp";
    desc.position[1] = 1;
    desc.direction[1] = -2;
    for (float* v : {desc.intensity, desc.radiance, desc.irradiance}) std::fill(v, v + 3, 1.0f);
    desc.cone_angle = 40;
    return desc;
  }
  // What is said is about this field.
  void expect_refused(bdpt_light_desc desc, const char* field, const std::function<void(bdpt_light_desc&)>& spoil) {
    bdpt_light_id light{};
    EXPECT_OK(bdpt_light_add(builder_.get(), &desc, &light));
    spoil(desc);
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_light_add(builder_.get(), &desc, &light)) << field;
    EXPECT_EQ(0u, light.id);
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), field)) << bdpt_last_error();
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "\"lamp\"")) << bdpt_last_error();
  }

  Context context_ = make_context();
  Builder builder_ = make_builder(context_.get());
};

TEST_F(ApiLight, WhatMakesNoSenseIsRefusedByName) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), huge = 3e38f;
  const bdpt_light_desc sun = desc_of(BDPT_LIGHT_DIRECTIONAL), point = desc_of(BDPT_LIGHT_POINT);
  bdpt_light_desc sky = desc_of(BDPT_LIGHT_ENVIRONMENT), spot = desc_of(BDPT_LIGHT_SPOT);
  sky.texture = spot.texture = add_sky();
  expect_refused(sun, "direction", [](auto& d) { d.direction[1] = 0; });
  expect_refused(sun, "angular_radius", [](auto& d) { d.angular_radius = 81; });
  expect_refused(sun, "angular_radius", [](auto& d) { d.angular_radius = -1; });
  expect_refused(sun, "irradiance", [](auto& d) { d.irradiance[2] = -1; });
  expect_refused(sun, "irradiance", [&](auto& d) { d.irradiance[0] = nan; });
  expect_refused(sun, "texture", [&](auto& d) { d.texture = sky.texture; });
  expect_refused(point, "texture", [&](auto& d) { d.texture = sky.texture; });
  expect_refused(sky, "transform", [](auto& d) { d.transform[0] = 1; });
  expect_refused(sky, "transform", [](auto& d) { d.transform[0] = d.transform[5] = 1, d.transform[10] = 2; });
  expect_refused(sky, "radiance", [&](auto& d) { d.radiance[2] = huge; });
  expect_refused(spot, "intensity", [&](auto& d) { d.intensity[2] = huge; });
  expect_refused(spot, "cone_angle", [](auto& d) { d.cone_angle = 86; });
  expect_refused(spot, "up", [&](auto& d) { d.up[1] = nan; });
  expect_refused(point, "type", [](auto& d) { d.type = BDPT_LIGHT_DIRECTIONAL + 1; });
  sky.texture.id += 1;
  bdpt_light_id light{};
  EXPECT_EQ(BDPT_ERROR_INVALID_ID, bdpt_light_add(builder_.get(), &sky, &light));
}

TEST_F(ApiLight, TablesOfIntensitiesMustBeWhole) {
  const auto expect = [&](const char* field, const std::function<void(bdpt_photometry&)>& spoil) {
    bdpt_photometry good = photometry(), bad = good;
    spoil(bad);
    bdpt_light_desc desc = desc_of(BDPT_LIGHT_POINT);
    desc.photometry = &good;
    expect_refused(desc, field, [&](auto& d) { d.photometry = &bad; });
  };
  const float falling[] = {0, 90, 45}, far[] = {0, 100}, late[] = {10, 90}, dark[] = {1, 2, 3, 4, -5, 6};
  expect("vertical_count", [](auto& p) { p.vertical_count = 1; });
  expect("horizontal_count", [](auto& p) { p.horizontal_count = 5000; });
  expect("vertical_angles", [](auto& p) { p.vertical_angles = nullptr; });
  expect("vertical_angles", [&](auto& p) { p.vertical_angles = falling; });
  expect("horizontal_angles", [&](auto& p) { p.horizontal_angles = far; });
  expect("horizontal_angles", [&](auto& p) { p.horizontal_angles = late; });
  expect("intensities", [&](auto& p) { p.intensities = dark; });
  expect("reserved", [](auto& p) { p.reserved = 1; });
  bdpt_photometry p = photometry();
  bdpt_light_desc spot = desc_of(BDPT_LIGHT_SPOT);
  expect_refused(spot, "photometry", [&](auto& d) { d.photometry = &p; });
  bdpt_light_desc point = desc_of(BDPT_LIGHT_POINT);
  point.photometry = &p;
  expect_refused(point, "direction", [](auto& d) { d.direction[1] = 0; });
}

TEST_F(ApiLight, PortalsAreRectanglesOfLightsFromFarAway) {
  const bdpt_portal window = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  const auto expect = [&](const char* field, const std::function<void(bdpt_portal&)>& spoil) {
    bdpt_portal portals[] = {window, window};
    spoil(portals[1]);
    bdpt_light_desc desc = desc_of(BDPT_LIGHT_ENVIRONMENT);
    desc.portals = portals, desc.portal_count = 1;
    expect_refused(desc, field, [](auto& d) { d.portal_count = 2; });
  };
  expect("portals[1].corner", [](auto& p) { p.corner[2] = std::numeric_limits<float>::infinity(); });
  expect("portals[1].edge_u", [](auto& p) { p.edge_u[0] = std::numeric_limits<float>::quiet_NaN(); });
  expect("has at 1 an edge of length zero", [](auto& p) { p.edge_v[1] = 0; });
  expect("has at 1 edges at an angle of 45 degrees", [](auto& p) { p.edge_v[0] = 2; });
  for (bdpt_light_type type : {BDPT_LIGHT_POINT, BDPT_LIGHT_SPOT})
    expect_refused(desc_of(type), "portal_count", [&](auto& d) { d.portals = &window, d.portal_count = 1; });
  const std::vector<bdpt_portal> many(65, window);
  for (bdpt_light_type type : {BDPT_LIGHT_ENVIRONMENT, BDPT_LIGHT_DIRECTIONAL}) {
    bdpt_light_desc desc = desc_of(type);
    desc.portals = many.data(), desc.portal_count = 64;
    expect_refused(desc, "portal_count", [&](auto& d) { d.portal_count = 65; });
    expect_refused(desc, "portals", [&](auto& d) { d.portals = nullptr; });
    expect_refused(desc, "reserved_3", [&](auto& d) { d.reserved_3 = 1; });
  }
}

TEST_F(ApiLight, ATextureInUseStays) {
  const bdpt_texture_id sky = add_sky();
  bdpt_light_desc desc = desc_of(BDPT_LIGHT_ENVIRONMENT);
  desc.texture = sky;
  bdpt_light_id light{};
  ASSERT_OK(bdpt_light_add(builder_.get(), &desc, &light));
  EXPECT_EQ(BDPT_ERROR_IN_USE, bdpt_texture_remove(builder_.get(), sky));
  desc.texture.id = 0;
  ASSERT_OK(bdpt_light_update(builder_.get(), light, &desc));
  EXPECT_OK(bdpt_texture_remove(builder_.get(), sky));
  desc.texture = add_sky();
  ASSERT_OK(bdpt_light_update(builder_.get(), light, &desc));
  ASSERT_OK(bdpt_light_remove(builder_.get(), light));
  EXPECT_OK(bdpt_texture_remove(builder_.get(), desc.texture));
}

TEST_F(ApiLight, ASphereHasNoCoordinatesToShineBy) {
  bdpt_material_desc lamp = grey_desc();
  lamp.emission[0] = 1;
  bdpt_texture_use use = make<bdpt_texture_use>();
  use.slot = BDPT_SLOT_EMISSION;
  use.texture = add_sky();
  lamp.textures = &use, lamp.texture_count = 1;
  bdpt_material_id material{};
  ASSERT_OK(bdpt_material_add(builder_.get(), &lamp, &material));
  const bdpt_instance_desc desc = instance_desc(add_sphere(builder_.get()), material);
  bdpt_instance_id instance{};
  ASSERT_OK(bdpt_instance_add(builder_.get(), &desc, &instance));
  bdpt_scene* scene = nullptr;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_scene_build(builder_.get(), nullptr, &scene));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "EMISSION")) << bdpt_last_error();
}

// A floor under each kind alone: whatever makes the light, the film is not black, and each has a scene hash of its own.
TEST_F(ApiLight, EveryKindLightsAScene) {
  const bdpt_photometry measured = photometry();
  const bdpt_texture_id sky = add_sky();
  std::vector<bdpt_light_desc> descs;
  for (bdpt_light_type type = 0; type <= BDPT_LIGHT_DIRECTIONAL; ++type) descs.push_back(desc_of(type));
  descs.push_back(desc_of(BDPT_LIGHT_DIRECTIONAL)), descs.back().angular_radius = 1;
  descs.push_back(desc_of(BDPT_LIGHT_ENVIRONMENT)), descs.back().texture = sky;
  descs.push_back(desc_of(BDPT_LIGHT_SPOT)), descs.back().texture = sky;
  descs.push_back(desc_of(BDPT_LIGHT_POINT)), descs.back().photometry = &measured;
  const bdpt_portal portals[] = {{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}}, {{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}}};
  for (uint32_t count : {1, 2})
    descs.push_back(desc_of(BDPT_LIGHT_ENVIRONMENT)), descs.back().portals = portals, descs.back().portal_count = count;
  const bdpt_instance_desc floor = instance_desc(add_square(builder_.get()), add_grey(builder_.get()));
  bdpt_instance_id instance{};
  ASSERT_OK(bdpt_instance_add(builder_.get(), &floor, &instance));
  std::vector<uint64_t> hashes;
  for (const bdpt_light_desc& desc : descs) {
    bdpt_light_id light{};
    ASSERT_OK(bdpt_light_add(builder_.get(), &desc, &light));
    const Scene scene = build(builder_.get());
    for (uint64_t other : hashes) EXPECT_NE(other, scene_hash(scene.get()));
    hashes.push_back(scene_hash(scene.get()));
    const Sensor sensor = make_camera(context_.get());
    const Film film = make_film(sensor.get());
    const Render render = make_render(scene.get(), sensor.get(), film.get());
    ASSERT_OK(advance(render.get(), 2));
    float sum = 0;
    for (const float v : pixels_of(film.get())) sum += v;
    EXPECT_TRUE(std::isfinite(sum) && sum > 0) << hashes.size();
    ASSERT_OK(bdpt_light_remove(builder_.get(), light));
  }
}

}  // namespace bdpt_api::api_light_test
