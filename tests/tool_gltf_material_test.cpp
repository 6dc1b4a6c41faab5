// Materials of glTF: every value of the core and the extensions, and what the library makes of them.
//
// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <set>

#include "gltf_fixture.h"

namespace bdpt_tool::tool_gltf_material_test {

TEST_F(ToolGltf, MaterialsArePrincipledAndNothingOfTheCoreIsLost) {
  const SceneDescription scene = read_material(
      "\"name\":\"Wall\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.25,0.5,1,1],\"metallicFactor\":0}");
  const MaterialDescription material = lower(scene);
  EXPECT_EQ(scene.materials.at(0).type, BDPT_MATERIAL_PRINCIPLED);
  EXPECT_EQ(material.type, BDPT_MATERIAL_PRINCIPLED);
  EXPECT_EQ(material.label, "Wall");
  EXPECT_EQ(material.reflectance, (Rgb{.25f, .5f, 1}));
  EXPECT_TRUE(material.one_sided);
  EXPECT_EQ(diagnostics_.count(), 2u) << notes();  // of the camera and the light
}

TEST_F(ToolGltf, DoubleSidedMaterialsHaveTwoSidesAndEmitFromBoth) {
  const std::string text = "\"emissiveFactor\":[1,0.5,0],\"pbrMetallicRoughness\":{\"metallicFactor\":0}";
  const MaterialDescription one = read_material(text).materials.at(0);
  EXPECT_TRUE(one.one_sided);
  EXPECT_FALSE(one.emission_two_sided);
  const MaterialDescription two = read_material(text + ",\"doubleSided\":true").materials.at(0);
  EXPECT_FALSE(two.one_sided);
  EXPECT_TRUE(two.emission_two_sided);
  EXPECT_EQ(two.emission, (Rgb{1, .5f, 0}));
}

TEST_F(ToolGltf, EmissiveStrengthMultipliesEmission) {
  const SceneDescription scene = read_material(
      "\"emissiveFactor\":[1,0.5,0],\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":100}}");
  EXPECT_EQ(scene.materials.at(0).emission, (Rgb{100, 50, 0}));
}

TEST_F(ToolGltf, WithoutAMaterialAPrimitiveHasTheDefaultOneWhichIsARoughMetal) {
  const MaterialDescription material = lower(read_primitive(triangle()));
  EXPECT_EQ(material.type, BDPT_MATERIAL_PRINCIPLED);
  EXPECT_EQ(material.principled.metallic.factor, 1);
  EXPECT_EQ(material.principled.roughness.factor, 1);
}

TEST_F(ToolGltf, WhatTransmitsHasTwoSidesAndWhatIsOutsideOfTheLibrarysBoundsIsToldOf) {
  const std::string transmission = "\"KHR_materials_transmission\":{\"transmissionFactor\":0.5}";
  const MaterialDescription pane = lower(read_material("\"extensions\":{" + transmission + "}"));
  EXPECT_FALSE(pane.one_sided);
  EXPECT_EQ(pane.principled.thickness.factor, 0);
  buffer_ = GltfBuffer();
  const MaterialDescription odd = lower(read_material(
      "\"pbrMetallicRoughness\":{\"roughnessFactor\":0.01},\"extensions\":{" + transmission +
      ",\"KHR_materials_ior\":{\"ior\":0},\"KHR_materials_specular\":{\"specularColorFactor\":[0,1,2]}}"));
  EXPECT_EQ(odd.ior, 1.5f);
  EXPECT_EQ(odd.principled.roughness.factor, 0);
  EXPECT_GT(odd.principled.specular_color.factor[0], 0);  // three zeros would be the default
  EXPECT_EQ(odd.principled.specular_color.factor[2], 1);
  EXPECT_EQ(notes_with("an index of refraction outside [1, 10] becomes 1.5"), 1u) << notes();
  EXPECT_EQ(notes_with("a colour of gloss above 1 becomes 1"), 1u) << notes();
}

TEST_F(ToolGltf, MaterialsAreConvertedOnceAndOnlyWhenUsed) {
  const std::string attributes = triangle();
  const SceneDescription scene = read_nodes(
      "{\"mesh\":0}", "\"meshes\":[{\"primitives\":[{" + attributes + ",\"material\":1},{" + attributes +
                          ",\"material\":1}]}],\"materials\":[{\"name\":\"unused\",\"normalTexture\":{\"index\":0}},"
                          "{\"name\":\"used\"}],\"textures\":[{}]");
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].label, "used");
}

TEST_F(ToolGltfTexture, EveryValueOfEveryExtensionIsRead) {
  const auto use = [](const char* name) { return ",\"" + std::string(name) + "\":{\"index\":0,\"texCoord\":1}"; };
  const SceneDescription scene = read_textured(
      "\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25,\"normalTexture\":{\"index\":0,\"scale\":0.75},"
      "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.1,0.2,0.3,0.4],\"metallicFactor\":0.5,\"roughnessFactor\":0.6,"
      "\"metallicRoughnessTexture\":{\"index\":0}},\"extensions\":{"
      "\"KHR_materials_ior\":{\"ior\":1.25},\"KHR_materials_dispersion\":{\"dispersion\":0.125},"
      "\"KHR_materials_transmission\":{\"transmissionFactor\":0.3" +
          use("transmissionTexture") +
          "},"
          "\"KHR_materials_volume\":{\"thicknessFactor\":2,\"attenuationDistance\":3,\"attenuationColor\":[0.5,0.6,0."
          "7]" +
          use("thicknessTexture") +
          "},"
          "\"KHR_materials_clearcoat\":{\"clearcoatFactor\":0.8,\"clearcoatRoughnessFactor\":0.9,"
          "\"clearcoatNormalTexture\":{\"index\":0,\"scale\":2}" +
          use("clearcoatTexture") + use("clearcoatRoughnessTexture") +
          "},"
          "\"KHR_materials_sheen\":{\"sheenColorFactor\":[0.2,0.4,0.6],\"sheenRoughnessFactor\":0.35" +
          use("sheenColorTexture") + use("sheenRoughnessTexture") +
          "},"
          "\"KHR_materials_specular\":{\"specularFactor\":0.45,\"specularColorFactor\":[1,2,3]" +
          use("specularTexture") + use("specularColorTexture") +
          "},"
          "\"KHR_materials_iridescence\":{\"iridescenceFactor\":0.55,\"iridescenceIor\":1.75,"
          "\"iridescenceThicknessMinimum\":150,\"iridescenceThicknessMaximum\":450" +
          use("iridescenceTexture") + use("iridescenceThicknessTexture") +
          "},"
          "\"KHR_materials_anisotropy\":{\"anisotropyStrength\":0.65,\"anisotropyRotation\":1.5" +
          use("anisotropyTexture") + "}}",
      image_uri(png(kTwo)));
  const MaterialDescription& m = scene.materials.at(0);
  const PrincipledDescription& p = m.principled;
  EXPECT_EQ(m.alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(m.alpha_cutoff, 0.25f);
  EXPECT_EQ(m.alpha.factor, 0.4f);
  EXPECT_EQ(m.normal.factor, 0.75f);
  EXPECT_EQ(m.ior, 1.25f);
  EXPECT_EQ(p.dispersion, 0.125f);
  EXPECT_EQ(p.attenuation_distance, 3);
  EXPECT_EQ(p.attenuation_color, (Rgb{0.5f, 0.6f, 0.7f}));
  EXPECT_EQ(p.clearcoat_normal.factor, 2);
  EXPECT_EQ(p.iridescence_ior, 1.75f);
  EXPECT_EQ(p.iridescence_thickness_min, 150);
  EXPECT_EQ(p.anisotropy_rotation, 1.5f);
  struct Expected {
    const FloatValue& value;
    float factor;
    int channel;
    bool second_set;
  };
  const Expected numbers[] = {
      {p.metallic, 0.5f, 2, false},        {p.roughness, 0.6f, 1, false},
      {p.transmission, 0.3f, 0, true},     {p.thickness, 2, 1, true},
      {p.clearcoat, 0.8f, 0, true},        {p.clearcoat_roughness, 0.9f, 1, true},
      {p.sheen_roughness, 0.35f, 3, true}, {p.specular, 0.45f, 3, true},
      {p.iridescence, 0.55f, 0, true},     {p.iridescence_thickness, 450, 1, true},
      {p.anisotropy, 0.65f, 2, true},
  };
  for (const Expected& e : numbers) {
    const auto i = &e - numbers;
    EXPECT_EQ(e.value.factor, e.factor) << i;
    EXPECT_EQ(e.value.channel, e.channel) << i;
    EXPECT_EQ(e.value.texture.uv_set, int{e.second_set}) << i;
    ASSERT_GE(e.value.texture.texture, 0) << i;
  }
  EXPECT_EQ(p.specular_color.factor, (Rgb{1, 2, 3}));
  EXPECT_EQ(p.sheen_color.factor, (Rgb{0.2f, 0.4f, 0.6f}));
  // One image, once as colours and once as numbers.
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(scene.textures[static_cast<std::size_t>(p.sheen_color.texture.texture)].exponent, 0);
  EXPECT_EQ(scene.textures[static_cast<std::size_t>(p.roughness.texture.texture)].exponent, 1);
}

TEST_F(ToolGltf, UnlitMaterialsEmitTheirColourAndAreNotLit) {
  const SceneDescription scene = read_material(
      "\"extensions\":{\"KHR_materials_unlit\":{}},\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.25,0.5,1,1]}");
  EXPECT_EQ(lower(scene).emission, (Rgb{0.25f, 0.5f, 1}));
  EXPECT_EQ(lower(scene).reflectance, (Rgb{0, 0, 0}));
  EXPECT_TRUE(scene.lights.empty());  // there is nothing to be lit
}

TEST_F(ToolGltf, FilmsThatTheLibraryHasNotAreToldOf) {
  const std::string thick =
      "\"extensions\":{\"KHR_materials_iridescence\":{\"iridescenceFactor\":1,\"iridescenceIor\":12,"
      "\"iridescenceThicknessMaximum\":200000}}";
  const PrincipledDescription p = lower(read_material(thick)).principled;
  EXPECT_EQ(p.iridescence_ior, 10);
  EXPECT_EQ(p.iridescence_thickness.factor, 1e5f);
  const std::string bubble =
      "\"extensions\":{\"KHR_materials_iridescence\":{\"iridescenceFactor\":1},\"KHR_materials_ior\":{\"ior\":1},"
      "\"KHR_materials_transmission\":{\"transmissionFactor\":1}";
  EXPECT_EQ(lower(read_material(bubble + "}")).principled.iridescence.factor, 1);
  EXPECT_EQ(
      lower(read_material(bubble + ",\"KHR_materials_volume\":{\"thicknessFactor\":1}}")).principled.iridescence.factor,
      0);
  for (const char* note : {"films of an index above 10", "films thicker than", "iridescence of what does not refract"})
    EXPECT_EQ(notes_with(note), 1u) << note << " in\n" << notes();
}

// Each number and each texture changes what the library has.
TEST_F(ToolGltfTexture, EveryValueReachesTheLibrary) {
  const SceneDescription scene =
      read_textured("\"pbrMetallicRoughness\":{\"metallicFactor\":0.5,\"roughnessFactor\":0.5}", image_uri(png(kTwo)));
  const Context context = make_context(1, diagnostics_);
  std::set<std::uint64_t> hashes;
  const auto hash = [&](const std::function<void(MaterialDescription&, PrincipledDescription&)>& change) {
    SceneDescription copy = scene;
    copy.textures.assign(1, {.label = "t", .where = {}, .image = ByteImage{1, 1, 4, {1, 2, 3, 4}}, .exponent = 1});
    MaterialDescription& material = copy.materials.at(0);
    change(material, material.principled);
    const Scene built = build_scene(context.get(), copy);
    auto info = sized<bdpt_scene_info>();
    check(bdpt_scene_get_info(built.get(), &info), "the scene");
    return info.hash;
  };
  hashes.insert(hash([](MaterialDescription&, PrincipledDescription&) {}));
  std::size_t changes = 1;
  using P = PrincipledDescription;
  for (FloatValue P::*value :
       {&P::metallic, &P::roughness, &P::specular, &P::transmission, &P::clearcoat, &P::anisotropy, &P::iridescence}) {
    hashes.insert(hash([&](MaterialDescription&, P& p) { (p.*value).factor = 0.25f; }));
    hashes.insert(hash([&](MaterialDescription&, P& p) { (p.*value) = {0.25f, {.texture = 0}, (p.*value).channel}; }));
    changes += 2;
  }
  for (ColorValue P::*value : {&P::specular_color, &P::sheen_color}) {
    hashes.insert(hash([&](MaterialDescription&, P& p) { (p.*value).factor = {0.25f, 0.5f, 0.75f}; }));
    hashes.insert(hash([&](MaterialDescription&, P& p) { (p.*value) = {{0.25f, 0.5f, 0.75f}, {.texture = 0}}; }));
    changes += 2;
  }
  const std::function<void(MaterialDescription&, P&)> others[] = {
      [](MaterialDescription&, P& p) { p.clearcoat.factor = 1, p.clearcoat_roughness.factor = 0.5f; },
      [](MaterialDescription&, P& p) {
        p.clearcoat.factor = 1, p.clearcoat_roughness = {0.5f, {.texture = 0}, 1};
      },
      [](MaterialDescription&, P& p) {
        p.sheen_color.factor = {1, 1, 1}, p.sheen_roughness.factor = 0.5f;
      },
      [](MaterialDescription&, P& p) {
        p.sheen_color.factor = {1, 1, 1}, p.sheen_roughness = {0.5f, {.texture = 0}, 3};
      },
      [](MaterialDescription&, P& p) { p.anisotropy.factor = 1, p.anisotropy_rotation = 1; },
      [](MaterialDescription&, P& p) { p.transmission.factor = 1, p.thickness.factor = 1; },
      [](MaterialDescription&, P& p) {
        p.transmission.factor = p.thickness.factor = p.attenuation_distance = 1, p.attenuation_color = {0.5f, 1, 1};
      },
      [](MaterialDescription&, P& p) { p.iridescence.factor = 1; },
      [](MaterialDescription&, P& p) { p.iridescence.factor = 1, p.iridescence_ior = 2; },
      [](MaterialDescription&, P& p) { p.iridescence.factor = 1, p.iridescence_thickness.factor = 200; },
      [](MaterialDescription&, P& p) { p.iridescence.factor = 1, p.iridescence_thickness.factor = 0; },
      [](MaterialDescription&, P& p) { p.iridescence.factor = 1, p.iridescence_thickness.texture.texture = 0; },
      [](MaterialDescription&, P& p) {
        p.iridescence.factor = 1, p.iridescence_thickness.texture.texture = 0, p.iridescence_thickness_min = 300;
      },
      [](MaterialDescription& m, P&) { m.ior = 2; },
      [](MaterialDescription& m, P&) {
        m.emission = {1, 1, 1};
      },
      [](MaterialDescription& m, P&) {
        m.emission = {1, 1, 1}, m.emission_texture.texture = 0;
      },
  };
  for (const auto& change : others) hashes.insert(hash(change)), ++changes;
  EXPECT_EQ(hashes.size(), changes);
}

}  // namespace bdpt_tool::tool_gltf_material_test
