// Ids, and what the builder refuses.
#include "api_scene.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace bdpt_api {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

#define EXPECT_ID(call) EXPECT_EQ(BDPT_ERROR_INVALID_ID, (call)) << #call << ": " << bdpt_last_error()
#define EXPECT_IN_USE(call) EXPECT_EQ(BDPT_ERROR_IN_USE, (call)) << #call << ": " << bdpt_last_error()

bdpt_texture_desc texture_desc(const void* pixels, uint32_t width = 1, uint32_t height = 1) {
  bdpt_texture_desc desc = make<bdpt_texture_desc>();
  desc.channels = 3;
  desc.pixels = pixels;
  desc.width = width;
  desc.height = height;
  return desc;
}

bdpt_texture_id add_texture(bdpt_builder* builder) {
  const uint8_t texel[3] = {10, 20, 30};
  const bdpt_texture_desc desc = texture_desc(texel);
  bdpt_texture_id texture{};
  EXPECT_OK(bdpt_texture_add(builder, &desc, &texture));
  return texture;
}

bdpt_light_id add_point(bdpt_builder* builder) {
  bdpt_light_desc desc = make<bdpt_light_desc>();
  for (float& v : desc.intensity) v = 1;
  bdpt_light_id light{};
  EXPECT_OK(bdpt_light_add(builder, &desc, &light));
  return light;
}

class ApiBuilder : public testing::Test {
 protected:
  Context context_ = make_context();
  Builder owner_ = make_builder(context_.get());
  bdpt_builder* b_ = owner_.get();

  bdpt_result try_material(const std::function<void(bdpt_material_desc&)>& change) {
    bdpt_material_desc desc = grey_desc();
    change(desc);
    bdpt_material_id id{7};
    const bdpt_result result = bdpt_material_add(b_, &desc, &id);
    EXPECT_EQ(result == BDPT_OK, id.id != 0);
    return result;
  }
  bdpt_result try_light(const std::function<void(bdpt_light_desc&)>& change) {
    bdpt_light_desc desc = make<bdpt_light_desc>();
    desc.type = BDPT_LIGHT_SPOT;
    desc.direction[2] = 5;
    desc.intensity[0] = 1;
    desc.cone_angle = 30;
    desc.cone_falloff = 10;
    change(desc);
    bdpt_light_id id{7};
    const bdpt_result result = bdpt_light_add(b_, &desc, &id);
    EXPECT_EQ(result == BDPT_OK, id.id != 0);
    return result;
  }
  bdpt_result try_texture(const std::function<void(bdpt_texture_desc&)>& change) {
    static const float pixels[64] = {};
    bdpt_texture_desc desc = texture_desc(pixels, 2, 2);
    change(desc);
    bdpt_texture_id id{7};
    const bdpt_result result = bdpt_texture_add(b_, &desc, &id);
    EXPECT_EQ(result == BDPT_OK, id.id != 0);
    return result;
  }
};

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

TEST_F(ApiBuilder, MaterialsAreChecked) {
  EXPECT_OK(try_material([](bdpt_material_desc&) {}));
  EXPECT_OK(try_material([](bdpt_material_desc& d) { d.type = BDPT_MATERIAL_DIELECTRIC; }));
  const auto refused = [&](const std::function<void(bdpt_material_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_material(change)) << bdpt_last_error();
  };
  refused([](auto& d) { d.type = 12; });
  refused([](auto& d) { d.type = -1; });
  refused([](auto& d) { d.reflectance[1] = 1.01f; });
  refused([](auto& d) { d.reflectance[2] = -0.1f; });
  refused([](auto& d) { d.reflectance[0] = kNan; });
  refused([](auto& d) { d.one_sided = 2; });
  refused([](auto& d) { d.type = BDPT_MATERIAL_DIELECTRIC, d.one_sided = 1; });
  refused([](auto& d) { d.eta[0] = -1; });
  refused([](auto& d) { d.k[0] = kInfinity; });
  refused([](auto& d) { d.type = BDPT_MATERIAL_CONDUCTOR, d.eta[0] = d.eta[1] = 1; });
  refused([](auto& d) { d.ior = 0.05f; });
  refused([](auto& d) { d.ior = -1.5f; });
  refused([](auto& d) { d.ior = 11; });
  refused([](auto& d) { d.type = BDPT_MATERIAL_DIELECTRIC, d.roughness[0] = 0.5f; });
  refused([](auto& d) { d.type = BDPT_MATERIAL_DIELECTRIC, d.roughness[1] = 0.5f; });
  refused([](auto& d) { d.roughness[0] = d.roughness[1] = 1.5f; });
  refused([](auto& d) { d.emission[0] = -1; });
  refused([](auto& d) { d.emission[0] = kInfinity; });
  refused([](auto& d) { d.emission_two_sided = 7; });
  refused([](auto& d) { d.emission_group = 64; });
  const bdpt_texture_id texture = add_texture(b_);
  refused([&](auto& d) { d.type = BDPT_MATERIAL_DIELECTRIC, d.reflectance_texture = texture; });
}

TEST_F(ApiBuilder, NumbersOfLayeredMaterialsAreChecked) {
  const auto refused = [&](const char* word, const std::function<void(bdpt_material_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_material(change)) << word;
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), word)) << bdpt_last_error();
  };
  for (int32_t type : {BDPT_MATERIAL_DIFFUSE_TRANSMISSION, BDPT_MATERIAL_COATED_DIFFUSE, BDPT_MATERIAL_PRINCIPLED,
                       BDPT_MATERIAL_BRUSHED})
    EXPECT_OK(try_material([&](auto& d) { d.type = type; })) << type;
  const std::pair<const char*, float bdpt_material_desc::*> numbers[] = {
      {"diffuse_roughness", &bdpt_material_desc::diffuse_roughness},
      {"coat", &bdpt_material_desc::coat},
      {"coat_roughness", &bdpt_material_desc::coat_roughness},
      {"metalness", &bdpt_material_desc::metalness},
      {"sheen_roughness", &bdpt_material_desc::sheen_roughness},
      {"transmission", &bdpt_material_desc::transmission},
      {"diffuse_transmission", &bdpt_material_desc::diffuse_transmission},
      {"anisotropy", &bdpt_material_desc::anisotropy},
      {"mix", &bdpt_material_desc::mix},
      {"specular", &bdpt_material_desc::specular}};
  for (const auto& [name, number] : numbers)
    for (float bad : {-0.5f, 1.5f, kNan})
      refused(name, [&](auto& d) { d.type = BDPT_MATERIAL_PRINCIPLED, d.*number = bad; });
  refused("transmittance", [](auto& d) { d.transmittance[1] = 2; });
  refused("specular_color", [](auto& d) { d.specular_color[0] = -1; });
  refused("sheen_color", [](auto& d) { d.sheen_color[2] = 1.5f; });
  refused("coat_ior", [](auto& d) { d.coat_ior = 0.9f; });
  refused("anisotropy_rotation", [](auto& d) { d.anisotropy_rotation = kInfinity; });
  refused("thin_walled", [](auto& d) { d.thin_walled = 2; });
  refused("single_scattering", [](auto& d) { d.single_scattering = 2; });
  refused("reserved_2", [](auto& d) { d.reserved_2 = 1; });
  refused("ior", [](auto& d) { d.type = BDPT_MATERIAL_COATED_DIFFUSE, d.ior = 0.9f; });
  refused("roughness", [](auto& d) { d.type = BDPT_MATERIAL_PRINCIPLED, d.roughness[0] = 0.5f; });
  refused("eta and k", [](auto& d) { d.type = BDPT_MATERIAL_COATED_CONDUCTOR; });
  refused("transmittance", [](auto& d) {
    d.type = BDPT_MATERIAL_DIFFUSE_TRANSMISSION, d.reflectance[0] = 0.6f, d.transmittance[0] = 0.5f;
  });
  refused("thin_walled",
          [](auto& d) { d.type = BDPT_MATERIAL_PRINCIPLED, d.transmission = d.diffuse_transmission = 0.5f; });
  EXPECT_OK(try_material([](auto& d) {
    d.type = BDPT_MATERIAL_PRINCIPLED, d.transmission = d.diffuse_transmission = 0.5f, d.thin_walled = 1;
  }));
  EXPECT_OK(try_material([](auto& d) { d.type = BDPT_MATERIAL_PRINCIPLED, d.specular = -1; }));
  for (int32_t type : {BDPT_MATERIAL_DIFFUSE_TRANSMISSION, BDPT_MATERIAL_PRINCIPLED})
    refused("one_sided", [&](auto& d) { d.type = type, d.one_sided = 1, d.diffuse_transmission = 0.5f; });
}

TEST_F(ApiBuilder, AMixIsMadeOfTwoThatAreNone) {
  const auto mix_of = [&](bdpt_material_id a, bdpt_material_id b, bdpt_material_id* id) {
    bdpt_material_desc desc = make<bdpt_material_desc>();
    desc.type = BDPT_MATERIAL_MIX;
    desc.parts[0] = a, desc.parts[1] = b;
    desc.mix = 0.5f;
    return bdpt_material_add(b_, &desc, id);
  };
  const bdpt_material_id grey = add_grey(b_), other = add_grey(b_);
  bdpt_material_id mix{}, none{};
  ASSERT_OK(mix_of(grey, other, &mix));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, mix_of(grey, mix, &none)) << bdpt_last_error();
  EXPECT_ID(mix_of(grey, {0}, &none));
  bdpt_material_desc emitter = grey_desc();
  emitter.emission[0] = 1;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_material_update(b_, grey, &emitter)) << bdpt_last_error();
  bdpt_material_desc itself = make<bdpt_material_desc>();
  itself.type = BDPT_MATERIAL_MIX;
  itself.parts[0] = itself.parts[1] = mix;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_material_update(b_, mix, &itself)) << bdpt_last_error();
  EXPECT_IN_USE(bdpt_material_remove(b_, grey));
  const bdpt_material_desc desc = grey_desc();
  EXPECT_OK(bdpt_material_update(b_, mix, &desc));
  EXPECT_OK(bdpt_material_remove(b_, grey));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_material([&](auto& d) { d.parts[1] = other; }));
}

// All it reflects, evenly; what breaks the contract is counted, and is not in the picture.
TEST_F(ApiBuilder, AHostsMaterialIsHeldToItsContract) {
  struct State {
    float f = 0.5f / float(M_PI);
    int32_t result = 0;
    float length = 1;
  } state;
  bdpt_host_material host = make<bdpt_host_material>();
  host.user = &state;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_material([&](auto& d) { d.type = BDPT_MATERIAL_HOST; }));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_material([&](auto& d) { d.type = BDPT_MATERIAL_HOST, d.host = &host; }));
  host.evaluate = [](void* user, const bdpt_scattering_place* place, const float next[3], bdpt_scattering_value* v) {
    const State& s = *static_cast<const State*>(user);
    v->f[0] = v->f[1] = v->f[2] = s.f;
    v->density = std::fabs(next[2]) / float(M_PI);
    v->density_reverse = std::fabs(place->previous[2]) / float(M_PI);
    return s.result;
  };
  host.sample = [](void* user, const bdpt_scattering_place* place, const float u[3], float next[3]) {
    const State& s = *static_cast<const State*>(user);
    const float r = s.length * std::sqrt(u[0]), phi = float(2 * M_PI) * u[1];
    next[0] = r * std::cos(phi), next[1] = r * std::sin(phi);
    next[2] = s.length * std::copysign(std::sqrt(1 - u[0]), place->previous[2]);
    return int32_t(0);
  };
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_material([&](auto& d) { d.host = &host; }));
  const Contents contents(b_);
  bdpt_material_desc desc = make<bdpt_material_desc>();
  desc.type = BDPT_MATERIAL_HOST;
  desc.host = &host;
  ASSERT_OK(bdpt_material_update(b_, contents.grey, &desc));
  const Scene scene = build(b_);
  const auto rejected = [&] {
    const Sensor sensor = make_camera(context_.get());
    const Film film = make_film(sensor.get());
    const Render render = make_render(scene.get(), sensor.get(), film.get());
    bdpt_advance_desc advance = passes(2);
    EXPECT_OK(bdpt_render_advance(render.get(), &advance, nullptr));
    bdpt_film_info info = make<bdpt_film_info>();
    EXPECT_OK(bdpt_film_get_info(film.get(), &info));
    return info.rejected;
  };
  EXPECT_EQ(0u, rejected());
  state.result = 3;
  EXPECT_GT(rejected(), 0u);
  state = {}, state.f = -1;
  EXPECT_GT(rejected(), 0u);
  state = {}, state.f = kNan;
  EXPECT_GT(rejected(), 0u);
  state = {}, state.length = 1.5f;
  EXPECT_GT(rejected(), 0u);
}

TEST_F(ApiBuilder, MeasuredMetalsAreFoundByName) {
  float eta[3], k[3];
  // Gold absorbs blue: reflectances at normal incidence fall from red to blue.
  ASSERT_OK(bdpt_metal_find("Au", eta, k));
  const auto reflectance = [&](int i) {
    return ((eta[i] - 1) * (eta[i] - 1) + k[i] * k[i]) / ((eta[i] + 1) * (eta[i] + 1) + k[i] * k[i]);
  };
  EXPECT_GT(reflectance(0), 0.9f);
  EXPECT_LT(reflectance(2), 0.5f);
  for (const char* name : {"Ag", "Al"}) {
    ASSERT_OK(bdpt_metal_find(name, eta, k));
    for (int i = 0; i < 3; ++i) EXPECT_GT(reflectance(i), 0.85f) << name;
  }
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_metal_find("Xx", eta, k));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "Cu")) << bdpt_last_error();
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

TEST_F(ApiBuilder, TexturesAreChecked) {
  EXPECT_OK(try_texture([](bdpt_texture_desc&) {}));
  const auto refused = [&](const std::function<void(bdpt_texture_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_texture(change)) << bdpt_last_error();
  };
  refused([](auto& d) { d.channels = 0; });
  refused([](auto& d) { d.channels = 5; });
  refused([](auto& d) { d.width = 0; });
  refused([](auto& d) { d.height = 65537; });
  refused([](auto& d) { d.pixels = nullptr; });
  refused([](auto& d) { d.texel = 4; });
  refused([](auto& d) { d.encoding = 2; });
  refused([](auto& d) { d.row_stride = 5; });
  refused([](auto& d) { d.row_stride = ~uint64_t(0); });
  refused([](auto& d) { d.texel = BDPT_TEXEL_FLOAT, d.row_stride = 26; });
  refused([](auto& d) { d.texel = BDPT_TEXEL_FLOAT, d.pixels = static_cast<const char*>(d.pixels) + 1; });
  for (const float bad : {kNan, kInfinity, -0.5f}) {
    const float pixels[12] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, bad};
    refused([&](auto& d) { d.texel = BDPT_TEXEL_FLOAT, d.pixels = pixels; });
  }
}

TEST_F(ApiBuilder, TextureRowsAreReadToTheLastTexelOnly) {
  // Two rows of one RGBA texel, 12 bytes apart.
  const auto pixels = std::make_unique<uint8_t[]>(12 + 4);
  EXPECT_OK(try_texture([&](bdpt_texture_desc& d) {
    d.channels = 4, d.width = 1, d.height = 2, d.pixels = pixels.get(), d.row_stride = 12;
  }));
}

TEST_F(ApiBuilder, ATextureThatReflectsMoreThanAllIsNoReflectance) {
  const float pixels[3] = {0, 1.5f, 0};
  bdpt_texture_desc desc = texture_desc(pixels);
  desc.texel = BDPT_TEXEL_FLOAT;
  desc.encoding = BDPT_ENCODING_LINEAR;
  bdpt_texture_id texture{};
  ASSERT_OK(bdpt_texture_add(b_, &desc, &texture));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_material([&](bdpt_material_desc& d) { d.reflectance_texture = texture; }));
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

}  // namespace
}  // namespace bdpt_api
