// What the tests of the glTF reader share: documents from their parts, and what is said of them.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "gltf/scene_reader.h"
#include "gltf_writer.h"
#include "lowering.h"
#include "scene_upload.h"
#include "temp_folder.h"
#include "transform.h"

namespace bdpt_tool {

using Floats = std::vector<float>;
using Words = std::vector<std::uint32_t>;

inline const Floats kCorners = {0, 0, 0, 1, 0, 0, 0, 1, 0};

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

  // What the library gets of a material.
  MaterialDescription lower(const SceneDescription& scene, std::size_t material = 0) {
    Notes notes(scene.path, diagnostics_);
    return lowered(scene, scene.materials.at(material), notes);
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

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << text << "' lacks '" << part << "'";
}

inline Vec3 transformed(const std::array<float, 12>& m, const Vec3& p, double w) {
  Vec3 result;
  for (int i = 0; i < 3; ++i)
    result[i] = m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3] * w;
  return result;
}

inline void expect_near(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5) << i;
}

inline void expect_near(const Floats& a, const Floats& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5) << i;
}

// With an image of two texels.
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

}  // namespace bdpt_tool
