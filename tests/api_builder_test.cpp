// Ids, and what the builder refuses.
#include "api_builder.h"

#include <cmath>

namespace bdpt_api::api_builder_test {

using ApiBuilder = BuilderTest;

TEST_F(ApiBuilder, StaleZeroAndForeignIdsAreRefused) {
  const Contents contents(b_);
  const Builder other = make_builder(context_.get());
  const Contents foreign(other.get());
  const bdpt_shape_id removed = add_square(b_);
  ASSERT_OK(bdpt_shape_remove(b_, removed));
  const bdpt_shape_id newer = add_square(b_);
  EXPECT_NE(removed.id, newer.id);
  for (const uint64_t bad : {uint64_t(0), removed.id, foreign.square.id, contents.grey.id, ~uint64_t(0)}) {
    EXPECT_ID(bdpt_shape_remove(b_, {bad}));
    const bdpt_instance_desc desc = instance_desc({bad}, contents.grey);
    bdpt_instance_id instance{7};
    EXPECT_ID(bdpt_instance_add(b_, &desc, &instance));
    EXPECT_EQ(0u, instance.id);
    EXPECT_ID(bdpt_instance_update(b_, contents.floor, &desc));
  }
  const bdpt_material_desc material = grey_desc();
  const bdpt_light_desc light = make<bdpt_light_desc>();
  const bdpt_instance_desc instance = instance_desc(contents.square, contents.grey);
  for (const uint64_t bad : {uint64_t(0), foreign.grey.id, contents.square.id}) {
    EXPECT_ID(bdpt_material_remove(b_, {bad}));
    EXPECT_ID(bdpt_material_update(b_, {bad}, &material));
    EXPECT_ID(bdpt_texture_remove(b_, {bad}));
    EXPECT_ID(bdpt_light_remove(b_, {bad}));
    EXPECT_ID(bdpt_light_update(b_, {bad}, &light));
    EXPECT_ID(bdpt_instance_remove(b_, {bad}));
    EXPECT_ID(bdpt_instance_update(b_, {bad}, &instance));
  }
  EXPECT_EQ(BDPT_ERROR_INVALID_ID, try_material([](bdpt_material_desc& d) { d.reflectance_texture.id = 99; }));
}

TEST_F(ApiBuilder, WhatIsUsedCannotBeRemoved) {
  const Contents contents(b_);
  const bdpt_texture_id texture = add_texture(b_);
  bdpt_material_desc textured = grey_desc();
  textured.reflectance_texture = texture;
  bdpt_material_id material{};
  ASSERT_OK(bdpt_material_add(b_, &textured, &material));
  EXPECT_IN_USE(bdpt_shape_remove(b_, contents.square));
  EXPECT_IN_USE(bdpt_material_remove(b_, contents.grey));
  EXPECT_IN_USE(bdpt_texture_remove(b_, texture));

  const bdpt_material_desc plain = grey_desc();
  ASSERT_OK(bdpt_material_update(b_, material, &plain));
  ASSERT_OK(bdpt_texture_remove(b_, texture));
  const bdpt_instance_desc move = instance_desc(contents.square, material);
  ASSERT_OK(bdpt_instance_update(b_, contents.thing, &move));
  ASSERT_OK(bdpt_shape_remove(b_, contents.ball));
  EXPECT_IN_USE(bdpt_material_remove(b_, material));
  ASSERT_OK(bdpt_instance_remove(b_, contents.thing));
  ASSERT_OK(bdpt_material_remove(b_, material));
  EXPECT_ID(bdpt_instance_remove(b_, contents.thing));
}

TEST_F(ApiBuilder, AFailedCallChangesNothing) {
  const Contents contents(b_);
  const bdpt_light_id light = add_point(b_);
  const uint64_t before = scene_hash(build(b_).get());

  bdpt_material_desc material = grey_desc();
  material.roughness[0] = 2;
  EXPECT_NE(BDPT_OK, bdpt_material_update(b_, contents.grey, &material));
  bdpt_light_desc point = make<bdpt_light_desc>();
  point.intensity[1] = -1;
  EXPECT_NE(BDPT_OK, bdpt_light_update(b_, light, &point));
  bdpt_instance_desc instance = instance_desc(contents.ball, contents.lamp, 0.1f);
  instance.transform[3] = kNan;
  EXPECT_NE(BDPT_OK, bdpt_instance_update(b_, contents.floor, &instance));
  instance.material.id = 0;
  EXPECT_NE(BDPT_OK, bdpt_instance_update(b_, contents.floor, &instance));
  EXPECT_NE(BDPT_OK, bdpt_shape_remove(b_, contents.square));
  EXPECT_NE(BDPT_OK, bdpt_material_remove(b_, contents.lamp));
  EXPECT_NE(BDPT_OK, try_material([](bdpt_material_desc& d) { d.type = 99; }));
  EXPECT_NE(BDPT_OK, try_light([](bdpt_light_desc& d) { d.type = 99; }));
  EXPECT_NE(BDPT_OK, try_texture([](bdpt_texture_desc& d) { d.channels = 5; }));
  EXPECT_NE(BDPT_OK, try_medium([](bdpt_medium_desc& d) { d.g = 1; }));

  EXPECT_EQ(before, scene_hash(build(b_).get()));
  // Nobody was left counted as a user, either.
  ASSERT_OK(bdpt_instance_remove(b_, contents.thing));
  EXPECT_OK(bdpt_shape_remove(b_, contents.ball));
}

TEST_F(ApiBuilder, TheSceneDependsOnWhatIsSeenOnly) {
  const Contents contents(b_);
  const uint64_t before = scene_hash(build(b_).get());
  add_texture(b_);
  add_square(b_);
  add_grey(b_, 1);
  EXPECT_EQ(before, scene_hash(build(b_).get()));
  const Builder other = make_builder(context_.get());
  add_sphere(other.get());
  const Contents same(other.get());
  EXPECT_EQ(before, scene_hash(build(other.get()).get()));
  ASSERT_OK(bdpt_instance_remove(b_, contents.thing));
  EXPECT_NE(before, scene_hash(build(b_).get()));
}

TEST_F(ApiBuilder, LightsAreChecked) {
  EXPECT_OK(try_light([](bdpt_light_desc&) {}));
  const auto refused = [&](const std::function<void(bdpt_light_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_light(change)) << bdpt_last_error();
  };
  refused([](auto& d) { d.type = 4; });
  refused([](auto& d) { d.direction[2] = 0; });
  refused([](auto& d) { d.direction[0] = kNan; });
  refused([](auto& d) { d.position[0] = kInfinity; });
  refused([](auto& d) { d.intensity[0] = -1; });
  refused([](auto& d) { d.radiance[0] = kNan; });
  refused([](auto& d) { d.cone_angle = 0; });
  refused([](auto& d) { d.cone_angle = 180; });
  refused([](auto& d) { d.cone_angle = kNan; });
  refused([](auto& d) { d.cone_falloff = 31; });
  refused([](auto& d) { d.cone_falloff = -1; });
}

TEST_F(ApiBuilder, SpheresAreChecked) {
  const auto try_sphere = [&](float radius, float x, uint32_t reserved) {
    bdpt_sphere_desc desc = make<bdpt_sphere_desc>();
    desc.radius = radius;
    desc.center[0] = x;
    desc.reserved = reserved;
    bdpt_shape_id shape{};
    return bdpt_sphere_add(b_, &desc, &shape);
  };
  EXPECT_OK(try_sphere(1, 0, 0));
  for (const float bad : {0.0f, -1.0f, kNan, kInfinity}) EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_sphere(bad, 0, 0));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_sphere(1, kNan, 0));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_sphere(1, 0, 1));
}

TEST_F(ApiBuilder, TransformsAreChecked) {
  const Contents contents(b_);
  const auto try_transform = [&](bdpt_shape_id shape, const std::vector<float>& m, uint32_t invisible = 0) {
    bdpt_instance_desc desc = instance_desc(shape, contents.grey);
    std::copy(m.begin(), m.end(), desc.transform);
    desc.invisible = invisible;
    bdpt_instance_id instance{7};
    const bdpt_result result = bdpt_instance_add(b_, &desc, &instance);
    EXPECT_EQ(result == BDPT_OK, instance.id != 0);
    return result;
  };
  const std::vector<float> zeros(12, 0), identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const std::vector<float> flat{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1e-6f, 0}, mirrored{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  for (const auto& good : {zeros, identity, mirrored}) {
    EXPECT_OK(try_transform(contents.square, good));
    EXPECT_OK(try_transform(contents.ball, good));
  }
  EXPECT_OK(try_transform(contents.square, flat));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_transform(contents.ball, flat));
  const std::vector<std::vector<float>> bad{
      {0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0},                 // a translation alone
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0},                 // a plane
      {1, 2, 3, 0, 2, 4, 6, 0, 1, 1, 1, 0},                 // dependent rows
      {1, 1, 0, 0, 1, 1.0000001f, 0, 0, 0, 0, 1, 0},        // all but dependent
      {kNan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},              //
      {1, 0, 0, kInfinity, 0, 1, 0, 0, 0, 0, 1, 0},         //
      {1e-40f, 0, 0, 0, 0, 1e-40f, 0, 0, 0, 0, 1e-40f, 0},  // its inverse is beyond a float
      {1e19f, 0, 0, 0, 0, 1e19f, 0, 0, 0, 0, 1e19f, 0},     // its coordinates are beyond the ray queries
      {1, 0, 0, 1e30f, 0, 1, 0, 0, 0, 0, 1, 0}};
  for (const auto& m : bad) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_transform(contents.square, m)) << m[0] << ' ' << m[3];
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_transform(contents.ball, m)) << m[0] << ' ' << m[3];
  }
  EXPECT_OK(try_transform(contents.square, identity, 1));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_transform(contents.square, identity, 2));
}

TEST_F(ApiBuilder, ASceneNeedsSomethingAndTakesSeveralEnvironments) {
  bdpt_scene* scene = nullptr;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_scene_build(b_, nullptr, &scene));
  const bdpt_light_id point = add_point(b_);
  EXPECT_NE(nullptr, build(b_));
  EXPECT_OK(bdpt_light_remove(b_, point));
  bdpt_light_desc sky = make<bdpt_light_desc>();
  sky.type = BDPT_LIGHT_ENVIRONMENT;
  bdpt_light_id light{};
  EXPECT_OK(bdpt_light_add(b_, &sky, &light));
  EXPECT_NE(nullptr, build(b_));
  EXPECT_OK(bdpt_light_add(b_, &sky, &light));
  EXPECT_NE(nullptr, build(b_));
}

TEST_F(ApiBuilder, ALampTooSmallToHaveAnAreaGivesAFinitePicture) {
  const bdpt_shape_id square = add_square(b_);
  add_instance(b_, square, add_grey(b_));
  add_instance(b_, square, add_grey(b_, 1), 1e-24f, 1, true);
  const Scene scene = build(b_);
  const Sensor sensor = make_camera(context_.get());
  const Film film = make_film(sensor.get());
  const Render render = make_render(scene.get(), sensor.get(), film.get());
  ASSERT_OK(advance(render.get(), 2));
  for (const float v : pixels_of(film.get())) ASSERT_TRUE(std::isfinite(v));
}

}  // namespace bdpt_api::api_builder_test
