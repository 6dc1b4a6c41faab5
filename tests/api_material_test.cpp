// Materials: what is refused.
#include "api_builder.h"

namespace bdpt_api::api_material_test {

using ApiMaterial = BuilderTest;

TEST_F(ApiMaterial, EveryRefusalNamesFieldValueAndRemedy) {
  EXPECT_OK(try_material([](auto&) {}));
  EXPECT_OK(try_material([](auto& d) { d.type = BDPT_MATERIAL_DIELECTRIC; }));
  EXPECT_OK(try_material([](auto& d) { d.type = BDPT_MATERIAL_INTERFACE; }));
  const auto refused = [&](std::initializer_list<const char*> parts,
                           const std::function<void(bdpt_material_desc&)>& change) {
    expect_refused(try_material(change), parts);
    for (const char* part : {"bdpt_material_add", "material \"grey\""})
      EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), part)) << bdpt_last_error();
  };
  refused({"type", "is 1000", "none of the constants"}, [](auto& d) { d.type = 1000; });
  refused({"type", "is -1", "none of the constants"}, [](auto& d) { d.type = -1; });
  refused({"reflectance[1]", "is 1.01", "from 0 to 1"}, [](auto& d) { d.reflectance[1] = 1.01f; });
  refused({"reflectance[2]", "is -0.1", "from 0 to 1"}, [](auto& d) { d.reflectance[2] = -0.1f; });
  refused({"reflectance[0]", "nan", "from 0 to 1"}, [](auto& d) { d.reflectance[0] = kNan; });
  refused({"one_sided", "is 2", "0 or 1"}, [](auto& d) { d.one_sided = 2; });
  refused({"eta[0]", "is -1", "from 0 to 1e+06"}, [](auto& d) { d.eta[0] = -1; });
  refused({"eta[1]", "is 2e+06", "from 0 to 1e+06"}, [](auto& d) { d.eta[1] = 2e6f; });
  refused({"k[0]", "inf", "from 0 to 1e+06"}, [](auto& d) { d.k[0] = kInfinity; });
  refused({"k[2]", "is 3e+18", "from 0 to 1e+06"}, [](auto& d) { d.k[2] = 3e18f; });
  refused({"eta and k", "channel 2", "index of refraction"},
          [](auto& d) { d.type = BDPT_MATERIAL_CONDUCTOR, d.eta[0] = d.eta[1] = 1; });
  refused({"ior", "is 0.05", "from 0.1 to 10"}, [](auto& d) { d.ior = 0.05f; });
  refused({"ior", "is -1.5", "from 0.1 to 10"}, [](auto& d) { d.ior = -1.5f; });
  refused({"ior", "is 11", "from 0.1 to 10"}, [](auto& d) { d.ior = 11; });
  refused({"roughness[0]", "is 1.5", "from 0 to 1"}, [](auto& d) { d.roughness[0] = d.roughness[1] = 1.5f; });
  for (const int i : {0, 1})
    for (const bdpt_material_type type : {BDPT_MATERIAL_DIELECTRIC, BDPT_MATERIAL_CONDUCTOR})
      refused({"roughness", "0.5", "two zeros"}, [&](auto& d) { d.type = type, d.roughness[i] = 0.5f; });
  refused({"emission[0]", "is -1", "at least 0"}, [](auto& d) { d.emission[0] = -1; });
  refused({"emission[0]", "inf", "finite"}, [](auto& d) { d.emission[0] = kInfinity; });
  refused({"emission_two_sided", "is 7", "0 or 1"}, [](auto& d) { d.emission_two_sided = 7; });
  refused({"emission_group", "is 64", "from 0 to 63"}, [](auto& d) { d.emission_group = 64; });
  refused({"perceptual_roughness", "is 2", "0 or 1"}, [](auto& d) { d.perceptual_roughness = 2; });
  refused({"emission_exponent", "is -2", "from -1 to 10000"}, [](auto& d) { d.emission_exponent = -2; });
  refused({"emission_exponent", "nan", "from -1 to 10000"}, [](auto& d) { d.emission_exponent = kNan; });
}

TEST_F(ApiMaterial, OpacityIsChecked) {
  const auto refused = [&](std::initializer_list<const char*> parts,
                           const std::function<void(bdpt_material_desc&)>& change) {
    expect_refused(try_material(change), parts);
  };
  EXPECT_OK(try_material([](auto& d) { d.opacity_mode = BDPT_OPACITY_MASK, d.opacity = d.opacity_cutoff = 1; }));
  EXPECT_OK(try_material([](auto& d) { d.opacity_mode = BDPT_OPACITY_BLEND; }));
  for (bdpt_opacity_mode mode : {BDPT_OPACITY_MASK, BDPT_OPACITY_BLEND}) {
    refused({"opacity_mode", "bounds a medium", "no interior"},
            [&](auto& d) { d.type = BDPT_MATERIAL_INTERFACE, d.opacity_mode = mode; });
    refused({"opacity_mode", "bounds a medium", "no priority"},
            [&](auto& d) { d.type = BDPT_MATERIAL_DIELECTRIC, d.opacity_mode = mode, d.priority = 1; });
  }
  refused({"opacity_mode", "is 3", "0 to 2"}, [](auto& d) { d.opacity_mode = 3; });
  refused({"opacity of", "is 1.5", "from 0 to 1"}, [](auto& d) { d.opacity = 1.5f; });
  refused({"opacity of", "nan", "from 0 to 1"}, [](auto& d) { d.opacity = kNan; });
  refused({"opacity_cutoff", "is -1", "from 0 to 1"}, [](auto& d) { d.opacity_cutoff = -1; });
  for (const bdpt_opacity_mode mode : {BDPT_OPACITY_MASK, BDPT_OPACITY_BLEND})
    refused({"opacity_mode", "emits", "give it no emission"},
            [&](auto& d) { d.opacity_mode = mode, d.opacity = 1, d.emission[2] = 1; });
}

TEST_F(ApiMaterial, AnInteriorIsOfWhatLightPasses) {
  const bdpt_medium_id fog = add_medium(b_);
  const auto refused = [&](std::initializer_list<const char*> parts,
                           const std::function<void(bdpt_material_desc&)>& change) {
    expect_refused(try_material(change), parts);
  };
  for (const bdpt_material_type type : {BDPT_MATERIAL_DIELECTRIC, BDPT_MATERIAL_INTERFACE})
    EXPECT_OK(try_material([&](auto& d) { d.type = type, d.interior = fog, d.priority = ~0u; }));
  for (const bdpt_material_type type : {BDPT_MATERIAL_DIFFUSE, BDPT_MATERIAL_MIRROR}) {
    refused({"interior", "no light passes", "set it to zero"}, [&](auto& d) { d.type = type, d.interior = fog; });
    refused({"priority", "is 3", "no light passes", "set it to 0"}, [&](auto& d) { d.type = type, d.priority = 3; });
  }
  for (const bdpt_material_type type : {BDPT_MATERIAL_DIELECTRIC, BDPT_MATERIAL_INTERFACE})
    refused({"one_sided", "is 1", "passes through", "set it to 0"}, [&](auto& d) { d.type = type, d.one_sided = 1; });
  const bdpt_texture_id texture = add_texture(b_);
  for (const bdpt_material_type type : {BDPT_MATERIAL_DIELECTRIC, BDPT_MATERIAL_CONDUCTOR, BDPT_MATERIAL_INTERFACE})
    refused({"reflectance_texture", "set it to zero"},
            [&](auto& d) { d.type = type, d.reflectance_texture = texture; });
  refused({"emission", "interface", "set it to zero"},
          [](auto& d) { d.type = BDPT_MATERIAL_INTERFACE, d.emission[1] = 1; });
}

}  // namespace bdpt_api::api_material_test
