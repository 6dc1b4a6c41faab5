// What `bdpt render` writes beside the picture: names of layers, mattes, and the denoiser that may not be there.
#include "render_outputs.h"

#include "api_scene.h"
#include "cryptomatte.h"
#include "temp_folder.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <bit>
#include <cmath>

namespace bdpt_tool::tool_outputs_test {

// Appleby's function, by values that many programs print; the last two are of Cryptomatte files.
TEST(ToolOutputs, NamesAreHashedByMurmur3) {
  EXPECT_EQ(murmur3(""), 0u);
  EXPECT_EQ(murmur3("hello"), 0x248bfa47u);
  EXPECT_EQ(murmur3("hello, world"), 0x149bbb7fu);
  EXPECT_EQ(murmur3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
  EXPECT_EQ(matte_hash("bunny"), 0x13851a76u);
  EXPECT_EQ(matte_hash("default"), 0x42c9679fu);
  for (int i = 0; i < 4096; ++i) EXPECT_TRUE(std::isnormal(std::bit_cast<float>(matte_hash(std::to_string(i)))));
}

TEST(ToolOutputs, MattesCountIdsOfOneNameTogether) {
  std::map<std::uint64_t, std::string> names;
  for (std::uint64_t id = 1; id <= 8; ++id) names[id] = "object " + std::to_string(id % 7);  // 1 and 8 are one
  std::vector<bdpt_coverage> entries;
  const float parts[8] = {0.2f, 0.18f, 0.16f, 0.12f, 0.1f, 0.09f, 0.05f, 0.1f};
  for (std::uint64_t id = 1; id <= 8; ++id) entries.push_back({id, parts[id - 1], 0});
  entries.resize(16);  // a pixel of nothing
  const Matte matte = make_matte("CryptoObject", entries, 8, names);
  ASSERT_EQ(matte.ranks.size(), 2 * 2 * Matte::kRanks);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(matte.ranks[0]), matte_hash("object 1"));
  EXPECT_FLOAT_EQ(matte.ranks[1], 0.3f);
  for (std::size_t i = 1; i < Matte::kRanks; ++i) EXPECT_LE(matte.ranks[2 * i + 1], matte.ranks[2 * i - 1]);
  for (std::size_t i = 2 * Matte::kRanks; i < matte.ranks.size(); ++i) EXPECT_EQ(matte.ranks[i], 0);
  EXPECT_NEAR(matte.left_out, 0.05 / 2, 1e-7);  // the seventh name, of two pixels
  for (const auto& [key, text] : matte.attributes) EXPECT_TRUE(key.starts_with("cryptomatte/")) << key;
}

TEST(ToolOutputs, UnknownNamesAreRefused) {
  for (const char* names : {"albedo,colour", "group:64", "group:", "group:1x", "albedo,,depth", "depth,depth"}) {
    try {
      RenderOutputs(names, false);
      ADD_FAILURE() << names;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage) << names;
    }
  }
}

TEST(ToolOutputs, ADenoiserThatIsNotThereIsReportedBeforeTheRender) {
  if (bdpt_has_denoiser()) GTEST_SKIP() << "it is there";
  try {
    RenderOutputs("", true);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_NE(std::string(error.what()).find("Open Image Denoise"), std::string::npos) << error.what();
  }
}

std::vector<float> read_channel(Imf::InputFile& file, const std::string& name, int width, int height) {
  EXPECT_NE(nullptr, file.header().channels().findChannel(name)) << name;
  std::vector<float> values(std::size_t(width * height));
  Imf::FrameBuffer buffer;
  buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), Imath::V2i(0, 0), width, height));
  file.setFrameBuffer(buffer);
  file.readPixels(0, height - 1);
  return values;
}

TEST(ToolOutputs, LayersHaveTheNamesThatOtherProgramsExpect) {
  const bdpt_api::World world;
  const RenderOutputs outputs(
      "albedo,normal,depth,position,direct,indirect,group:0,cryptoobject,cryptomaterial,samples", false);
  bdpt_camera_desc camera = bdpt_api::camera_desc();
  outputs.add_to(camera);
  const bdpt_api::Sensor sensor = bdpt_api::make_camera(world.context.get(), camera);
  const bdpt_api::Film film = bdpt_api::make_film(sensor.get());
  EXPECT_OK(bdpt_api::advance(bdpt_api::make_render(world.scene.get(), sensor.get(), film.get()).get(), 8));
  SceneDescription scene;
  scene.materials.resize(2);
  scene.materials[0].label = "grey";
  for (const auto& [id, name, material] :
       {std::tuple(world.contents.floor, "floor", 0), std::tuple(world.contents.light, "lamp", 1),
        std::tuple(world.contents.thing, "a \"ball\"", 0)}) {
    InstanceDescription& instance = scene.instances.emplace_back();
    instance.id = id, instance.node_name = name, instance.material = material;
    instance.material_id = material == 0 ? world.contents.grey : world.contents.lamp;
  }
  const bdpt::TempFolder folder;
  const std::string path = folder.file("layers.exr");
  outputs.write(path, film.get(), false, world.context.get(), scene, {});

  Imf::InputFile file(path.c_str());
  const auto channel = [&](const std::string& name) { return read_channel(file, name, 24, 16); };
  const std::vector<float> red = channel("R"), direct = channel("direct.R"), indirect = channel("indirect.R"),
                           group = channel("group0.R"), depth = channel("depth.Z"), height = channel("P.Y"),
                           up = channel("N.Y"), albedo = channel("albedo.G"), samples = channel("samples.Y"),
                           id = channel("CryptoObject00.R"), part = channel("CryptoObject00.G"),
                           next = channel("CryptoObject02.A"), material = channel("CryptoMaterial00.R");
  for (const char* name : {"variance.B", "N.X", "N.Z", "P.X", "P.Z", "albedo.R", "CryptoMaterial01.B"}) channel(name);
  std::size_t balls = 0;
  for (std::size_t i = 0; i < red.size(); ++i) {
    EXPECT_NEAR(direct[i] + indirect[i], red[i], 1e-5f);
    EXPECT_NEAR(group[i], red[i], 1e-5f);
    EXPECT_EQ(samples[i], 8);
    EXPECT_TRUE((depth[i] > 2 && depth[i] < 10) || depth[i] == 1e10f) << depth[i];
    EXPECT_LE(std::fabs(up[i]), 1.0001f);
    EXPECT_LE(albedo[i], 0.5001f);
    if (part[i] == 1 && std::bit_cast<std::uint32_t>(id[i]) == matte_hash("floor")) {
      EXPECT_NEAR(height[i], 0, 1e-4f);
      EXPECT_EQ(std::bit_cast<std::uint32_t>(material[i]), matte_hash("grey"));
    }
    balls += part[i] == 1 && std::bit_cast<std::uint32_t>(id[i]) == matte_hash("a \"ball\"");
    EXPECT_EQ(next[i], 0);
  }
  EXPECT_GT(balls, 5u);
  std::string manifest, name;
  for (auto a = file.header().begin(); a != file.header().end(); ++a) {
    const std::string key = a.name();
    if (!key.starts_with("cryptomatte/")) continue;
    const std::string& text = dynamic_cast<const Imf::StringAttribute&>(a.attribute()).value();
    if (key.ends_with("/name")) name += text + ' ';
    if (key.ends_with("/manifest")) manifest += text;
    if (key.ends_with("/hash")) {
      EXPECT_EQ(text, "MurmurHash3_32");
    }
    if (key.ends_with("/conversion")) {
      EXPECT_EQ(text, "uint32_to_float32");
    }
  }
  EXPECT_NE(name.find("CryptoObject "), std::string::npos);
  EXPECT_NE(name.find("CryptoMaterial "), std::string::npos);
  EXPECT_NE(manifest.find("\"a \\\"ball\\\"\":\""), std::string::npos) << manifest;
  EXPECT_NE(manifest.find("\"material 1\":\""), std::string::npos) << manifest;
}

}  // namespace bdpt_tool::tool_outputs_test
