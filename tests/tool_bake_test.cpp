// `bdpt bake`, from a scene file to lightmaps.
//
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>

#include "agreement.h"
#include "bake_fixture.h"
#include "exr_parts.h"
#include "gltf_writer.h"
#include "image.h"

namespace bdpt_tool::tool_bake_test {

// A floor, 2 x 2, that has both sets of coordinates, and a lamp over it that has none.
std::string scene() {
  GltfBuffer buffer;
  const int floor = buffer.add<float>("VEC3", {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1});
  const int lamp = buffer.add<float>("VEC3", {-0.5f, 1, -0.5f, 0.5f, 1, -0.5f, 0.5f, 1, 0.5f, -0.5f, 1, 0.5f});
  const int uv = buffer.add<float>("VEC2", {0, 1, 1, 1, 1, 0, 0, 0});
  const int indices = buffer.add<std::uint16_t>("SCALAR", {0, 1, 2, 0, 2, 3});
  const auto primitive = [&](int positions, int material, bool mapped) {
    const std::string coordinates = ",\"TEXCOORD_0\":" + std::to_string(uv) + ",\"TEXCOORD_1\":" + std::to_string(uv);
    return "{\"attributes\":{\"POSITION\":" + std::to_string(positions) + (mapped ? coordinates : "") +
           "},\"indices\":" + std::to_string(indices) + ",\"material\":" + std::to_string(material) + "}";
  };
  return "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1,2]}],"
         "\"nodes\":[{\"mesh\":0,\"name\":\"floor\"},{\"mesh\":1,\"name\":\"lamp\"},"
         "{\"mesh\":0,\"name\":\"cellar\",\"translation\":[0,-1,0]}],"
         "\"meshes\":[{\"primitives\":[" +
         primitive(floor, 0, true) + "]},{\"primitives\":[" + primitive(lamp, 1, false) +
         "]}],\"materials\":[{\"doubleSided\":true,\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":"
         "[0.5,0.5,0.5,1]}},{\"emissiveFactor\":[1,1,1]}]," +
         buffer.members() + "}";
}

class ToolBake : public BakeFixture {
 protected:
  void SetUp() override { write("scene.gltf", scene()); }

  // `bdpt bake scene.gltf` with these arguments, of which the first names the output.
  int bake(std::vector<std::string> arguments, const std::string& scene = "scene.gltf") {
    const std::string output = arguments[0];
    arguments.erase(arguments.begin());
    return run(scene, output, arguments);
  }
  std::map<std::string, Image> layers(const std::string& name) { return read_exr(file(name)); }
};

TEST_F(ToolBake, AFileForEachNodeALayerForEachPlane) {
  ASSERT_EQ(0, bake({"a.exr", "--files", "--resolution", "8", "--spp", "4", "--outputs",
                     "e,sh1,e-over-pi-indirect,openness,bent-normal,fronts", "--png", file("a.png")}))
      << error_;
  const auto floor = layers("a-floor.exr"), cellar = layers("a-cellar.exr");
  for (const char* name : {"", "irradiance", "radiance_sh_0", "radiance_sh_3", "irradiance_over_pi_indirect",
                           "openness", "bent_normal", "fronts", "coverage"})
    ASSERT_TRUE(floor.contains(name)) << name;
  EXPECT_EQ(11u, floor.size());
  EXPECT_EQ(8u, floor.at("").width);
  EXPECT_EQ(floor.at("").pixels, floor.at("irradiance").pixels);
  for (const float c : floor.at("coverage").pixels) EXPECT_NEAR(1, c, 1e-6);
  double lit = 0, dark = 0;
  for (const float v : floor.at("").pixels) lit += double(v);
  for (const float v : cellar.at("").pixels) dark += double(v);
  EXPECT_GT(lit, 20 * dark);
  EXPECT_TRUE(std::ifstream(file("a-floor.png")).good());
}

TEST_F(ToolBake, AFileHasAPartForEachNode) {
  const std::vector<std::string> how = {"a.exr", "--resolution", "8", "--spp", "4", "--outputs", "e,sh1"};
  ASSERT_EQ(0, bake(how)) << error_;
  EXPECT_FALSE(std::ifstream(file("a-floor.exr")).good());
  const auto parts = read_exr_parts(file("a.exr"));
  ASSERT_EQ(2u, parts.size());
  std::vector<std::string> files = how;
  files.push_back("--files");
  ASSERT_EQ(0, bake(files)) << error_;
  for (const char* node : {"floor", "cellar"}) {
    const auto apart = layers("a-" + std::string(node) + ".exr");
    ASSERT_TRUE(parts.contains(node));
    ASSERT_EQ(apart.size(), parts.at(node).size());
    for (const auto& [layer, image] : apart) EXPECT_EQ(image.pixels, parts.at(node).at(layer).pixels) << layer;
  }
  EXPECT_EQ(parts.at("floor").at("").pixels, layers("a.exr").at("").pixels);  // the first part
  EXPECT_EQ(4u, folder_.count());                                             // the scene, a file of parts, two files
}

TEST_F(ToolBake, PartsThatCannotBeWrittenLeaveNothing) {
  const auto images = [](std::size_t) { return std::vector<Image>{Image(4, 4)}; };
  try {
    write_exr_parts(file("none/a.exr"), {"one", "two"}, {"e"}, images);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(ExitCode::kOutput, error.code());
  }
  std::ofstream(file("old.exr")) << "old";
  EXPECT_THROW(write_exr_parts(file("old.exr"), {"one", "one"}, {"e"}, images), Error);
  EXPECT_EQ(3u, std::filesystem::file_size(file("old.exr")));
  EXPECT_EQ(2u, folder_.count());
}

TEST_F(ToolBake, DirectAndIndirectLightMakeTheWhole) {
  ASSERT_EQ(0, bake({"a.exr", "--resolution", "8", "--spp", "4", "--subset", "floor", "--outputs",
                     "e,e-direct,e-indirect", "--gutter", "0"}))
      << error_;
  const auto map = layers("a.exr");
  for (std::size_t i = 0; i < map.at("").pixels.size(); ++i)
    EXPECT_NEAR(map.at("").pixels[i], map.at("irradiance_direct").pixels[i] + map.at("irradiance_indirect").pixels[i],
                1e-5);
  ASSERT_EQ(0, bake({"b.exr", "--resolution", "8", "--spp", "4", "--subset", "floor", "--direct-only"})) << error_;
  EXPECT_EQ(map.at("irradiance_direct").pixels, layers("b.exr").at("irradiance_direct").pixels);
}

// Under the lamp the floor is open, the cellar in the floor's shade; and from the floor all is open but the lamp.
TEST_F(ToolBake, ShadowMasksAndMapsOfDirections) {
  ASSERT_EQ(0, bake({"a.exr", "--resolution", "8", "--spp", "64", "--integrator", "path", "--outputs",
                     "e-direct,unshadowed,distance-oct", "--reach", "3", "--gutter", "0"}))
      << error_;
  const auto parts = read_exr_parts(file("a.exr"));
  const auto& floor = parts.at("floor");
  const auto sum = [](const Image& image) {
    double total = 0;
    for (const float v : image.pixels) total += double(v);
    return total;
  };
  EXPECT_NEAR(sum(floor.at("irradiance_direct")), sum(floor.at("unshadowed")), 0.05 * sum(floor.at("unshadowed")));
  EXPECT_GT(sum(parts.at("cellar").at("unshadowed")), 10 * sum(parts.at("cellar").at("irradiance_direct")));
  ASSERT_TRUE(floor.contains("distance_oct_63"));
  // Red is the distance: up to the lamp or 3 above the floor's horizon, none below.
  double mean = 0;
  for (int plane = 0; plane < 64; ++plane) {
    const Image& image = floor.at("distance_oct_" + std::to_string(plane));
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) mean += double(image.pixels[i]) / (64 * 64);
  }
  EXPECT_GT(mean, 1.1);
  EXPECT_LT(mean, 1.5);
}

TEST_F(ToolBake, TheDensityDecidesTheResolution) {
  ASSERT_EQ(0, bake({"a.exr", "--texels-per-unit", "5.4", "--spp", "1", "--subset", "floor"})) << error_;
  EXPECT_EQ(11u, layers("a.exr").at("").width);
}

TEST_F(ToolBake, WhatGoesOnHasTheBitsOfTheWhole) {
  const std::vector<std::string> all = {"whole.exr", "--resolution", "8", "--subset", "floor", "--spp", "16"};
  ASSERT_EQ(0, bake(all)) << error_;
  std::vector<std::string> half = all;
  half[0] = "half.exr", half[6] = "8";
  half.insert(half.end(), {"--film", file("map.film")});
  ASSERT_EQ(0, bake(half)) << error_;
  EXPECT_NE(layers("whole.exr").at("").pixels, layers("half.exr").at("").pixels);
  half[6] = "16";
  half.push_back("--resume");
  ASSERT_EQ(0, bake(half)) << error_;
  EXPECT_EQ(layers("whole.exr").at("").pixels, layers("half.exr").at("").pixels);
  half[2] = "9";  // another lightmap than the film's
  EXPECT_NE(0, bake(half));
}

TEST_F(ToolBake, NoiseAndTimeAreLimitsForSeveralNodes) {
  testing::internal::CaptureStdout();
  const int code = bake({"a.exr", "--resolution", "16", "--noise", "0.02", "--json", "--film", file("a.film")});
  const std::string report = testing::internal::GetCapturedStdout();
  ASSERT_EQ(0, code) << error_;
  const auto number = [&](const std::string& key) {
    const std::size_t at = report.find("\"" + key + "\": ");
    return at == std::string::npos ? -1 : std::stod(report.substr(at + key.size() + 4));
  };
  EXPECT_GT(number("relative_error"), 0) << report;
  EXPECT_LE(number("relative_error"), 0.02);
  EXPECT_GT(number("passes"), 8);
  EXPECT_EQ(2u, read_exr_parts(file("a.exr")).size());
  ASSERT_EQ(0, bake({"b.exr", "--resolution", "16", "--time", "0.05", "--film", file("a.film"), "--resume"})) << error_;
  EXPECT_NE(read_exr_parts(file("b.exr")).at("floor").at("").pixels,
            read_exr_parts(file("a.exr")).at("floor").at("").pixels);
}

TEST_F(ToolBake, NodesOfOneNameAreBakedApart) {
  std::string text = scene();
  text.replace(text.find("cellar"), 6, "floor");
  std::ofstream(file("scene.gltf")) << text;
  ASSERT_EQ(0, bake({"a.exr", "--resolution", "8", "--spp", "4"})) << error_;
  const auto parts = read_exr_parts(file("a.exr"));
  const Image &first = parts.at("floor").at(""), &second = parts.at("floor#2").at("");
  double lit = 0, dark = 0;
  for (const float v : first.pixels) lit += double(v);
  for (const float v : second.pixels) dark += double(v);
  EXPECT_GT(lit, 20 * dark);
  ASSERT_EQ(0, bake({"b.exr", "--resolution", "8", "--spp", "4", "--subset", "floor#2"})) << error_;
  EXPECT_TRUE(layers("b.exr").contains("coverage"));
}

// What other bakers do takes lamps from the texel; without that, it would find this one by chance alone.
TEST_F(ToolBake, PathTracingSeesLampsFromTheTexel) {
  ASSERT_EQ(0, bake({"a.exr", "--resolution", "8", "--subset", "floor", "--spp", "4096", "--integrator", "path"}));
  ASSERT_EQ(0, bake({"b.exr", "--resolution", "8", "--subset", "floor", "--spp", "4096"}));
  const Image a = layers("a.exr").at(""), b = layers("b.exr").at("");
  for (std::size_t i = 0; i < a.pixels.size(); ++i) EXPECT_NEAR(a.pixels[i], b.pixels[i], 0.02f * b.pixels[i]);
}

// Means of 4 x 4 blocks of the floor under a box of glass, for each seed; the lightmap has 16 x 16 texels.
class Caustic : public ToolBake {
 protected:
  static constexpr std::size_t kSide = 16, kBlock = 4, kBlocks = kSide / kBlock;

  void write_scene(const std::filesystem::path& meshes) {
    std::ofstream(file("caustic.pbrt"))
        << "Integrator \"path\" \"integer maxdepth\" 5\nCamera \"perspective\"\nWorldBegin\n"
           "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [30 30 30]\nTranslate 4 1 6\n"
           "Shape \"sphere\" \"float radius\" 1\nAttributeEnd\n"
           "Shape \"plymesh\" \"string filename\" \"mesh-00001.ply\"\n"
           "Material \"dielectric\"\nShape \"plymesh\" \"string filename\" \"mesh-00002.ply\"\n";
    for (const char* name : {"mesh-00001.ply", "mesh-00002.ply"}) std::filesystem::copy(meshes / name, file(name));
  }
  std::vector<std::vector<double>> bake_blocks(const std::vector<std::string>& how, int first_seed) {
    std::vector<std::vector<double>> blocks(kBlocks * kBlocks);
    for (int seed = first_seed; seed < first_seed + 16; ++seed) {
      std::vector<std::string> arguments = {
          "a.exr",    "--uv", "0",         "--subset",    "mesh-00001.ply", "--resolution",      "16",
          "--gutter", "0",    "--sampler", "independent", "--seed",         std::to_string(seed)};
      arguments.insert(arguments.end(), how.begin(), how.end());
      EXPECT_EQ(0, bake(arguments, "caustic.pbrt")) << error_;
      const Image map = layers("a.exr").at("");
      std::vector<double> sums(blocks.size());
      for (std::size_t y = 0; y < kSide; ++y)
        for (std::size_t x = 0; x < kSide; ++x)
          sums[y / kBlock * kBlocks + x / kBlock] += double(map.pixels[3 * (y * kSide + x)]) / double(kBlock * kBlock);
      for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].push_back(sums[i]);
    }
    return blocks;
  }
};

TEST_F(Caustic, HasTheLightThatLightTracingAloneFinds) {
  const std::string meshes = BDPT_SHARED_DIR "/scenes/lightmap/luxcore-bake";
  if (!std::filesystem::exists(meshes)) GTEST_SKIP() << "no " << meshes;
  write_scene(meshes);
  const auto light = bake_blocks({"--techniques", "t<=0", "--spp", "512", "--light-samples", "16"}, 1);
  const auto both = bake_blocks({"--integrator", "two-way", "--spp", "512", "--light-samples", "4"}, 101);
  const Agreement agreement = compare_blocks(both, light, {});
  EXPECT_LT(agreement.worst, 1) << agreement.table;
  EXPECT_LT(agreement.widest, 0.02) << agreement.table;
  auto planted = both;
  for (auto& block : planted)
    for (double& mean : block) mean *= 1.02;
  EXPECT_GT(compare_blocks(planted, light, {}).worst, 1);
}

TEST_F(ToolBake, WhatCannotBeIsTold) {
  const auto refused = [&](std::vector<std::string> arguments, int code, const std::string& text) {
    arguments.insert(arguments.begin(), "a.exr");
    EXPECT_EQ(code, bake(arguments)) << error_;
    EXPECT_NE(std::string::npos, error_.find(text)) << error_;
    EXPECT_FALSE(std::ifstream(file("a.exr")).good());
  };
  refused({"--outputs", "sh3"}, 2, "'sh3' is not known");
  refused({"--outputs", ","}, 2, "is not known");
  refused({"--outputs", "sh1,sh2"}, 2, "one name");
  refused({"--outputs", "distance-oct"}, 3, "reach");
  refused({"--subset", "lamp"}, 2, "'floor', 'cellar'");
  refused({"--resume"}, 2, "--film");
  refused({"--resolution", "60000"}, 2, "--subset");
  refused({"--texels-per-unit", "1e9"}, 2, "65536");
  refused({"--integrator", "mmlt", "--spp", "16"}, 3, "mmlt");
  refused({"--uv", "2"}, 2, "--uv");
  std::ofstream(file("scene.gltf")) << "{\"asset\":{\"version\":\"2.0\"}}";
  refused({}, 3, "");
}

}  // namespace bdpt_tool::tool_bake_test
