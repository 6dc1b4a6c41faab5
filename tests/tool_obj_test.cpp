// The OBJ and MTL readers of the program.
//
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "polygon.h"
#include "scene_read.h"
#include "temp_folder.h"

namespace bdpt_tool::tool_obj_test {

using Words = std::vector<std::uint32_t>;
using Floats = std::vector<float>;

const char kCorners[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

class ToolObj : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.file(name), std::ios::binary) << text;
  }
  SceneDescription read(const std::string& text) {
    write("scene.obj", text);
    return read_scene(folder_.file("scene.obj"), diagnostics_);
  }
  SceneDescription read_material(const std::string& mtl) {
    write("m.mtl", "newmtl m\n" + mtl);
    return read("mtllib m.mtl\n" + std::string(kCorners) + "usemtl m\nf 1 2 3\n");
  }
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      std::string message = error.what();
      return message.substr(message.find_last_of('/', message.find(": ")) + 1);
    }
    return "no error";
  }
  const TriangleMesh& mesh(const SceneDescription& scene, std::size_t shape = 0) {
    return std::get<TriangleMesh>(scene.shapes.at(shape).geometry);
  }
  bool warned(const std::string& part) const {
    for (const std::string& text : diagnostics_.texts()) {
      if (text.find(part) != std::string::npos) return true;
    }
    return false;
  }

  bdpt::TempFolder folder_;
  Diagnostics diagnostics_{false};
};

TEST_F(ToolObj, CornersMayCountFromTheFirstOrBackFromTheLast) {
  EXPECT_EQ(mesh(read(std::string(kCorners) + "f 1 2 3\n")).indices, (Words{0, 1, 2}));
  const SceneDescription scene = read(std::string(kCorners) + "v 9 9 9\nf -4 -3 -2\n");
  EXPECT_EQ(mesh(scene).positions, (Floats{0, 0, 0, 1, 0, 0, 0, 1, 0}));
}

TEST_F(ToolObj, VerticesAreSharedWhereAllTheirPartsAreTheSame) {
  const SceneDescription scene = read(std::string(kCorners) +
                                      "v 1 1 0\nvt 0 0\nvt 1 0.5\nvn 0 0 1\n"
                                      "f 1/1/1 2/2/1 3/1/1\nf 2/2/1 4/1/1 3/2/1\n");
  EXPECT_EQ(mesh(scene).indices, (Words{0, 1, 2, 1, 3, 4}));
  EXPECT_EQ(mesh(scene).uv, (Floats{0, 0, 1, .5f, 0, 0, 0, 0, 1, .5f}));
  EXPECT_EQ(mesh(scene).normals.size(), 15u);
  EXPECT_TRUE(mesh(read(std::string(kCorners) + "vn 0 0 1\nf 1//1 2//1 3//1\n")).uv.empty());
}

TEST_F(ToolObj, GroupsAndMaterialsAreInstancesOfTheirNames) {
  write("m.mtl", "newmtl two words\nKd 0.25 0.5 0.75\nnewmtl b\nKe 1 2 3\n");
  const SceneDescription scene = read("mtllib m.mtl\n" + std::string(kCorners) +
                                      "g floor\nusemtl two words\nf 1 2 3\nusemtl b\nf 1 2 3\no lamp\nf 3 2 1\n");
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[0].label, "floor");
  EXPECT_EQ(scene.instances[2].label, "lamp");
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.instances[0].material)].reflectance, (Rgb{.25f, .5f, .75f}));
  EXPECT_EQ(scene.instances[1].material, scene.instances[2].material);
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_FALSE(warned("there is no light"));
}

TEST_F(ToolObj, LinesMayGoOnEndInCarriageReturnsAndHaveComments) {
  const SceneDescription scene =
      read("\xEF\xBB\xBFv 0 0 0 # first\r\nv 1 \\\r\n0 0\r\n\r\nv +0 1. 0e5\r\nf 1 2 \\\n 3");
  EXPECT_EQ(mesh(scene).positions, (Floats{0, 0, 0, 1, 0, 0, 0, 1, 0}));
}

TEST_F(ToolObj, Utf16IsReadByItsMark) {
  const std::string text = std::string(kCorners) + "g \xC3\xA9\nf 1 2 3\n";
  for (const bool big : {false, true}) {
    std::string wide = big ? "\xFE\xFF" : "\xFF\xFE";
    const auto put = [&](char16_t unit) {
      const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 255);
      wide += big ? high : low;
      wide += big ? low : high;
    };
    for (const char c : std::string(kCorners) + "g ") put(static_cast<unsigned char>(c));
    put(0xE9);
    for (const char c : std::string("\nf 1 2 3\n")) put(static_cast<unsigned char>(c));
    const SceneDescription scene = read(wide);
    EXPECT_EQ(scene.instances.at(0).label, "\xC3\xA9");
    EXPECT_EQ(mesh(scene).indices, mesh(read(text)).indices);
  }
}

TEST_F(ToolObj, ColoursOfVerticesAreRead) {
  const SceneDescription scene = read("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
  EXPECT_EQ(mesh(scene).colors, (Floats{1, 0, 0, 1, 1, 1, 1, 1, 0, 0, 1, 1}));
  EXPECT_TRUE(mesh(read("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n")).colors.empty());  // weights
}

// The area of triangles that cut a polygon in the plane is the polygon's, and all have its winding.
double checked_area(const Floats& positions, const Words& triangles) {
  double sum = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const auto at = [&](std::size_t k, std::size_t axis) {
      return static_cast<double>(positions[3 * triangles[i + k] + axis]);
    };
    const double area =
        ((at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) - (at(1, 1) - at(0, 1)) * (at(2, 0) - at(0, 0))) / 2;
    EXPECT_GE(area, 0);
    sum += area;
  }
  return sum;
}

TEST(ToolPolygon, ConcaveOnesAreCutIntoTrianglesOfTheirWindingAndArea) {
  const Floats arrow = {0, 0, 0, 4, -2, 0, 3, 0, 0, 4, 2, 0};  // concave at the third corner
  Words triangles;
  triangulate(arrow, {0, 1, 2, 3}, triangles);
  EXPECT_EQ(triangles.size(), 6u);
  EXPECT_NEAR(checked_area(arrow, triangles), 6, 1e-9);

  Floats star;
  double area = 0;
  const int n = 40;
  for (int i = 0; i < n; ++i) {
    const double r = i % 2 ? 1 : 0.3, angle = 2 * M_PI * i / n;
    star.insert(star.end(), {float(r * std::cos(angle)), float(r * std::sin(angle)), 0});
    area += 0.5 * 1 * 0.3 * std::sin(2 * M_PI / n);
  }
  Words corners(n);
  for (std::uint32_t i = 0; i < n; ++i) corners[i] = i;
  triangles.clear();
  triangulate(star, corners, triangles);
  EXPECT_EQ(triangles.size(), 3u * (n - 2));
  EXPECT_NEAR(checked_area(star, triangles), area, 1e-5);
}

TEST(ToolPolygon, CornersInALineAndTwiceTheSameGiveTrianglesAllTheSame) {
  const Floats line = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 3, 0, 0};
  Words triangles;
  triangulate(line, {0, 1, 2, 3, 4}, triangles);
  EXPECT_EQ(triangles.size(), 9u);
}

TEST_F(ToolObj, MaterialsAreReadByTheirIllumination) {
  EXPECT_EQ(read_material("Kd 1 0 0\nKs 0 0 0\nillum 2\n").materials[0].type, BDPT_MATERIAL_DIFFUSE);
  const MaterialDescription mirror = read_material("Kd 0.1 0.1 0.1\nKs 0.9 0.8 0.7\nillum 5\n").materials[0];
  EXPECT_EQ(mirror.type, BDPT_MATERIAL_MIRROR);
  EXPECT_EQ(mirror.reflectance, (Rgb{.9f, .8f, .7f}));
  const MaterialDescription glass = read_material("Ni 2.5\nd 0.1\nTf 0.5 0.5 0.5\nillum 7\n").materials[0];
  EXPECT_EQ(glass.type, BDPT_MATERIAL_PRINCIPLED);
  EXPECT_EQ(glass.reflectance, (Rgb{.5f, .5f, .5f}));
  EXPECT_EQ(glass.principled.transmission.factor, 1);
  EXPECT_EQ(glass.ior, 2.5f);
  EXPECT_EQ(glass.alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(read_material("Ni 2.5\nillum 7\n").materials[0].type, BDPT_MATERIAL_DIELECTRIC);
  const MaterialDescription gloss = read_material("Kd 0.5 0.5 0.5\nKs 0.2 0.2 0.2\nNs 6\n").materials[0];
  EXPECT_EQ(gloss.type, BDPT_MATERIAL_PRINCIPLED);
  EXPECT_NEAR(gloss.principled.roughness.factor * gloss.principled.roughness.factor, std::sqrt(2 / 8.0), 1e-6);
  const MaterialDescription lamp = read_material("Ke 1 2 3\nTr 0\n").materials[0];
  EXPECT_EQ(lamp.emission, (Rgb{1, 2, 3}));
  EXPECT_EQ(read_material("d 0.25\n").materials[0].alpha.factor, 0.25f);
  EXPECT_EQ(read_material("Tr 0.25\n").materials[0].alpha.factor, 0.75f);
}

TEST_F(ToolObj, MapsAreReadWithTheirOptionsAndFromTheFolderOfTheMtl) {
  std::filesystem::create_directory(folder_.file("sub"));
  const float pixels[] = {1, 0, 0};
  ASSERT_EQ(bdpt_image_write_png(folder_.file("sub/a b.png").c_str(), pixels, 1, 1), BDPT_OK);
  write("sub/m.mtl", "newmtl m\nmap_Kd a b.png\nmap_d a b.png\nbump -bm 0.5 -clamp on a b.png\nnorm a b.png\n");
  const SceneDescription scene = read("mtllib sub/m.mtl\n" + std::string(kCorners) + "usemtl m\nf 1 2 3\n");
  const MaterialDescription& m = scene.materials.at(0);
  EXPECT_EQ(m.bump.factor, 0.5f);
  EXPECT_EQ(m.alpha_mode, AlphaMode::kBlend);
  ASSERT_EQ(scene.textures.size(), 2u);  // as colours and as numbers
  EXPECT_EQ(scene.textures[static_cast<std::size_t>(m.reflectance_texture.texture)].exponent, 0);
  EXPECT_EQ(scene.textures[static_cast<std::size_t>(m.normal.texture.texture)].exponent, 1);
}

TEST_F(ToolObj, MissingFilesOfMaterialsAreAWarningMissingTexturesAnError) {
  EXPECT_EQ(read("mtllib no.mtl\n" + std::string(kCorners) + "usemtl m\nf 1 2 3\n").materials.at(0).label, "grey");
  EXPECT_TRUE(warned("the file of materials is not there, and its materials become grey: 'no.mtl'"));
  write("m.mtl", "newmtl m\nmap_Kd no.png\n");
  EXPECT_EQ(error_of("mtllib m.mtl\n").substr(0, 21), "m.mtl:2: cannot read ");
}

TEST_F(ToolObj, MistakesAreErrorsWithTheirLine) {
  const std::string v = kCorners;
  EXPECT_EQ(error_of(v + "f 1 2 4\n"), "scene.obj:4: '4': there is no v 4, there are 3 before this line");
  EXPECT_EQ(error_of(v + "f 1 2 0\n"), "scene.obj:4: '0': there is no v 0, there are 3 before this line");
  EXPECT_EQ(error_of(v + "f -4 2 3\n"), "scene.obj:4: '-4': there is no v -4, there are 3 before this line");
  EXPECT_EQ(error_of(v + "f 1/1 2/1 3/1\n"), "scene.obj:4: '1/1': there is no vt 1, there are 0 before this line");
  EXPECT_EQ(error_of(v + "f 1 2\n"), "scene.obj:4: a face needs three corners");
  EXPECT_EQ(error_of(v + "f 1/2/3/4 2 3\n"), "scene.obj:4: '1/2/3/4': there is no vt 2, there are 0 before this line");
  EXPECT_EQ(error_of(v + "f a b c\n"), "scene.obj:4: 'a' is no corner of a face");
  EXPECT_EQ(error_of("v 1 2\n"), "scene.obj:1: 'v' needs 3 numbers");
  EXPECT_EQ(error_of("v 1 2 3.1+e2\n"), "scene.obj:1: expected a number, found '3.1+e2'");
  EXPECT_EQ(error_of("v 1 2 nan\n"), "scene.obj:1: 'nan' is not finite");
  EXPECT_EQ(error_of("v 1 2 1e99\n"), "scene.obj:1: expected a number, found '1e99'");
  EXPECT_EQ(error_of("\nnonsense\n"), "scene.obj:2: unknown statement 'nonsense'");
  EXPECT_EQ(error_of(v), "scene.obj: there are no faces in it; it needs a mesh");
  EXPECT_EQ(error_of(std::string("v 0\0 0", 6)),
            "scene.obj: this is no text; it is damaged, or of another format than its name says");
  write("m.mtl", "Kd 1 1 1\n");
  EXPECT_EQ(error_of("mtllib m.mtl\n"), "m.mtl:1: 'Kd' before the first newmtl");
  write("m.mtl", "newmtl m\nd 2\n");
  EXPECT_EQ(error_of("mtllib m.mtl\n"), "m.mtl:1: d and Tr must be between 0 and 1");
}

}  // namespace bdpt_tool::tool_obj_test
