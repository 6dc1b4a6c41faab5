// `bdpt bake`, from a scene file to lightmaps.
//
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "commands.h"
#include "gltf_writer.h"
#include "image.h"
#include "temp_folder.h"

namespace bdpt_tool {
namespace {

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

class ToolBake : public testing::Test {
 protected:
  void SetUp() override { std::ofstream(file("scene.gltf")) << scene(); }
  std::string file(const std::string& name) const { return folder_.file(name); }

  // `bdpt bake scene.gltf` with these arguments, of which the first names the output.
  int bake(std::vector<std::string> arguments) {
    arguments[0] = file(arguments[0]);
    std::vector<std::string> all = {"bdpt", "bake", file("scene.gltf"), "-o"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& a : all) argv.push_back(a.data());
    testing::internal::CaptureStderr();
    const int code = run_program(int(argv.size()), argv.data());
    error_ = testing::internal::GetCapturedStderr();
    return code;
  }
  std::map<std::string, Image> layers(const std::string& name) { return read_exr(file(name)); }

  bdpt::TempFolder folder_;
  std::string error_;
};

TEST_F(ToolBake, AFileForEachNodeALayerForEachPlane) {
  ASSERT_EQ(0, bake({"a.exr", "--resolution", "8", "--spp", "4", "--outputs",
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
  refused({"--subset", "lamp"}, 2, "'floor', 'cellar'");
  refused({"--resume"}, 2, "--film");
  refused({"--resolution", "60000"}, 2, "--subset");
  refused({"--texels-per-unit", "1e9"}, 2, "65536");
  refused({"--integrator", "mmlt", "--spp", "16"}, 3, "mmlt");
  refused({"--uv", "2"}, 2, "--uv");
  std::ofstream(file("scene.gltf")) << "{\"asset\":{\"version\":\"2.0\"}}";
  refused({}, 3, "");
}

}  // namespace
}  // namespace bdpt_tool
