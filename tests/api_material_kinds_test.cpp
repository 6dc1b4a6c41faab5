// The numbers of layered materials, mixes, materials of hosts, and measured metals.
#include "api_builder.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace bdpt_api::api_material_kinds_test {

class ApiMaterialKinds : public BuilderTest {};

TEST_F(ApiMaterialKinds, NumbersOfLayeredMaterialsAreChecked) {
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
      {"iridescence", &bdpt_material_desc::iridescence},
      {"specular", &bdpt_material_desc::specular}};
  for (const auto& [name, number] : numbers)
    for (float bad : {-0.5f, 1.5f, kNan})
      refused(name, [&](auto& d) { d.type = BDPT_MATERIAL_PRINCIPLED, d.*number = bad; });
  refused("transmittance", [](auto& d) { d.transmittance[1] = 2; });
  refused("specular_color", [](auto& d) { d.specular_color[0] = -1; });
  refused("sheen_color", [](auto& d) { d.sheen_color[2] = 1.5f; });
  refused("coat_ior", [](auto& d) { d.coat_ior = 0.9f; });
  for (float bad : {0.9f, 11.0f, kNan}) refused("iridescence_ior", [=](auto& d) { d.iridescence_ior = bad; });
  for (float bad : {-1.0f, 2e5f, kNan}) {
    refused("iridescence_thickness", [=](auto& d) { d.iridescence_thickness = bad; });
    refused("iridescence_thickness_minimum", [=](auto& d) { d.iridescence_thickness_minimum = bad; });
  }
  refused("iridescence_thickness_minimum",
          [](auto& d) { d.type = BDPT_MATERIAL_PRINCIPLED, d.iridescence = 1, d.iridescence_thickness_minimum = 100; });
  const auto bubble = [](bdpt_material_desc& d) {
    d.type = BDPT_MATERIAL_PRINCIPLED, d.iridescence = d.transmission = d.ior = 1;
  };
  refused("thin_walled", bubble);
  EXPECT_OK(try_material([&](auto& d) { bubble(d), d.thin_walled = 1; }));
  EXPECT_OK(try_material([&](auto& d) { bubble(d), d.ior = 1.3f; }));
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

TEST_F(ApiMaterialKinds, AMixIsMadeOfTwoThatAreNone) {
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

bdpt_host_material make_black_host(int* dropped) {
  bdpt_host_material host = make<bdpt_host_material>();
  host.user = dropped;
  host.evaluate = [](void*, const bdpt_scattering_place*, const float*, bdpt_scattering_value*) { return int32_t(0); };
  host.sample = [](void*, const bdpt_scattering_place*, const float*, float*) { return int32_t(0); };
  host.drop = [](void* user) { ++*static_cast<int*>(user); };
  return host;
}

TEST_F(ApiMaterialKinds, AHostsMaterialIsDroppedOnceByWhoeverHasItLast) {
  int dropped = 0, refused = 0;
  const Contents contents(b_);
  bdpt_host_material host = make_black_host(&dropped);
  bdpt_material_desc desc = make<bdpt_material_desc>();
  desc.type = BDPT_MATERIAL_HOST;
  desc.host = &host;
  ASSERT_OK(bdpt_material_update(b_, contents.grey, &desc));
  Scene scene = build(b_);
  const bdpt_material_desc grey = grey_desc();
  ASSERT_OK(bdpt_material_update(b_, contents.grey, &grey));
  EXPECT_EQ(0, dropped) << "the scene has it";
  scene.reset();
  EXPECT_EQ(1, dropped);

  ASSERT_OK(bdpt_material_update(b_, contents.grey, &desc));
  ASSERT_OK(bdpt_material_update(b_, contents.grey, &desc));
  EXPECT_EQ(2, dropped) << "one description, given twice, is two materials";
  bdpt_host_material bad = make_black_host(&refused);
  bad.sample = nullptr;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_material([&](auto& d) { d.type = BDPT_MATERIAL_HOST, d.host = &bad; }));
  EXPECT_EQ(1, refused);
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_material([&](auto& d) { d.host = &bad; })) << "of another type";
  EXPECT_EQ(2, refused);
  desc.host = &bad;
  EXPECT_EQ(BDPT_ERROR_INVALID_ID, bdpt_material_update(b_, {12345}, &desc));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_material_update(nullptr, contents.grey, &desc));
  EXPECT_EQ(4, refused);
  bad.struct_size = 4;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_material_update(b_, contents.grey, &desc));
  EXPECT_EQ(4, refused) << "of a size that is no version's nothing is read";
}

TEST_F(ApiMaterialKinds, TheHashOfAHostsMaterialIsPartOfTheScenes) {
  const Contents contents(b_);
  int dropped = 0;
  bdpt_host_material host = make_black_host(&dropped);
  bdpt_material_desc desc = make<bdpt_material_desc>();
  desc.type = BDPT_MATERIAL_HOST;
  desc.host = &host;
  const auto hash = [&](uint64_t of_host) {
    host.hash = of_host;
    EXPECT_OK(bdpt_material_update(b_, contents.grey, &desc));
    bdpt_scene_info info = make<bdpt_scene_info>();
    EXPECT_OK(bdpt_scene_get_info(build(b_).get(), &info));
    return info.hash;
  };
  EXPECT_EQ(hash(1), hash(1));
  EXPECT_NE(hash(1), hash(2));
}

// All it reflects, evenly; what breaks the contract is counted, and is not in the picture.
TEST_F(ApiMaterialKinds, AHostsMaterialIsHeldToItsContract) {
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

TEST_F(ApiMaterialKinds, MeasuredMetalsAreFoundByName) {
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

}  // namespace bdpt_api::api_material_kinds_test
