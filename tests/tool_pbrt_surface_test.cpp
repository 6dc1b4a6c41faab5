// pbrt's materials with pictures of roughness and of metals, and alpha of what emits.
//
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "lowering.h"
#include "tool_picture.h"

namespace bdpt_tool::tool_pbrt_surface_test {

class ToolPbrtSurface : public ToolPicture {
 protected:
  // "Texture" with the numbers of a row of texels.
  std::string numbers(const std::string& name, const std::vector<float>& texels, const std::string& more = "") {
    std::string pixels;
    for (const float x : texels)
      for (int c = 0; c < 3; ++c) pixels.append(reinterpret_cast<const char*>(&x), sizeof x);
    std::ofstream(folder_.file(name + ".pfm"), std::ios::binary) << "PF\n" << texels.size() << " 1\n-1\n" << pixels;
    return "Texture \"" + name + "\" \"float\" \"imagemap\" \"string filename\" \"" + name + ".pfm\" " + more + "\n";
  }
  SceneDescription read_world(const std::string& world) {
    return read("Camera \"perspective\" \"float fov\" 10", world);
  }
  const MaterialDescription& material(const SceneDescription& scene, std::size_t instance = 0) {
    return scene.materials.at(static_cast<std::size_t>(scene.instances.at(instance).material));
  }
  std::vector<float> texels(const SceneDescription& scene, const TextureUse& use) {
    const Image& image = std::get<Image>(scene.textures.at(static_cast<std::size_t>(use.texture)).image);
    std::vector<float> values;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) values.push_back(image.pixels[i]);
    return values;
  }
  MaterialDescription lower(const SceneDescription& scene) {
    Notes notes(scene.path, diagnostics_);
    MaterialDescription to = lowered(scene, material(scene), notes);
    notes.tell();
    return to;
  }
};

const std::string kWall =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-9 -9 4  9 -9 4  9 9 4  -9 9 4] "
    "\"point2 uv\" [0 0 1 0 1 1 0 1]\n";
// A lamp beside the camera, large enough to be met by what the wall reflects.
const std::string kLamp =
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nTranslate 2 1 -1\nShape \"sphere\" \"float "
    "radius\" "
    "0.8\nAttributeEnd\n";

TEST_F(ToolPbrtSurface, RoughnessOfAPictureIsFoldedIntoItsTexels) {
  const std::vector<float> values = {0.04f, 0.25f, 1e-8f, 1};
  SceneDescription scene =
      read_world(numbers("r", values) + "Material \"conductor\" \"texture roughness\" \"r\"\n" + kWall);
  EXPECT_EQ(texels(scene, material(scene).roughness_texture), (std::vector<float>{0.2f, 0.5f, 0, 1}));
  EXPECT_EQ(material(scene).roughness, (std::array<float, 2>{1, 1}));
  EXPECT_EQ(scene.textures.at(0).exponent, 1);  // no colours
  scene = read_world(numbers("r", values) +
                     "Texture \"half\" \"float\" \"scale\" \"texture tex\" \"r\" \"float scale\" 0.5\n"
                     "Material \"dielectric\" \"texture roughness\" \"half\" \"bool remaproughness\" false\n" +
                     kWall);
  EXPECT_EQ(texels(scene, material(scene).roughness_texture), (std::vector<float>{0.02f, 0.125f, 0, 0.5f}));
  scene = read_world(
      "Texture \"m\" \"float\" \"mix\" \"float tex1\" 0 \"float tex2\" 0.5\nMaterial \"conductor\" "
      "\"texture roughness\" \"m\"\n" +
      kWall);
  EXPECT_EQ(material(scene).roughness, (std::array<float, 2>{0.5f, 0.5f}));
  EXPECT_EQ(diagnostics_.count(), 0u);
  read_world(numbers("r", {2, 0}) + "Material \"conductor\" \"texture roughness\" \"r\"\n" + kWall);
  EXPECT_EQ(notes_with("scene.pbrt:3: texels of a roughness above 1 become 1"), 1u);
}

TEST_F(ToolPbrtSurface, APictureOfOneRoughnessIsThatRoughness) {
  max_edges_ = 3;
  const std::pair<const char*, const char*> kinds[] = {{"conductor", "roughness"},
                                                       {"dielectric", "roughness"},
                                                       {"coateddiffuse", "roughness"},
                                                       {"coatedconductor", "conductor.roughness"},
                                                       {"coatedconductor", "interface.roughness"}};
  for (const auto& [kind, parameter] : kinds) {
    const std::string type = "Material \"" + std::string(kind) + "\" ", name = parameter;
    const auto number = [&](const std::string& value) {
      return radiance(read_world(kLamp + type + "\"float " + name + "\" " + value + "\n" + kWall))[1];
    };
    const float pictured = radiance(
        read_world(kLamp + numbers("r", {0.09f, 0.09f}) + type + "\"texture " + name + "\" \"r\"\n" + kWall))[1];
    const float same = number("0.09"), other = number("0.3");
    EXPECT_GT(same, 0) << kind;
    EXPECT_NEAR(pictured, same, 1e-3f * same) << kind << " " << name;
    EXPECT_GT(std::abs(other - same), 0.02f * same) << kind << " " << name;
  }
  EXPECT_EQ(diagnostics_.count(), 0u);
}

TEST_F(ToolPbrtSurface, OnePictureServesBothAxesAndOthersGiveTheirMean) {
  const std::string two = numbers("a", {0.2f, 0.4f}) + numbers("b", {0.1f, 0.5f});
  SceneDescription scene = read_world(two +
                                      "Material \"conductor\" \"texture uroughness\" \"a\" \"texture vroughness\" "
                                      "\"a\" \"bool remaproughness\" false\n" +
                                      kWall);
  EXPECT_GE(material(scene).roughness_texture.texture, 0);
  EXPECT_EQ(diagnostics_.count(), 0u);
  scene = read_world(two +
                     "Material \"conductor\" \"texture uroughness\" \"a\" \"float vroughness\" 0.7 \"bool "
                     "remaproughness\" false\n" +
                     kWall);
  EXPECT_LT(material(scene).roughness_texture.texture, 0);
  EXPECT_NEAR(material(scene).roughness[0], 0.3f, 1e-6f);
  EXPECT_FLOAT_EQ(material(scene).roughness[1], 0.7f);
  EXPECT_EQ(
      notes_with("scene.pbrt:5: Material \"conductor\": uroughness is a picture, and the other axis has another or "
                 "none: the mean of its alpha, 0.300000, is taken"),
      1u);
}

TEST_F(ToolPbrtSurface, MetalsOfAPictureReflectIt) {
  const std::string head =
      "LightSource \"infinite\" \"rgb L\" [1 1 1]\n" + numbers("r", {0.25f, 0.25f}, "\"string encoding\" \"linear\"");
  const std::string picture = "Texture \"c\" \"spectrum\" \"imagemap\" \"string filename\" \"r.pfm\"\n";
  max_edges_ = 3;
  SceneDescription scene =
      read_world(head + picture + "Material \"conductor\" \"texture reflectance\" \"c\"\n" + kWall);
  const MaterialDescription smooth = lower(scene);
  EXPECT_EQ(smooth.type, BDPT_MATERIAL_PRINCIPLED);
  EXPECT_TRUE(smooth.single_scattering);
  EXPECT_EQ(notes_with("metals whose reflectance is a picture have Schlick's Fresnel"), 1u);
  expect_near(radiance(std::move(scene)), {0.25f, 0.25f, 0.25f}, 0.01f);
  // What a rough one scatters more than once is lost, as with a number.
  const std::string rough = " \"float roughness\" 0.8\n" + kWall;
  const Rgb pictured =
      radiance(read_world(head + picture + "Material \"conductor\" \"texture reflectance\" \"c\"" + rough));
  const Rgb number = radiance(read_world(head + "Material \"conductor\" \"rgb reflectance\" [.25 .25 .25]" + rough));
  EXPECT_LT(number[0], 0.24f);
  expect_near(pictured, number, 0.03f);
}

TEST_F(ToolPbrtSurface, BelowACoatTheMeanOfTheMetalIsTaken) {
  const SceneDescription scene = read_world(numbers("r", {0.2f, 0.6f}) +
                                            "Texture \"c\" \"spectrum\" \"imagemap\" \"string filename\" \"r.pfm\"\n"
                                            "Material \"coatedconductor\" \"texture reflectance\" \"c\"\n" +
                                            kWall);
  const float k = material(scene).k[0];
  EXPECT_NEAR(k * k / (4 + k * k), 0.4f, 1e-5f);
  EXPECT_LT(material(scene).reflectance_texture.texture, 0);
  EXPECT_EQ(notes_with("of the metal's reflectance, a picture, the mean is taken"), 1u);
}

TEST_F(ToolPbrtSurface, AlphaOfWhatEmitsIsLeftOutAloud) {
  const auto lamp = [](const char* alpha) {
    return std::string("AreaLightSource \"diffuse\"\nShape \"sphere\" \"float alpha\" ") + alpha + "\n";
  };
  const SceneDescription scene = read_world(lamp("0.5"));
  EXPECT_EQ(material(scene).alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(notes_with("scene.pbrt:4: alpha of a shape that emits is left out: all of it is there, and shines"), 1u);
  read_world(lamp("0"));
  EXPECT_EQ(notes_with("scene.pbrt:4: alpha of a shape that emits is left out: it is seen, and in pbrt shines unseen"),
            1u);
}

}  // namespace bdpt_tool::tool_pbrt_surface_test
