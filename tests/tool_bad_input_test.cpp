// Bad input: every file from elsewhere is read or refused with file and reason; nothing leaves the scene's folder.
//
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "image.h"
#include "scene_upload.h"
#include "temp_folder.h"

namespace bdpt_tool::tool_bad_input_test {

namespace fs = std::filesystem;

std::string outcome(const std::string& path, bool build = true) {
  Diagnostics diagnostics(false);
  try {
    SceneDescription scene = read_scene(path, diagnostics);
    if (build) {
      const Context context = make_context(1, diagnostics);
      build_scene(context.get(), scene);
    }
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// What must come of the files of ../shared/scenes/importer-edge: read where nothing is said, else a part of the error.
const std::map<std::string, std::string> kExpected = {
    {"obj/number_formats.obj", ":11: expected a number, found '3.1+e2'"},
    {"obj/point_cloud.obj", "there are no faces"},
    {"obj/testline.obj", "there are no faces"},
    {"obj/testpoints.obj", "there are no faces"},
    {"ply/issue623.ply", ":15: expected a whole number"},
    {"ply/points.ply", "no faces"},
    {"ply/payload_JVN42386607", "not a scene this program can read"},
    {"gltf-bad/IndexOutOfRange/AllIndicesOutOfRange.gltf", "vertex 65535 does not exist, there are 24"},
    {"gltf-bad/IndexOutOfRange/IndexOutOfRange.gltf", "vertex 255 does not exist, there are 24"},
    {"gltf-bad/MissingBin/BoxTextured.gltf", "No such file"},
    {"gltf-bad/RecursiveNodes/RecursiveNodes.gltf", "nodes[0] is its own ancestor"},
    {"gltf-bad/wrongTypes/badArray.gltf", "meshes[0].primitives must be an array"},
    {"gltf-bad/wrongTypes/badExtension.gltf", "KHR_texture_transform must be an object"},
    {"gltf-bad/wrongTypes/badNumber.gltf", "materials[0].normalTexture.scale must be a number"},
    {"gltf-bad/wrongTypes/badObject.gltf", "pbrMetallicRoughness must be an object"},
    {"gltf-bad/wrongTypes/badString.gltf", "scenes[0].name must be a string"},
    {"gltf-bad/wrongTypes/badUint.gltf", "baseColorTexture.index is -1"},
    {"glb-bad/bom.glb", "there is no scene"},
    {"glb-bad/two_images.glb", "there is no scene"},
    {"glb-bad/valid.glb", "there is no scene"},
    {"glb-bad/valid_buffer.glb", "there is no scene"},
    {"glb-bad/empty_json_object.glb", "asset is missing"},
    {"glb-bad/invalid_json_chunk.glb", "not valid JSON"},
};

std::string expected(const std::string& name) {
  const auto found = kExpected.find(name);
  if (found != kExpected.end()) return found->second;
  if (name.starts_with("collada/")) return "COLLADA is not read here";
  return name.starts_with("glb-bad/") ? "damaged GLB" : "";
}

TEST(ToolBadInput, EveryFileOfImporterEdgeIsReadOrRefusedAsTheTableSays) {
  const fs::path folder = fs::path(BDPT_SHARED_DIR) / "scenes/importer-edge";
  if (!fs::exists(folder)) GTEST_SKIP() << "the shared scenes are not here";
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension();
    if (!entry.is_regular_file() || extension == ".mtl" || extension == ".png" || extension == ".bin" ||
        entry.path().filename() == "LICENSE") {
      continue;
    }
    ++files;
    const std::string name = entry.path().lexically_relative(folder).string(), want = expected(name);
    const std::string got = outcome(entry.path());
    if (want.empty()) {
      EXPECT_EQ(got, "") << name;
    } else {
      EXPECT_TRUE(got.starts_with(entry.path().string())) << name << ": " << got;
      EXPECT_NE(got.find(want), std::string::npos) << name << ": " << got;
    }
  }
  EXPECT_EQ(files, 77u);
}

std::size_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::size_t(usage.ru_maxrss) * 1024;
}

TEST(ToolBadInput, DamagedOpenExrIsReadOrRefusedWithoutMuchMemory) {
  const fs::path folder = fs::path(BDPT_SHARED_DIR) / "scenes/openexr/Damaged";
  if (!fs::exists(folder)) GTEST_SKIP() << "the shared scenes are not here";
  std::size_t files = 0, refused = 0;
  const std::size_t before = peak_bytes();
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() == "README.rst") continue;
    ++files;
    try {
      read_exr(entry.path());
    } catch (const Error& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find(entry.path().string()), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(files, 40u);
  EXPECT_GT(refused, 30u);
#ifndef __SANITIZE_ADDRESS__  // which touches all that is asked for
  EXPECT_LT(peak_bytes() - before, std::size_t{64} << 20);
#else
  (void)before;
#endif
}

class ToolPaths : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_.file("scene/sub"));
    write("secret.pbrt", "");
    write("scene/sub/part.pbrt", "");
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_.file(name)) << text; }
  std::string include(const std::string& name, const std::string& limit = "") {
    write("scene/s.pbrt", "Camera \"perspective\"\nWorldBegin\nShape \"sphere\"\nInclude \"" + name + "\"\n");
    Diagnostics diagnostics(false);
    try {
      read_scene(folder_.file("scene/s.pbrt"), diagnostics, {.scene = "", .folder = limit, .environment = ""});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  bdpt::TempFolder folder_;
};

TEST_F(ToolPaths, FilesOutsideOfTheScenesFolderAreRefused) {
  EXPECT_EQ(include("sub/part.pbrt"), "");
  EXPECT_EQ(include("sub/../sub/./part.pbrt"), "");
  EXPECT_EQ(include(folder_.file("scene/sub/part.pbrt")), "");
  fs::create_symlink(folder_.file("secret.pbrt"), folder_.file("scene/link.pbrt"));
  fs::create_symlink(folder_.path(), folder_.file("scene/up"));
  for (const std::string& name : {std::string("../secret.pbrt"), std::string("sub/../../secret.pbrt"),
                                  folder_.file("secret.pbrt"), std::string("link.pbrt"), std::string("up/secret.pbrt"),
                                  std::string("/etc/hostname"), std::string("../scene2/x.pbrt")}) {
    const std::string error = include(name);
    EXPECT_NE(error.find("s.pbrt:4: '" + name + "' lies outside of the scene's folder"), std::string::npos) << error;
  }
  EXPECT_EQ(include("../secret.pbrt", folder_.path()), "");
}

TEST_F(ToolPaths, EveryFormatKeepsToIt) {
  write("scene/a.obj", "mtllib ../m.mtl\n");
  write("scene/b.obj", "mtllib b.mtl\n");
  write("scene/b.mtl", "newmtl m\nmap_Kd ..\\\\x.png\n");
  write("scene/c.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"%2e%2e/x.bin"}]})");
  write("scene/d.gltf", R"({"asset":{"version":"2.0"},"images":[{"uri":"../x.png"}],"scenes":[{}]})");
  write("scene/e.pbrt", "Camera \"perspective\"\nWorldBegin\nShape \"plymesh\" \"string filename\" \"../x.ply\"\n");
  write("scene/f.pbrt",
        "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\" \"string filename\" \"../x.exr\"\n");
  write("scene/g.pbrt",
        "Camera \"perspective\"\nWorldBegin\nTexture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"../x.png\"\n"
        "Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n");
  for (const char* name : {"a.obj", "b.obj", "c.gltf", "d.gltf", "e.pbrt", "f.pbrt", "g.pbrt"}) {
    const std::string error = outcome(folder_.file(std::string("scene/") + name));
    EXPECT_NE(error.find("lies outside of the scene's folder"), std::string::npos) << name << ": " << error;
  }
}

// Files from elsewhere with bytes changed at random are read or refused, and nothing else happens.
TEST(ToolBadInput, ChangedFilesAreReadOrRefused) {
  const fs::path folder = fs::path(BDPT_SHARED_DIR) / "scenes";
  if (!fs::exists(folder)) GTEST_SKIP() << "the shared scenes are not here";
  const char* kFiles[] = {"importer-edge/obj/cube_usemtl.obj",
                          "importer-edge/obj/box_UTF16BE.obj",
                          "importer-edge/obj/concave_polygon.obj",
                          "importer-edge/ply/cube_binary.ply",
                          "importer-edge/ply/float-color.ply",
                          "importer-edge/gltf-bad/BoxBadNormals-glTF-Binary/BoxBadNormals.glb",
                          "gltf/SimpleInstancing/SimpleInstancing.glb",
                          "gltf/Box/Box.glb",
                          "gltf/SimpleSparseAccessor/SimpleSparseAccessor.gltf",
                          "bitterli/veach-mis/scene-v4.pbrt",
                          "bitterli/cornell-box/scene-v4.pbrt"};
  const char* const rounds_text = std::getenv("BDPT_MUTATIONS");
  const int rounds = rounds_text ? std::atoi(rounds_text) : 60;
  bdpt::TempFolder temp;
  std::size_t refused = 0, read = 0;
  for (const char* name : kFiles) {
    if (!fs::exists(folder / name)) {
      ADD_FAILURE() << name << " is not there";
      continue;
    }
    std::ifstream file(folder / name, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    std::mt19937 random(1);
    for (int round = 0; round < rounds; ++round) {
      std::string changed = whole;
      for (int i = 0; i < 1 + round % 8; ++i) {
        const std::size_t at = random() % changed.size();
        const unsigned kind = random() % 4;
        if (kind == 0) changed[at] = static_cast<char>(random());
        if (kind == 1) changed[at] = "0\"[]{}-9,. \n"[random() % 12];
        if (kind == 2) changed.erase(at, random() % 16);
        if (kind == 3) changed.insert(at, whole, random() % whole.size(), random() % 16);
        if (changed.empty()) changed = whole;
      }
      const std::string path = temp.file("changed" + fs::path(name).extension().string());
      std::ofstream(path, std::ios::binary) << changed;
      outcome(path).empty() ? ++read : ++refused;
    }
  }
  EXPECT_GT(refused, 0u);
  EXPECT_GT(read, 0u);
}

}  // namespace bdpt_tool::tool_bad_input_test
