// Meshes of glTF: vertices, indices, strips, sparse accessors, morph targets, skins.
//
// SPDX-License-Identifier: Apache-2.0
#include "gltf_fixture.h"

namespace bdpt_tool::tool_gltf_mesh_test {

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

TEST_F(ToolGltf, PrimitivesOfTheSameAccessorsAreOneShape) {
  const std::string attributes = triangle();
  const std::string again = triangle();
  const SceneDescription scene = read_nodes(
      "{\"mesh\":0}", "\"meshes\":[{\"primitives\":[{" + attributes + ",\"material\":0},{" + attributes +
                          ",\"material\":1},{" + again + "},{" + attributes + ",\"mode\":6}]}],\"materials\":[{},{}]");
  ASSERT_EQ(scene.instances.size(), 4u);
  EXPECT_EQ(scene.shapes.size(), 3u);
  EXPECT_EQ(scene.instances[0].shape, scene.instances[1].shape);
  EXPECT_NE(scene.instances[0].material, scene.instances[1].material);
  EXPECT_NE(scene.instances[0].shape, scene.instances[3].shape);
}

TEST_F(ToolGltf, ColoursOfVerticesAreReadWithOrWithoutAlpha) {
  const std::string attributes = triangle(",\"COLOR_0\":1");
  buffer_.add("VEC3", std::vector<std::uint8_t>{255, 0, 51, 0, 255, 0, 0, 0, 255}, "\"normalized\":true");
  const SceneDescription three = read_primitive(attributes);
  expect_near(mesh(three).colors, {1, 0, .2f, 1, 0, 1, 0, 1, 0, 0, 1, 1});
  EXPECT_TRUE(three.materials.at(0).uses_vertex_colors);
  buffer_ = GltfBuffer();
  const std::string again = triangle(",\"COLOR_0\":1");
  buffer_.add("VEC4", Floats{1, 0, 0, .5f, 0, 1, 0, .25f, 0, 0, 1, 1});
  expect_near(mesh(read_primitive(again)).colors, {1, 0, 0, .5f, 0, 1, 0, .25f, 0, 0, 1, 1});
}

TEST_F(ToolGltf, MorphTargetsStandAsTheirWeightsSay) {
  const std::string attributes = triangle(",\"NORMAL\":1");
  buffer_.add("VEC3", Floats{0, 0, 1, 0, 0, 1, 0, 0, 1});
  buffer_.add("VEC3", Floats{0, 0, 1, 0, 0, 2, 0, 0, 3});
  buffer_.add("VEC3", Floats{8, 0, 0, 8, 0, 0, 8, 0, 0});
  const std::string meshes = "\"meshes\":[{\"primitives\":[{" + attributes +
                             ",\"targets\":[{\"POSITION\":2},{\"POSITION\":3,\"NORMAL\":2}]}],\"weights\":[0.5,0]}]";
  const SceneDescription scene =
      read_nodes("{\"mesh\":0,\"children\":[1,2]},{\"mesh\":0,\"weights\":[0,0.25]},{\"mesh\":0}", meshes);
  ASSERT_EQ(scene.shapes.size(), 2u);  // two nodes stand alike
  EXPECT_EQ(mesh(scene, 0).positions, (Floats{0, 0, .5f, 1, 0, 1, 0, 1, 1.5f}));
  EXPECT_EQ(mesh(scene, 1).positions, (Floats{2, 0, 0, 3, 0, 0, 2, 1, 0}));
  EXPECT_EQ(mesh(scene, 1).normals, (Floats{0, 0, 1.25f, 0, 0, 1.5f, 0, 0, 1.75f}));
  EXPECT_EQ(notes_with("morph targets stay as they are at rest"), 1u);
}

class ToolGltfSkin : public ToolGltf {
 protected:
  // A triangle whose corners follow joint 0, joint 1, and both by halves. Joint 0 is turned by 90 degrees about z and
  // lies at (10, 0, 0); joint 1, its child, 1 along its x. Both were bound at the origin moved by -1 along y.
  SceneDescription read_skin(const std::string& joints = "[2,3]",
                             const std::vector<std::uint8_t>& follows = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}) {
    buffer_ = GltfBuffer();
    const std::string attributes = triangle(",\"NORMAL\":1,\"JOINTS_0\":2,\"WEIGHTS_0\":3");
    buffer_.add("VEC3", Floats{1, 0, 0, 1, 0, 0, 1, 0, 0});
    buffer_.add("VEC4", follows);
    buffer_.add("VEC4", Floats{1, 0, 0, 0, 2, 0, 0, 0, .5f, .5f, 0, 0});
    const Floats bound = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
    Floats twice = bound;
    twice.insert(twice.end(), bound.begin(), bound.end());
    const std::string view =
        std::to_string(buffer_.add_bytes(std::string(reinterpret_cast<const char*>(twice.data()), twice.size() * 4)));
    const int matrices =
        buffer_.describe("\"bufferView\":" + view + ",\"componentType\":5126,\"count\":2,\"type\":\"MAT4\"");
    return read_nodes(
        "{\"children\":[1,2]},{\"mesh\":0,\"skin\":0,\"translation\":[99,99,99]},"
        "{\"translation\":[10,0,0],\"rotation\":[0,0,0.7071067811865476,0.7071067811865476],\"children\":[3]},"
        "{\"translation\":[1,0,0]}",
        mesh_of(attributes) + ",\"skins\":[{\"joints\":" + joints +
            ",\"inverseBindMatrices\":" + std::to_string(matrices) + "}]");
  }
};

TEST_F(ToolGltfSkin, MeshesFollowTheirJointsAtRestWhereverTheirNodeIs) {
  const SceneDescription scene = read_skin();
  // (x, y) was bound to (x, y - 1), and is turned to (1 - y, x).
  expect_near(mesh(scene).positions, {11, 0, 0, 11, 2, 0, 10, .5f, 0});
  expect_near(mesh(scene).normals, {0, 1, 0, 0, 1, 0, 0, 1, 0});
  EXPECT_EQ(scene.instances.at(0).transform[3], 0);
  EXPECT_EQ(notes_with("skins stay as they are at rest: nodes[1]"), 1u);
}

TEST_F(ToolGltfSkin, JointsThatDoNotExistAreNamed) {
  const auto error = [&](const std::string& joints, const std::vector<std::uint8_t>& follows) {
    try {
      read_skin(joints, follows);
    } catch (const Error& e) {
      return without_folder(e.what());
    }
    return std::string("no error");
  };
  expect_contains(error("[2,3]", {0, 0, 0, 0, 7, 0, 0, 0, 0, 1, 0, 0}), "primitives[0]: vertex 1 follows joint 7 of 2");
  expect_contains(error("[2,9]", {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}), "skins[0].joints[1] is 9, and nodes has 4");
  expect_contains(error("[2,3,1]", {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}), "has 3 joints and 2 inverse bind matrices");
}

}  // namespace bdpt_tool::tool_gltf_mesh_test
