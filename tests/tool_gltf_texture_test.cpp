// Textures of glTF: where images are, and how materials use them.
//
// SPDX-License-Identifier: Apache-2.0
#include "gltf_fixture.h"

namespace bdpt_tool::tool_gltf_texture_test {

TEST_F(ToolGltfTexture, ABaseColourTextureKeepsItsBytesWhereTheFactorIsWhite) {
  const SceneDescription scene = read_textured(base_color("[1,1,1,1]"), image_uri(png(kTwo)));
  ASSERT_EQ(scene.materials.at(0).reflectance_texture.texture, 0);
  const auto& image = std::get<ByteImage>(scene.textures.at(0).image);
  EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{255, 0, 128, 0, 255, 255}));
}

TEST_F(ToolGltfTexture, AFactorStandsBesideItsTexture) {
  const SceneDescription scene = read_textured(base_color("[0.5,1,0.25,1]"), image_uri(png(kTwo)));
  EXPECT_EQ(scene.materials.at(0).reflectance, (Rgb{.5f, 1, .25f}));
  EXPECT_TRUE(std::holds_alternative<ByteImage>(scene.textures.at(0).image));
}

TEST_F(ToolGltfTexture, ImagesMayBeInFilesAndInBufferViews) {
  const std::string bytes = png(kTwo);
  std::filesystem::rename(folder_.file("two.png"), folder_.file("two texels+1.png"));
  EXPECT_EQ(read_textured(base_color("[1,1,1,1]"), "{\"uri\":\"two%20texels+1.png\"}").textures.size(), 1u);
  const int view = buffer_.add_bytes(bytes);
  buffer_ = GltfBuffer();
  const std::string attributes = triangle();
  const int again = buffer_.add_bytes(bytes);
  EXPECT_EQ(again, view > 0 ? 1 : 0);
  const SceneDescription scene = read_primitive(
      attributes + ",\"material\":0", "\"materials\":[{" + base_color("[1,1,1,1]") +
                                          "}],\"textures\":[{\"source\":0}],\"images\":[{\"mimeType\":\"image/png\","
                                          "\"bufferView\":" +
                                          std::to_string(again) + "}]");
  EXPECT_EQ(std::get<ByteImage>(scene.textures.at(0).image).width, 2u);
}

TEST_F(ToolGltfTexture, ATextureSaysWhichUvItWantsAndHowTheyAreMoved) {
  const SceneDescription second = read_textured(base_color("[1,1,1,1]", ",\"texCoord\":1"), image_uri(png(kTwo)));
  EXPECT_EQ(second.materials.at(0).reflectance_texture.uv_set, 1);
  buffer_ = GltfBuffer();
  const SceneDescription moved =
      read_textured(base_color("[1,1,1,1]",
                               ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0.25],\"scale\":[2,1],"
                               "\"rotation\":1.5707963267948966}}"),
                    image_uri(png(kTwo)));
  // (u, v) becomes (v + 0.5, 0.25 - 2 u), then v is turned up.
  EXPECT_EQ(mesh(moved).uv, (Floats{0, 1, .25f, 1, 0, .5f}));
  const auto& m = moved.materials.at(0).reflectance_texture.transform;
  Floats uv;
  for (std::size_t i = 0; i < 6; i += 2) {
    const float u = mesh(moved).uv[i], v = mesh(moved).uv[i + 1];
    uv.insert(uv.end(), {m[0] * u + m[1] * v + m[2], m[3] * u + m[4] * v + m[5]});
  }
  expect_near(uv, {.5f, .75f, .5f, 1.25f, 1, .75f});
  EXPECT_EQ(mesh(moved).uv_lightmap, (Floats{1, 0, 0, 1, .5f, .5f}));
}

TEST_F(ToolGltfTexture, AnEmissionTextureMultipliesTheEmission) {
  const SceneDescription scene = read_textured(
      "\"emissiveFactor\":[1,1,0.5],\"emissiveTexture\":{\"index\":0},\"extensions\":{"
      "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":4}}",
      image_uri(png(kTwo)));
  EXPECT_EQ(lower(scene).emission, (Rgb{4, 4, 2}));
  EXPECT_EQ(lower(scene).emission_texture.texture, 0);
  EXPECT_EQ(notes_with("emission"), 0u) << notes();
}

TEST_F(ToolGltfTexture, SamplersSayHowTexturesGoOnAndAreFiltered) {
  const SceneDescription scene =
      read_textured(base_color("[1,1,1,1]"), image_uri(png(kTwo)),
                    ",\"samplers\":[{\"wrapS\":33071,\"magFilter\":9728}]", "\"source\":0,\"sampler\":0");
  EXPECT_EQ(scene.textures.at(0).wrap, (std::array<Wrap, 2>{Wrap::kClamp, Wrap::kRepeat}));
  EXPECT_TRUE(scene.textures.at(0).nearest);
}

TEST_F(ToolGltfTexture, WhatIsNoPngOrJpegIsAnError) {
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), image_uri("GIF89a")), Error);
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), "{\"uri\":\"data:image/webp;base64,AAAA\"}"), Error);
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), "{\"uri\":\"none.png\"}"), Error);
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), image_uri(png(kTwo)), "", "\"name\":\"t\""), Error);
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), image_uri(png(kTwo).substr(0, 40))), Error);
}

TEST_F(ToolGltfTexture, ImagesThatAnExtensionAloneHasAreNamedWithIt) {
  const std::string texture = "\"extensions\":{\"KHR_texture_basisu\":{\"source\":0}}";
  try {
    read_textured(base_color("[1,1,1,1]"), image_uri(png(kTwo)), "", texture);
    FAIL();
  } catch (const Error& error) {
    expect_contains(error.what(),
                    "textures[0] has its image by KHR_texture_basisu alone, which is not read here; "
                    "write the textures as PNG or JPEG");
  }
}

}  // namespace bdpt_tool::tool_gltf_texture_test
