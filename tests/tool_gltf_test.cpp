// The glTF reader of the program: what files come to, that errors name the property, and that nothing is left out
// without a word.
//
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>

#include "gltf/scene_reader.h"
#include "gltf_writer.h"
#include "scene_upload.h"
#include "temp_folder.h"
#include "transform.h"

namespace bdpt_tool {
namespace {

using Floats = std::vector<float>;
using Words = std::vector<std::uint32_t>;

const Floats kCorners = {0, 0, 0, 1, 0, 0, 0, 1, 0};

class ToolGltf : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.file(name), std::ios::binary) << text;
  }

  // A document of these members, besides the asset.
  SceneDescription read_document(const std::string& members) {
    write("scene.gltf", "{\"asset\":{\"version\":\"2.0\"}," + members + "}");
    return read_scene(folder_.file("scene.gltf"), diagnostics_);
  }

  // A scene of nodes, and what else belongs to it.
  std::string scene_of(const std::string& nodes, const std::string& more = "") {
    std::string text = "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[" + nodes + "]," + buffer_.members();
    return more.empty() ? text : text + "," + more;
  }
  SceneDescription read_nodes(const std::string& nodes, const std::string& more = "") {
    return read_document(scene_of(nodes, more));
  }

  // One node with one mesh of one primitive of these members.
  std::string mesh_of(const std::string& primitive) { return "\"meshes\":[{\"primitives\":[{" + primitive + "}]}]"; }
  SceneDescription read_primitive(const std::string& primitive, const std::string& more = "") {
    return read_nodes("{\"mesh\":0}", mesh_of(primitive) + (more.empty() ? "" : "," + more));
  }

  // A triangle in the mesh 0, for tests of other things.
  std::string triangle(const std::string& more = "") {
    const int positions = buffer_.add("VEC3", kCorners);
    return "\"attributes\":{\"POSITION\":" + std::to_string(positions) + more + "}";
  }
  SceneDescription read_material(const std::string& material, const std::string& more = "") {
    return read_primitive(triangle() + ",\"material\":0", "\"materials\":[{" + material + "}]" + more);
  }

  const TriangleMesh& mesh(const SceneDescription& scene, std::size_t shape = 0) {
    return std::get<TriangleMesh>(scene.shapes.at(shape).geometry);
  }

  std::string error_of(const std::string& members) {
    try {
      read_document(members);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kInput);
      return without_folder(error.what());
    }
    return "no error";
  }
  std::string without_folder(std::string message) const {
    const std::string prefix = folder_.path().string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) {
      message.erase(at, prefix.size());
    }
    return message;
  }

  std::size_t notes_with(const std::string& part) const {
    std::size_t count = 0;
    for (const std::string& text : diagnostics_.texts()) count += text.find(part) != std::string::npos;
    return count;
  }
  std::string notes() const {
    std::string all;
    for (const std::string& text : diagnostics_.texts()) all += text + "\n";
    return all;
  }

  bdpt::TempFolder folder_;
  Diagnostics diagnostics_{false};
  GltfBuffer buffer_;
};

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << text << "' lacks '" << part << "'";
}

Vec3 transformed(const std::array<float, 12>& m, const Vec3& p, double w) {
  Vec3 result;
  for (int i = 0; i < 3; ++i)
    result[i] = m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3] * w;
  return result;
}

void expect_near(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5) << i;
}

void expect_near(const Floats& a, const Floats& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5) << i;
}

// Meshes

TEST_F(ToolGltf, WithoutIndicesVerticesComeInTheirOrder) {
  const SceneDescription scene = read_primitive(triangle());
  EXPECT_EQ(mesh(scene).positions, kCorners);
  EXPECT_EQ(mesh(scene).indices, (Words{0, 1, 2}));
  EXPECT_TRUE(mesh(scene).normals.empty());
  EXPECT_TRUE(mesh(scene).uv.empty());
  EXPECT_EQ(scene.instances.size(), 1u);
}

TEST_F(ToolGltf, IndicesMayBeOfEightSixteenOrThirtyTwoBits) {
  const std::string attributes = triangle();
  const int bytes = buffer_.add("SCALAR", std::vector<std::uint8_t>{2, 1, 0});
  const int shorts = buffer_.add("SCALAR", std::vector<std::uint16_t>{2, 1, 0});
  const int words = buffer_.add("SCALAR", Words{2, 1, 0});
  for (const int indices : {bytes, shorts, words}) {
    const SceneDescription scene = read_primitive(attributes + ",\"indices\":" + std::to_string(indices));
    EXPECT_EQ(mesh(scene).indices, (Words{2, 1, 0}));
  }
}

TEST_F(ToolGltf, StripsAndFansAreWoundAsTheFormatSays) {
  const int positions = buffer_.add("VEC3", Floats{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  const std::string attributes = "\"attributes\":{\"POSITION\":" + std::to_string(positions) + "}";
  EXPECT_EQ(mesh(read_primitive(attributes + ",\"mode\":5")).indices, (Words{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(mesh(read_primitive(attributes + ",\"mode\":6")).indices, (Words{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST_F(ToolGltf, PointsAndLinesAreLeftOutAndToldOfOnce) {
  const std::string attributes = triangle();
  std::string primitives = "{" + attributes + "}";
  for (int mode = 0; mode < 4; ++mode) primitives += ",{" + attributes + ",\"mode\":" + std::to_string(mode) + "}";
  const SceneDescription scene =
      read_nodes("{\"mesh\":0,\"name\":\"n\"}", "\"meshes\":[{\"primitives\":[" + primitives + "]}]");
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].label, "n/0");
  EXPECT_EQ(notes_with("points and lines are left out: meshes[0].primitives[1] and 3 more"), 1u) << notes();
}

TEST_F(ToolGltf, SparseAccessorsReplaceElements) {
  const int indices = buffer_.add_bytes(std::string("\1\0\2\0", 4));
  const Floats replaced = {5, 6, 7, 8, 9, 10};
  const int values = buffer_.add_bytes(std::string(reinterpret_cast<const char*>(replaced.data()), 24));
  const std::string sparse = "\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":" + std::to_string(indices) +
                             ",\"componentType\":5123},\"values\":{\"bufferView\":" + std::to_string(values) + "}}";
  const int with_base = buffer_.add("VEC3", kCorners, sparse);
  const int without = buffer_.describe("\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"," + sparse);
  const auto read = [&](int accessor) {
    return mesh(read_primitive("\"attributes\":{\"POSITION\":" + std::to_string(accessor) + "}")).positions;
  };
  EXPECT_EQ(read(with_base), (Floats{0, 0, 0, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(read(without), (Floats{0, 0, 0, 5, 6, 7, 8, 9, 10}));
}

TEST_F(ToolGltf, AttributesMayBeInterleaved) {
  const Floats both = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0};
  const int view =
      buffer_.add_bytes(std::string(reinterpret_cast<const char*>(both.data()), both.size() * 4), "\"byteStride\":24");
  const std::string accessor = "\"bufferView\":" + std::to_string(view) +
                               ",\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"byteOffset\":";
  buffer_.describe(accessor + "0");
  buffer_.describe(accessor + "12");
  const SceneDescription scene = read_primitive("\"attributes\":{\"POSITION\":0,\"NORMAL\":1}");
  EXPECT_EQ(mesh(scene).positions, kCorners);
  EXPECT_EQ(mesh(scene).normals, (Floats{0, 0, 1, 0, 1, 0, 1, 0, 0}));
}

TEST_F(ToolGltf, NormalisedIntegersAreScaledAndOthersAreNot) {
  buffer_.add("VEC3", std::vector<std::int16_t>{0, 0, 0, 100, 0, 0, 0, -100, 0});
  buffer_.add("VEC2", std::vector<std::uint8_t>{0, 255, 51, 0, 102, 153}, "\"normalized\":true");
  buffer_.add("VEC2", std::vector<std::uint16_t>{0, 65535, 13107, 0, 26214, 39321}, "\"normalized\":true");
  buffer_.add("VEC3", std::vector<std::int8_t>{127, -127, -128, 0, 0, 127, 0, 127, 0}, "\"normalized\":true");
  const SceneDescription scene =
      read_primitive("\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,\"TEXCOORD_1\":2,\"NORMAL\":3}");
  EXPECT_EQ(mesh(scene).positions, (Floats{0, 0, 0, 100, 0, 0, 0, -100, 0}));
  expect_near(mesh(scene).uv, {0, 0, .2f, 1, .4f, .4f});
  expect_near(mesh(scene).uv_lightmap, {0, 0, .2f, 1, .4f, .4f});
  expect_near(mesh(scene).normals, {1, -1, -1, 0, 0, 1, 0, 1, 0});
}

TEST_F(ToolGltf, InBothSetsTheTopOfAnImageIsWhereVIsOne) {
  const std::string attributes = triangle(",\"TEXCOORD_0\":1,\"TEXCOORD_1\":2");
  buffer_.add("VEC2", Floats{0, 0, 1, .25f, .5f, 1});
  buffer_.add("VEC2", Floats{.5f, .125f, 1, 1, 0, 0});
  const SceneDescription scene = read_primitive(attributes);
  EXPECT_EQ(mesh(scene).uv, (Floats{0, 1, 1, .75f, .5f, 0}));
  EXPECT_EQ(mesh(scene).uv_lightmap, (Floats{.5f, .875f, 1, 0, 0, 1}));
}

TEST_F(ToolGltf, NormalsOfLengthZeroAreMadeFromTheTriangles) {
  const std::string attributes = triangle(",\"NORMAL\":1");
  buffer_.add("VEC3", Floats{0, 0, 0, 0, 0, 1, 0, 0, 1});
  EXPECT_EQ(mesh(read_primitive(attributes)).normals, (Floats{0, 0, 1, 0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(notes_with("normals of length zero"), 1u);
}

// Nodes

TEST_F(ToolGltf, NodesTranslateRotateAndScaleInThisOrderFromTheirParentOn) {
  const double h = std::sqrt(.5);
  const std::string z90 = "[0,0," + std::to_string(h) + "," + std::to_string(h) + "]";
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene = read_nodes(
      "{\"children\":[1],\"translation\":[10,0,0]},"
      "{\"mesh\":0,\"translation\":[1,2,3],\"rotation\":" +
          z90 + ",\"scale\":[2,3,4]}",
      mesh_text);
  expect_near(transformed(scene.instances[0].transform, {1, 1, 1}, 1), {11 - 3, 2 + 2, 3 + 4});
}

TEST_F(ToolGltf, MatricesAreListedByColumns) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene = read_nodes("{\"mesh\":0,\"matrix\":[0,1,0,0,-1,0,0,0,0,0,1,0,5,6,7,1]}", mesh_text);
  expect_near(transformed(scene.instances[0].transform, {1, 0, 0}, 1), {5, 7, 7});
}

TEST_F(ToolGltf, NodesShareTheShapesOfAMeshAndGiveTheirNames) {
  const std::string attributes = triangle();
  const SceneDescription scene =
      read_nodes("{\"children\":[1,2,3]},{\"mesh\":0,\"name\":\"left\"},{\"mesh\":0,\"name\":\"right\"},{\"mesh\":1}",
                 "\"meshes\":[{\"name\":\"wall\",\"primitives\":[{" + attributes + "},{" + attributes +
                     "}]},{\"primitives\":[{" + attributes + "}]}]");
  EXPECT_EQ(scene.shapes.size(), 3u);
  EXPECT_EQ(scene.shapes[1].label, "wall");
  std::vector<std::string> labels;
  for (const InstanceDescription& instance : scene.instances) labels.push_back(instance.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"left/0", "left/1", "right/0", "right/1", "nodes[3]"}));
  EXPECT_EQ(scene.instances[0].shape, scene.instances[2].shape);
}

TEST_F(ToolGltf, GpuInstancingMakesCopiesOfANode) {
  const std::string mesh_text = mesh_of(triangle());
  const int translation = buffer_.add("VEC3", Floats{1, 0, 0, 0, 2, 0});
  const int scale = buffer_.add("VEC3", Floats{1, 1, 1, 3, 3, 3});
  const std::string node =
      "{\"mesh\":0,\"name\":\"tree\",\"translation\":[0,0,5],\"extensions\":{\"EXT_mesh_gpu_instancing\":{"
      "\"attributes\":{\"TRANSLATION\":" +
      std::to_string(translation) + ",\"SCALE\":" + std::to_string(scale) + "}}}}";
  const SceneDescription scene = read_nodes(node, mesh_text);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].label, "tree[1]");
  EXPECT_EQ(scene.shapes.size(), 1u);
  expect_near(transformed(scene.instances[0].transform, {1, 1, 1}, 1), {2, 1, 6});
  expect_near(transformed(scene.instances[1].transform, {1, 1, 1}, 1), {3, 5, 8});
}

TEST_F(ToolGltf, TheDefaultSceneIsReadAndTheOthersAreToldOf) {
  const std::string mesh_text = mesh_of(triangle());
  const std::string more = "\"nodes\":[{\"mesh\":0,\"name\":\"a\"},{\"mesh\":0,\"name\":\"b\"}]," + mesh_text + "," +
                           buffer_.members() + ",\"scenes\":[{\"nodes\":[0]},{\"nodes\":[1]}]";
  EXPECT_EQ(read_document(more).instances.at(0).label, "a");
  EXPECT_EQ(read_document(more + ",\"scene\":1").instances.at(0).label, "b");
  EXPECT_EQ(notes_with("one scene of 2 is read"), 1u);
}

TEST_F(ToolGltf, WhatIsScaledToNothingIsLeftOut) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene = read_nodes("{\"mesh\":0,\"children\":[1]},{\"mesh\":0,\"scale\":[1,0,1]}", mesh_text);
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(notes_with("what is scaled to nothing is left out: nodes[1]"), 1u);
}

TEST_F(ToolGltf, ANodeHasOneParentAndIsNotItsOwnAncestor) {
  const std::string mesh_text = mesh_of(triangle());
  const auto error = [&](const std::string& nodes) { return error_of(scene_of(nodes, mesh_text)); };
  EXPECT_EQ(error("{\"children\":[1,2]},{\"children\":[3]},{\"children\":[3],\"name\":\"b\"},{\"mesh\":0}"),
            "scene.gltf: nodes[3] is a child of nodes[1] and of nodes[2] 'b'; it may have one parent");
  EXPECT_EQ(error("{\"children\":[1,1]},{\"mesh\":0}"),
            "scene.gltf: nodes[1] is a child of nodes[0] and of nodes[0]; it may have one parent");
  EXPECT_EQ(error("{\"children\":[1]},{\"children\":[0]}"), "scene.gltf: nodes[0] is its own ancestor");
  EXPECT_EQ(error("{\"children\":[0]}"), "scene.gltf: nodes[0] is its own ancestor");
  EXPECT_EQ(error("{\"mesh\":0},{\"children\":[2]},{\"children\":[1]}"), "scene.gltf: nodes[1] is its own ancestor");
  EXPECT_EQ(error("{\"mesh\":0},{\"children\":[0]}"),
            "scene.gltf: nodes[0] is a root of the scene and a child of nodes[1]");
}

TEST_F(ToolGltf, DeepTreesAreNoDangerToTheStack) {
  std::string nodes;
  const int depth = 100000;
  for (int i = 0; i < depth; ++i) nodes += "{\"children\":[" + std::to_string(i + 1) + "]},";
  const std::string mesh_text = mesh_of(triangle());
  EXPECT_EQ(read_nodes(nodes + "{\"mesh\":0}", mesh_text).instances.size(), 1u);
}

// Materials

TEST_F(ToolGltf, WhatIsNoMetalIsDiffuseOfItsBaseColour) {
  const SceneDescription scene = read_material(
      "\"name\":\"Wall\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.25,0.5,1,1],\"metallicFactor\":0}");
  const MaterialDescription& material = scene.materials.at(0);
  EXPECT_EQ(material.type, BDPT_MATERIAL_DIFFUSE);
  EXPECT_EQ(material.label, "Wall");
  EXPECT_EQ(material.reflectance, (Rgb{.25f, .5f, 1}));
  EXPECT_TRUE(material.one_sided);
  EXPECT_EQ(notes_with("without the gloss on top: materials[0] 'Wall'"), 1u) << notes();
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

TEST_F(ToolGltf, AMetalIsAConductorThatReflectsItsBaseColour) {
  const SceneDescription scene =
      read_material("\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.9,0.5,0,1],\"roughnessFactor\":0.5}");
  const MaterialDescription& material = scene.materials.at(0);
  ASSERT_EQ(material.type, BDPT_MATERIAL_CONDUCTOR);
  for (std::size_t c = 0; c < 3; ++c) {
    const double eta = material.eta[c], k = material.k[c];
    const double reflectance = ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
    EXPECT_NEAR(reflectance, (Rgb{.9f, .5f, 0})[c], 1e-5);
  }
  EXPECT_EQ(material.roughness, (std::array<float, 2>{.25f, .25f}));
  EXPECT_EQ(diagnostics_.count(), 1u) << notes();  // of the camera
}

TEST_F(ToolGltf, WithoutAMaterialAPrimitiveHasTheDefaultOneWhichIsARoughMetal) {
  const SceneDescription scene = read_primitive(triangle());
  EXPECT_EQ(scene.materials.at(0).type, BDPT_MATERIAL_CONDUCTOR);
  EXPECT_EQ(scene.materials.at(0).roughness, (std::array<float, 2>{1, 1}));
}

TEST_F(ToolGltf, HalfMetalsAreDiffuseAndToldOf) {
  const SceneDescription scene = read_material("\"pbrMetallicRoughness\":{\"metallicFactor\":0.5}");
  EXPECT_EQ(scene.materials.at(0).type, BDPT_MATERIAL_DIFFUSE);
  EXPECT_EQ(notes_with("half metals, are taken as diffuse"), 1u);
}

TEST_F(ToolGltf, TransmissionMakesGlassOfTheIndexGiven) {
  const std::string transmission = "\"KHR_materials_transmission\":{\"transmissionFactor\":1}";
  const MaterialDescription plain = read_material("\"extensions\":{" + transmission + "}").materials.at(0);
  EXPECT_EQ(plain.type, BDPT_MATERIAL_DIELECTRIC);
  EXPECT_FLOAT_EQ(plain.ior, 1.5f);
  EXPECT_FALSE(plain.one_sided);
  EXPECT_EQ(notes_with("thin-walled"), 1u);
  const MaterialDescription diamond =
      read_material("\"pbrMetallicRoughness\":{\"roughnessFactor\":0},\"extensions\":{" + transmission +
                    ",\"KHR_materials_ior\":{\"ior\":2.4},\"KHR_materials_volume\":{\"thicknessFactor\":1}}")
          .materials.at(0);
  EXPECT_FLOAT_EQ(diamond.ior, 2.4f);
  EXPECT_EQ(diamond.roughness, (std::array<float, 2>{0, 0}));
}

TEST_F(ToolGltf, MaterialsAreConvertedOnceAndOnlyWhenUsed) {
  const std::string attributes = triangle();
  const SceneDescription scene = read_nodes(
      "{\"mesh\":0}", "\"meshes\":[{\"primitives\":[{" + attributes + ",\"material\":1},{" + attributes +
                          ",\"material\":1}]}],\"materials\":[{\"name\":\"unused\",\"normalTexture\":{\"index\":0}},"
                          "{\"name\":\"used\"}],\"textures\":[{}]");
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].label, "used");
  EXPECT_EQ(notes_with("normal maps"), 0u);
}

// Textures

class ToolGltfTexture : public ToolGltf {
 protected:
  // The bytes of a PNG of two texels in a row.
  std::string png(const Floats& display_values) {
    EXPECT_EQ(bdpt_image_write_png(folder_.file("two.png").c_str(), display_values.data(), 2, 1), BDPT_OK);
    std::ifstream file(folder_.file("two.png"), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string image_uri(const std::string& bytes) {
    return "{\"uri\":\"data:image/png;base64," + base64(bytes) + "\"}";
  }
  SceneDescription read_textured(const std::string& material, const std::string& image,
                                 const std::string& samplers = "", const std::string& texture = "\"source\":0") {
    const std::string attributes = triangle(",\"TEXCOORD_0\":1,\"TEXCOORD_1\":2");
    buffer_.add("VEC2", Floats{0, 0, .25f, 0, 0, .5f});
    buffer_.add("VEC2", Floats{1, 1, 0, 0, .5f, .5f});
    return read_primitive(attributes + ",\"material\":0", "\"materials\":[{" + material + "}],\"textures\":[{" +
                                                              texture + "}],\"images\":[" + image + "]" + samplers);
  }
  std::string base_color(const std::string& factor, const std::string& more = "") {
    return "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":" + factor +
           ",\"baseColorTexture\":{\"index\":0" + more + "}}";
  }

  const Floats kTwo = {1, 0, .5f, 0, 1, 1};
};

TEST_F(ToolGltfTexture, ABaseColourTextureKeepsItsBytesWhereTheFactorIsWhite) {
  const SceneDescription scene = read_textured(base_color("[1,1,1,1]"), image_uri(png(kTwo)));
  ASSERT_EQ(scene.materials.at(0).texture, 0);
  const auto& image = std::get<ByteImage>(scene.textures.at(0).image);
  EXPECT_EQ(image.pixels, (std::vector<std::uint8_t>{255, 0, 128, 0, 255, 255}));
}

TEST_F(ToolGltfTexture, AFactorMultipliesTheTexelsInLinearSpace) {
  const SceneDescription scene = read_textured(base_color("[0.5,1,0.25,1]"), image_uri(png(kTwo)));
  const auto& image = std::get<Image>(scene.textures.at(0).image);
  expect_near(image.pixels, {.5f, 0, .25f * srgb_to_linear(128 / 255.0f), 0, 1, .25f});
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

TEST_F(ToolGltfTexture, TheMeshHasTheUvOfItsTexture) {
  const SceneDescription second = read_textured(base_color("[1,1,1,1]", ",\"texCoord\":1"), image_uri(png(kTwo)));
  EXPECT_EQ(mesh(second).uv, (Floats{1, 0, 0, 1, .5f, .5f}));
  buffer_ = GltfBuffer();
  const SceneDescription moved =
      read_textured(base_color("[1,1,1,1]",
                               ",\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0.25],\"scale\":[2,1],"
                               "\"rotation\":1.5707963267948966}}"),
                    image_uri(png(kTwo)));
  // (u, v) becomes (v + 0.5, 0.25 - 2 u), then v is turned up.
  expect_near(mesh(moved).uv, {.5f, .75f, .5f, 1.25f, 1, .75f});
  EXPECT_EQ(mesh(moved).uv_lightmap, (Floats{1, 0, 0, 1, .5f, .5f}));
}

TEST_F(ToolGltfTexture, AnEmissionTextureBecomesItsMean) {
  const SceneDescription scene = read_textured(
      "\"emissiveFactor\":[1,1,0.5],\"emissiveTexture\":{\"index\":0},\"extensions\":{"
      "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":4}}",
      image_uri(png(kTwo)));
  const Rgb& emission = scene.materials.at(0).emission;
  expect_near(Floats(emission.begin(), emission.end()), {2, 2, srgb_to_linear(128 / 255.0f) + 1});
  EXPECT_EQ(notes_with("a texture of emission becomes its mean"), 1u);
}

TEST_F(ToolGltfTexture, OtherSamplersAreToldOf) {
  read_textured(base_color("[1,1,1,1]"), image_uri(png(kTwo)), ",\"samplers\":[{\"wrapS\":33071,\"magFilter\":9728}]",
                "\"source\":0,\"sampler\":0");
  EXPECT_EQ(notes_with("neither clamped nor mirrored"), 1u);
  EXPECT_EQ(notes_with("filtered bilinearly"), 1u);
}

TEST_F(ToolGltfTexture, WhatIsNoPngOrJpegIsAnError) {
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), image_uri("GIF89a")), Error);
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), "{\"uri\":\"data:image/webp;base64,AAAA\"}"), Error);
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), "{\"uri\":\"none.png\"}"), Error);
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), image_uri(png(kTwo)), "", "\"name\":\"t\""), Error);
  EXPECT_THROW(read_textured(base_color("[1,1,1,1]"), image_uri(png(kTwo).substr(0, 40))), Error);
}

// Lights and cameras

class ToolGltfLight : public ToolGltf {
 protected:
  SceneDescription read_light(const std::string& light, const std::string& node = "") {
    const std::string mesh_text = mesh_of(triangle());
    return read_nodes(
        "{\"mesh\":0,\"children\":[1]},{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}" + node + "}",
        mesh_text + ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{" + light + "}]}}");
  }
};

TEST_F(ToolGltfLight, CandelaAreWattsPerSteradian) {
  const SceneDescription scene =
      read_light("\"type\":\"point\",\"color\":[1,0.5,0.25],\"intensity\":40,\"range\":3", ",\"translation\":[1,2,3]");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, BDPT_LIGHT_POINT);
  EXPECT_EQ(scene.lights[0].value, (Rgb{40, 20, 10}));
  EXPECT_EQ(scene.lights[0].position, (Rgb{1, 2, 3}));
  EXPECT_EQ(notes_with("the range of a light"), 1u);
}

TEST_F(ToolGltfLight, SpotsShineAlongMinusZBetweenTheirAngles) {
  const SceneDescription scene = read_light(
      "\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.3490658503988659,\"outerConeAngle\":0.5235987755982988}",
      ",\"rotation\":[0,1,0,0]");
  const LightDescription& spot = scene.lights.at(0);
  EXPECT_EQ(spot.type, BDPT_LIGHT_SPOT);
  expect_near({spot.direction[0], spot.direction[1], spot.direction[2]}, Vec3{0, 0, 1});
  EXPECT_NEAR(spot.cone_angle, 30, 1e-4);
  EXPECT_NEAR(spot.cone_falloff, 10, 1e-4);
}

TEST_F(ToolGltfLight, DirectionalLightsAreToldOf) {
  EXPECT_TRUE(read_light("\"type\":\"directional\",\"name\":\"sun\"").lights.empty());
  EXPECT_EQ(notes_with("directional lights are not known yet, and are left out: lights[0] 'sun'"), 1u);
}

TEST_F(ToolGltfLight, UnknownLightsAreAnError) {
  EXPECT_THROW(read_light("\"type\":\"area\""), Error);
  EXPECT_THROW(read_light("\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.5,\"outerConeAngle\":0.4}"), Error);
}

TEST_F(ToolGltf, ThePerspectiveCameraKeepsItsVerticalAngleForEveryShapeOfImage) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene =
      read_nodes("{\"mesh\":0,\"children\":[1]},{\"camera\":0,\"translation\":[1,2,3],\"scale\":[2,3,4]}",
                 mesh_text +
                     ",\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1.0471975511965976,"
                     "\"znear\":0.1,\"aspectRatio\":2}}]");
  EXPECT_EQ(scene.film.width, 1280u);
  EXPECT_EQ(scene.film.height, 640u);
  for (const std::uint32_t width : {50u, 100u, 300u}) {
    EXPECT_NEAR(camera_desc(scene, width, 100, diagnostics_).field_of_view, 60, 1e-4);
  }
  expect_near(transformed(scene.camera.transform, {0, 0, -1}, 1), {1, 2, 2});
  expect_near(transformed(scene.camera.transform, {1, 0, 0}, 0), {1, 0, 0});
  EXPECT_EQ(notes_with("camera"), 0u) << notes();
}

TEST_F(ToolGltf, OrthographicCamerasAreOnesOfTheirHeight) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene =
      read_nodes("{\"mesh\":0,\"camera\":0,\"scale\":[7,7,7]}",
                 mesh_text +
                     ",\"cameras\":[{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":3,\"ymag\":1.5,"
                     "\"znear\":0,\"zfar\":1}}]");
  EXPECT_EQ(notes_with("camera"), 0u) << notes();
  EXPECT_EQ(scene.film.height, 640u);
  const bdpt_camera_desc camera = camera_desc(scene, 200, 100, diagnostics_);
  EXPECT_EQ(camera.type, BDPT_CAMERA_ORTHOGRAPHIC);
  EXPECT_FLOAT_EQ(camera.field_height, 3);
  EXPECT_EQ(camera.field_of_view, 0);
}

TEST_F(ToolGltf, WithoutACameraAllIsInThePicture) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene = read_nodes(
      "{\"children\":[1,2]},{\"mesh\":0,\"translation\":[-30,4,5]},{\"mesh\":0,\"scale\":[1,50,1]}", mesh_text);
  for (const std::uint32_t width : {50u, 200u}) {
    const bdpt_camera_desc camera = camera_desc(scene, width, 100, diagnostics_);
    Transform to_world;
    for (int i = 0; i < 12; ++i) to_world.m[i / 4][i % 4] = camera.transform[i];
    EXPECT_NEAR(to_world.determinant(), 1, 1e-5);  // not mirrored
    const double tangent = std::tan(camera.field_of_view * M_PI / 360);
    for (const InstanceDescription& instance : scene.instances) {
      for (std::size_t v = 0; v < 9; v += 3) {
        const Vec3 p = to_world.inverse().point(
            transformed(instance.transform, {kCorners[v], kCorners[v + 1], kCorners[v + 2]}, 1));
        EXPECT_LT(p[2], 0);
        EXPECT_LT(std::abs(p[1]), -p[2] * tangent);
        EXPECT_LT(std::abs(p[0]), -p[2] * tangent * width / 100);
      }
    }
  }
}

// What is left out

TEST_F(ToolGltf, EveryKindOfThingThatIsLeftOutIsToldOfOnce) {
  const std::string attributes = triangle(",\"COLOR_0\":0") + ",\"targets\":[{\"POSITION\":0}]";
  const std::string material =
      "{\"normalTexture\":{\"index\":0},\"occlusionTexture\":{\"index\":0},\"alphaMode\":\"BLEND\","
      "\"pbrMetallicRoughness\":{\"metallicRoughnessTexture\":{\"index\":0}}}";
  const std::string unlit = "{\"extensions\":{\"KHR_materials_unlit\":{}}}";
  const SceneDescription scene = read_nodes(
      "{\"mesh\":0,\"skin\":0,\"children\":[1]},{\"mesh\":1,\"skin\":0}",
      "\"meshes\":[{\"primitives\":[{" + attributes + ",\"material\":0}]},{\"primitives\":[{" + attributes +
          ",\"material\":1},{" + attributes + ",\"material\":2}]}],\"materials\":[" + material + "," + material + "," +
          unlit +
          "],\"textures\":[{}],\"animations\":[{\"channels\":[],\"samplers\":[]}],\"skins\":[{\"joints\":[0],"
          "\"inverseBindMatrices\":0}],\"extensionsUsed\":[\"KHR_materials_variants\",\"KHR_materials_unlit\"]");
  EXPECT_EQ(scene.instances.size(), 3u);
  for (const char* kind :
       {"animations are left out", "skins are left out: meshes stay as they are at rest: nodes[0] and 1 more",
        "morph targets are left out: meshes stay as they are at rest: meshes[0].primitives[0] and 2 more",
        "colours of vertices", "normal maps are left out: materials[0] and 1 more", "occlusion maps",
        "alpha is left out", "metalness is a texture", "unlit materials are taken as diffuse: materials[2]",
        "the extension KHR_materials_variants is not known"}) {
    EXPECT_EQ(notes_with(kind), 1u) << kind << " in\n" << notes();
  }
}

// Damaged files

TEST_F(ToolGltf, PropertiesOfWrongTypesRangesAndIndicesAreNamed) {
  const std::string attributes = triangle();
  const std::string good = mesh_of(attributes);
  const std::pair<std::string, std::string> cases[] = {
      {scene_of("{\"mesh\":\"0\"}", good), "nodes[0].mesh must be an index"},
      {scene_of("{\"mesh\":1}", good), "nodes[0].mesh is 1, and meshes has 1 element"},
      {scene_of("{\"mesh\":-1}", good), "nodes[0].mesh is -1, and meshes has 1 element"},
      {scene_of("{\"mesh\":4294967296}", good), "nodes[0].mesh is 4294967296"},
      {scene_of("{\"mesh\":0,\"name\":7}", good), "nodes[0].name must be a string"},
      {scene_of("{\"mesh\":0,\"translation\":[1,2]}", good), "nodes[0].translation must be an array of 3 numbers"},
      {scene_of("{\"mesh\":0,\"scale\":[1,2,\"3\"]}", good), "nodes[0].scale[2] must be a number"},
      {scene_of("{\"mesh\":0,\"scale\":[1,2,1e99]}", good), "nodes[0].scale[2] is 1e+99, and must be a number that"},
      {scene_of("{\"mesh\":0,\"rotation\":[0,0,0,0]}", good), "nodes[0] has a rotation of length zero"},
      {scene_of("{\"mesh\":0,\"matrix\":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}", good), "last row is not 0 0 0 1"},
      {scene_of("{\"mesh\":0,\"children\":1}", good), "nodes[0].children must be an array"},
      {scene_of("{\"mesh\":0,\"scale\":[1e38,1e38,1e38],\"children\":[1]},{\"mesh\":0,\"scale\":[1e38,1,1]}", good),
       "nodes[1] has a transform that is not finite"},
      {scene_of("{\"mesh\":0}", "\"meshes\":{}"), "meshes must be an array"},
      {scene_of("{\"mesh\":0}", "\"meshes\":[{}]"), "meshes[0].primitives is missing"},
      {scene_of("{\"mesh\":0}", "\"meshes\":[{\"primitives\":[{}]}]"), "meshes[0].primitives[0].attributes is missing"},
      {scene_of("{\"mesh\":0}", mesh_of("\"attributes\":{\"POSITION\":9}")),
       "meshes[0].primitives[0].attributes.POSITION is 9, and accessors has 1 element"},
      {scene_of("{\"mesh\":0}", mesh_of(attributes + ",\"material\":0")), "materials has 0 elements"},
      {scene_of("{\"mesh\":0}", mesh_of(attributes + ",\"mode\":7")), "primitives[0].mode is 7"},
      {scene_of("{\"mesh\":0}", good + ",\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":2}}]"),
       "materials[0].pbrMetallicRoughness.metallicFactor is 2"},
      {scene_of("{\"mesh\":0}", good + ",\"materials\":[{\"pbrMetallicRoughness\":[]}]"),
       "materials[0].pbrMetallicRoughness must be an object"},
      {scene_of("{\"mesh\":0}", good + ",\"materials\":[{\"doubleSided\":1}]"), "doubleSided must be true or false"},
      {scene_of("{\"mesh\":0}", good + ",\"scene\":1"), "scene is 1, and scenes has 1 element"},
      {scene_of("{}", good), "the scene is empty"},
      {buffer_.members(), "there is no scene in it"},
  };
  for (const auto& [members, expected] : cases) expect_contains(error_of(members), expected);
}

TEST_F(ToolGltf, AccessorsThatLeaveTheirDataAreErrors) {
  const int view = buffer_.add_bytes(std::string(36, '\0'));
  const int other = buffer_.add_bytes(std::string("\7\0\0\0", 4));
  const std::string base = "\"componentType\":5126,\"type\":\"VEC3\",\"bufferView\":" + std::to_string(view);
  const auto error = [&](const std::string& accessor, const std::string& more = "") {
    const GltfBuffer saved = buffer_;
    const int index = buffer_.describe(accessor);
    const std::string text = error_of(
        scene_of("{\"mesh\":0}", mesh_of("\"attributes\":{\"POSITION\":" + std::to_string(index) + "}" + more)));
    buffer_ = saved;
    return text;
  };
  const int narrow = buffer_.add_bytes(std::string(36, '\0'), "\"byteStride\":8");
  expect_contains(
      error("\"componentType\":5126,\"type\":\"VEC3\",\"count\":2,\"bufferView\":" + std::to_string(narrow)),
      "accessors[0] has elements of 12 bytes in steps of fewer");
  EXPECT_EQ(error(base + ",\"count\":4"), "scene.gltf: accessors[0] ends at byte 48 of a view of 36");
  expect_contains(error(base + ",\"count\":3,\"byteOffset\":4"), "accessors[0] ends at byte 40 of a view of 36");
  expect_contains(error(base + ",\"count\":0"), "accessors[0].count is 0");
  expect_contains(error(base + ",\"count\":-3"), "accessors[0].count is -3");
  expect_contains(error(base + ",\"count\":3,\"byteOffset\":9007199254740992"), "of a view of 36");
  expect_contains(error("\"componentType\":5126,\"type\":\"VEC3\",\"count\":4000000000"),
                  "has no data for its 4000000000");
  expect_contains(error("\"componentType\":5124,\"type\":\"VEC3\",\"count\":3"), "unknown type 5124");
  expect_contains(error("\"componentType\":5126,\"type\":\"VEC5\",\"count\":3"), "VEC5");
  expect_contains(error("\"componentType\":5126,\"type\":\"VEC2\",\"count\":3"),
                  "POSITION: has 2 components, and must have 3");
  const std::string sparse =
      ",\"sparse\":{\"count\":1,\"indices\":{\"componentType\":5125,\"bufferView\":" + std::to_string(other) +
      "},\"values\":{\"bufferView\":" + std::to_string(view) + "}}";
  expect_contains(error(base + ",\"count\":3" + sparse), "replaces element 7 of 3");
  expect_contains(
      error(base + ",\"count\":3,\"sparse\":{\"count\":4,\"indices\":{\"componentType\":5125,\"bufferView\":" +
            std::to_string(other) + "},\"values\":{\"bufferView\":0}}"),
      "accessors[0].sparse.indices ends at byte 16 of a view of 4");
}

TEST_F(ToolGltf, AttributesAndIndicesMustFitThePositions) {
  const std::string attributes = triangle(",\"NORMAL\":1");
  buffer_.add("VEC3", Floats{0, 0, 1, 0, 0, 1});
  const int beyond = buffer_.add("SCALAR", Words{0, 1, 3});
  const int four = buffer_.add("SCALAR", Words{0, 1, 2, 0});
  const int floats = buffer_.add("SCALAR", Floats{0, 1, 2});
  buffer_.add("VEC3", Floats{0, 0, 0, 1, 0, 0, 0, std::nanf(""), 0});
  const auto error = [&](const std::string& primitive) {
    return error_of(scene_of("{\"mesh\":0}", mesh_of(primitive)));
  };
  const auto indexed = [&](int indices) {
    return error("\"attributes\":{\"POSITION\":0},\"indices\":" + std::to_string(indices));
  };
  expect_contains(error(attributes), "meshes[0].primitives[0]: NORMAL has 2 elements, POSITION has 3");
  expect_contains(indexed(beyond), "meshes[0].primitives[0]: vertex 3 does not exist, there are 3");
  expect_contains(indexed(four), "4 vertices make no whole number of triangles");
  expect_contains(indexed(floats), "indices: must be single unsigned integers");
  expect_contains(error("\"attributes\":{\"POSITION\":5}"), "POSITION: element 2 is not finite");
}

TEST_F(ToolGltf, ViewsMustLieInTheirBuffer) {
  buffer_.add("VEC3", kCorners);
  const std::string rest = ",\"scenes\":[{}]";
  expect_contains(error_of("\"buffers\":[{\"byteLength\":3,\"uri\":\"data:application/octet-stream;base64,AAAA\"}],"
                           "\"bufferViews\":[{\"buffer\":0,\"byteLength\":4}]" +
                           rest),
                  "bufferViews[0] ends at byte 4 of a buffer of 3");
  expect_contains(
      error_of("\"buffers\":[{\"byteLength\":4,\"uri\":\"data:application/octet-stream;base64,AAAA\"}]" + rest),
      "buffers[0].uri holds 3 bytes, and byteLength is 4");
  expect_contains(
      error_of("\"buffers\":[{\"byteLength\":3,\"uri\":\"data:application/octet-stream;base64,A!AA\"}]" + rest),
      "damaged glTF");
  expect_contains(error_of("\"buffers\":[{\"byteLength\":3,\"uri\":\"data:text/html,AAAA\"}]" + rest),
                  "buffers[0].uri must begin with data:application/octet-stream;base64");
  expect_contains(error_of("\"buffers\":[{\"byteLength\":3}]" + rest),
                  "buffers[0] has neither a uri nor the binary data");
  expect_contains(error_of("\"buffers\":[{\"uri\":\"a.bin\"}]" + rest), "buffers[0].byteLength is missing");
}

TEST_F(ToolGltf, BuffersMayBeFilesWithPercentEncodedNames) {
  const std::string mesh_text = mesh_of(triangle());
  const std::string text = "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]," + mesh_text + ",";
  write("a b+c.bin", buffer_.bytes() + "more");
  EXPECT_EQ(mesh(read_document(text + buffer_.members("a%20b+c.bin"))).positions, kCorners);
  write("short.bin", buffer_.bytes().substr(1));
  expect_contains(error_of(text + buffer_.members("short.bin")), "'short.bin' has 35 bytes of 36");
  expect_contains(error_of(text + buffer_.members("none.bin")), "scene.gltf: cannot read 'none.bin'");
  expect_contains(error_of(text + buffer_.members("")), "no error");
}

TEST_F(ToolGltf, WhatIsNotJsonIsAnErrorWithItsLine) {
  const auto error = [&](const std::string& text) {
    write("scene.gltf", text);
    try {
      read_scene(folder_.file("scene.gltf"), diagnostics_);
    } catch (const Error& e) {
      return without_folder(e.what());
    }
    return std::string("no error");
  };
  expect_contains(error("{\n\"asset\": }"), "scene.gltf:2: not valid JSON: syntax error");
  expect_contains(error(""), "not valid JSON");
  expect_contains(error("[]"), "its JSON must be an object");
  expect_contains(error("{\"a\":1e999}"), "not valid JSON: number overflow");
  expect_contains(error("{}"), "asset is missing");
  expect_contains(error("{\"asset\":{\"version\":\"1.0\"},\"buffers\":{}}"), "asset.version is 1.0");
  expect_contains(error("{\"asset\":{\"version\":\"1.0\"}}"), "asset.version is 1.0, and this program reads glTF 2.0");
  expect_contains(error("{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.1\"}}"), "is at least 2.1");
  expect_contains(
      error("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(100000, '[') + std::string(100000, ']') + "}"),
      "nested more than 64 deep");
  expect_contains(error("{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}"),
                  "extensionsRequired names KHR_draco_mesh_compression, which is not known");
}

TEST_F(ToolGltf, BracketsInStringsAreNoDepth) {
  const std::string mesh_text = mesh_of(triangle());
  const std::string name = R"(\"\\)" + std::string(100, '[');
  EXPECT_EQ(read_nodes("{\"mesh\":0,\"name\":\"" + name + "\"}", mesh_text).instances.at(0).label,
            "\"\\" + std::string(100, '['));
}

TEST_F(ToolGltf, GlbFilesHoldOneJsonAndOneBinaryChunk) {
  const std::string mesh_text = mesh_of(triangle());
  const std::string text = "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]," +
                           mesh_text + "," + buffer_.members("-") + "}";
  const std::string good = glb(text, buffer_.bytes());
  const auto read = [&](const std::string& bytes) {
    write("scene.glb", bytes);
    return read_scene(folder_.file("scene.glb"), diagnostics_);
  };
  const auto error = [&](const std::string& bytes) {
    try {
      read(bytes);
    } catch (const Error& e) {
      return without_folder(e.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(mesh(read(good)).positions, kCorners);
  EXPECT_EQ(error("{}"), "scene.glb: damaged GLB: its 2 bytes hold no header");
  expect_contains(error(std::string(20, 'x')), "it does not begin with 'glTF'");
  expect_contains(error(good + "x"), "its header tells of");
  expect_contains(error(glb(text, "")), "buffers[0] has neither a uri nor the binary data of a GLB");
  std::string version = good;
  version[4] = 1;
  expect_contains(error(version), "it is of version 1");
  std::string chunk = good;
  chunk[15] = 1;
  expect_contains(error(chunk), "the chunk at byte 12 has");
  std::string kind = good;
  kind[16] = 'X';
  expect_contains(error(kind), "the first chunk must hold JSON");
  for (std::size_t size = 0; size < good.size(); ++size) EXPECT_NE(error(good.substr(0, size)), "no error") << size;
}

// Every file with one byte changed is read or refused, and nothing else happens.
TEST_F(ToolGltf, AnyChangedByteIsReadOrRefused) {
  const std::string attributes = triangle(",\"NORMAL\":1");
  buffer_.add("VEC3", Floats{0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int indices = buffer_.add("SCALAR", std::vector<std::uint16_t>{0, 1, 2});
  const std::string text =
      "{\"asset\":{\"version\":\"2.0\"}," +
      scene_of("{\"mesh\":0,\"rotation\":[0,0,0,1]}",
               mesh_of(attributes + ",\"indices\":" + std::to_string(indices) + ",\"material\":0") +
                   ",\"materials\":[{\"emissiveFactor\":[1,1,1]}]") +
      "}";
  std::size_t refused = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const char c : {'9', '"', '[', '\xFF'}) {
      std::string changed = text;
      changed[at] = c;
      write("scene.gltf", changed);
      try {
        read_scene(folder_.file("scene.gltf"), diagnostics_);
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, text.size());
}

// To the library

TEST_F(ToolGltf, LabelsAndTheLightmapsUvReachTheLibrary) {
  const Context context = make_context(1, diagnostics_);
  const auto error = [&](SceneDescription scene) {
    try {
      build_scene(context.get(), scene);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  SceneDescription scene = read_nodes("{\"mesh\":0,\"name\":\"Lamp\"}", mesh_of(triangle()));
  EXPECT_EQ(error(scene), "no error");
  SceneDescription wrong_uv = scene;
  std::get<TriangleMesh>(wrong_uv.shapes[0].geometry).uv_lightmap = {0, 0};
  expect_contains(error(wrong_uv), "uv[1]");
  SceneDescription singular = scene;
  singular.instances[0].transform = {1};
  expect_contains(error(singular), "Lamp");
}

TEST_F(ToolGltf, OneSidedMaterialsReachTheLibrary) {
  const Context context = make_context(1, diagnostics_);
  const SceneDescription scene = read_material("\"pbrMetallicRoughness\":{\"metallicFactor\":0}");
  const auto hash = [&](bool one_sided) {
    SceneDescription copy = scene;
    copy.materials.at(0).one_sided = one_sided;
    const Scene built = build_scene(context.get(), copy);
    auto info = sized<bdpt_scene_info>();
    check(bdpt_scene_get_info(built.get(), &info), "the scene");
    return info.hash;
  };
  EXPECT_NE(hash(false), hash(true));
}

// Files from elsewhere

TEST_F(ToolGltf, SharedDamagedFilesAreRefusedWithAReason) {
  const std::filesystem::path folder = std::filesystem::path(BDPT_SHARED_DIR) / "scenes/importer-edge";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the shared scenes are not here";
  std::size_t files = 0;
  for (const char* kind : {"gltf-bad", "glb-bad"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / kind)) {
      const auto extension = entry.path().extension();
      if (extension != ".gltf" && extension != ".glb") continue;
      ++files;
      if (entry.path().filename() == "BoxBadNormals.glb") {
        EXPECT_NO_THROW(read_scene(entry.path().string(), diagnostics_));
        continue;
      }
      try {
        read_scene(entry.path().string(), diagnostics_);
        ADD_FAILURE() << entry.path() << " was read";
      } catch (const Error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(entry.path().string() + ":")) << error.what();
      }
    }
  }
  EXPECT_EQ(files, 39u);
}

TEST_F(ToolGltf, SharedModelsAreRead) {
  const std::filesystem::path folder = std::filesystem::path(BDPT_SHARED_DIR) / "scenes/gltf";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the shared scenes are not here";
  std::size_t models = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".gltf" && extension != ".glb") continue;
    ++models;
    EXPECT_NO_THROW(read_scene(entry.path().string(), diagnostics_)) << entry.path();
  }
  EXPECT_EQ(models, 28u);
}

TEST_F(ToolGltf, SharedCornellBoxHasUvForLightmapsOnEveryMesh) {
  const std::filesystem::path file =
      std::filesystem::path(BDPT_SHARED_DIR) / "scenes/lightmap/bevy-cornell/CornellBox.glb";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared scenes are not here";
  const SceneDescription scene = read_scene(file.string(), diagnostics_);
  std::vector<std::string> labels;
  std::size_t triangles = 0;
  for (const InstanceDescription& instance : scene.instances) {
    labels.push_back(instance.label);
    const TriangleMesh& shape = mesh(scene, static_cast<std::size_t>(instance.shape));
    EXPECT_EQ(shape.uv_lightmap.size(), 2 * shape.vertex_count()) << instance.label;
    triangles += shape.triangle_count();
  }
  EXPECT_EQ(labels, (std::vector<std::string>{"Light", "large.box", "small.box", "cornell.box/0", "cornell.box/1",
                                              "cornell.box/2"}));
  EXPECT_EQ(triangles, 36u);
  EXPECT_EQ(scene.materials.at(0).emission, (Rgb{100, 100, 100}));
}

}  // namespace
}  // namespace bdpt_tool
