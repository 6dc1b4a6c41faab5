// Damaged glTF: errors name the property; nothing crashes.
//
// SPDX-License-Identifier: Apache-2.0
#include "gltf_fixture.h"

namespace bdpt_tool::tool_gltf_damaged_test {

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
      {scene_of("{\"mesh\":0}", good +
                                    ",\"materials\":[{\"extensions\":{\"KHR_materials_sheen\":{\"sheenColorTexture\":"
                                    "{\"index\":0}}}}]"),
       "materials[0].extensions.KHR_materials_sheen.sheenColorTexture.index is 0, and textures has 0 elements"},
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
  expect_contains(
      error("{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_texture_basisu\"]}"),
      "extensionsRequired names KHR_texture_basisu, which is not read here; write the textures as PNG or JPEG: "
      "Debian has no library for KTX2");
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

}  // namespace bdpt_tool::tool_gltf_damaged_test
