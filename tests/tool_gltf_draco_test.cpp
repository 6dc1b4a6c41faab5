// KHR_draco_mesh_compression: files packed here by Draco's own encoder, whole and damaged.
//
// SPDX-License-Identifier: Apache-2.0
#include "gltf/draco.h"
#include "gltf_fixture.h"

#ifdef BDPT_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <random>
#endif

namespace bdpt_tool::tool_gltf_draco_test {

#ifndef BDPT_DRACO

TEST_F(ToolGltf, WithoutDracoPackedMeshesAreRefused) {
  EXPECT_FALSE(gltf::kReadsDraco);
  expect_contains(error_of("\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]"),
                  "extensionsRequired names KHR_draco_mesh_compression, which is not read here; install libdraco-dev "
                  "and build this program anew, or write the meshes uncompressed");
}

#else

constexpr int kSide = 6;  // squares of a grid

// A curved grid of two triangles to a square, with normals, texture coordinates that have a seam, and colours.
class ToolGltfDraco : public ToolGltf {
 protected:
  struct Packed {
    std::string bytes;
    std::size_t vertices = 0, faces = 0;
    int position = 0, normal = 0, uv = 0, color = 0;
  };

  static std::array<float, 3> point(int x, int y) {
    const float u = float(x) / kSide, v = float(y) / kSide;
    return {u, v, 0.3f * std::sin(3 * u) * std::cos(2 * v)};
  }

  static Packed pack(int method) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2 * kSide * kSide);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normal = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
    std::uint32_t face = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const int x = i % kSide, y = i / kSide;
      for (const auto& corners : {std::array{0, 1, 3}, std::array{0, 3, 2}}) {
        std::array<std::array<float, 3>, 3> p, n;
        std::array<std::array<float, 2>, 3> t;
        std::array<std::array<std::uint8_t, 4>, 3> c;
        for (std::size_t k = 0; k < 3; ++k) {
          const int cx = x + corners[k] % 2, cy = y + corners[k] / 2;
          p[k] = point(cx, cy);
          n[k] = {0, 0, 1};
          t[k] = {p[k][0] + (x < kSide / 2 ? 0.0f : 1.0f), p[k][1]};
          c[k] = {std::uint8_t(40 * cx), std::uint8_t(40 * cy), 7, 255};
        }
        const draco::FaceIndex f(face++);
        builder.SetAttributeValuesForFace(position, f, p[0].data(), p[1].data(), p[2].data());
        builder.SetAttributeValuesForFace(normal, f, n[0].data(), n[1].data(), n[2].data());
        builder.SetAttributeValuesForFace(uv, f, t[0].data(), t[1].data(), t[2].data());
        builder.SetAttributeValuesForFace(color, f, c[0].data(), c[1].data(), c[2].data());
      }
    }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 10);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    Packed packed;
    packed.bytes.assign(buffer.data(), buffer.size());
    packed.faces = mesh->num_faces();
    packed.vertices = mesh->num_points();
    const auto id = [&](int attribute) { return int(mesh->attribute(attribute)->unique_id()); };
    packed.position = id(position), packed.normal = id(normal), packed.uv = id(uv), packed.color = id(color);
    return packed;
  }

  struct Changes {
    std::string primitive = "", normal_type = "VEC3";
    std::size_t more_vertices = 0, more_faces = 0;
    int uv_id = -1;
  };

  std::string document(const Packed& packed, const std::string& bytes, const Changes& changes) {
    buffer_ = {};
    const int view = buffer_.add_bytes(bytes);
    const auto accessor = [&](int component, const std::string& type, std::size_t count, const char* more = "") {
      return std::to_string(buffer_.describe("\"componentType\":" + std::to_string(component) + ",\"type\":\"" + type +
                                             "\",\"count\":" + std::to_string(count) + more));
    };
    const std::size_t vertices = packed.vertices + changes.more_vertices;
    const std::string attributes = "\"POSITION\":" + accessor(5126, "VEC3", vertices) +
                                   ",\"NORMAL\":" + accessor(5126, changes.normal_type, vertices) +
                                   ",\"TEXCOORD_0\":" + accessor(5126, "VEC2", vertices) +
                                   ",\"COLOR_0\":" + accessor(5121, "VEC4", vertices, ",\"normalized\":true");
    const std::string indices = accessor(5123, "SCALAR", 3 * (packed.faces + changes.more_faces));
    const auto named = [](const char* name, int id) { return "\"" + std::string(name) + "\":" + std::to_string(id); };
    const std::string draco = "\"KHR_draco_mesh_compression\":{\"bufferView\":" + std::to_string(view) +
                              ",\"attributes\":{" + named("POSITION", packed.position) + "," +
                              named("NORMAL", packed.normal) + "," +
                              named("TEXCOORD_0", changes.uv_id < 0 ? packed.uv : changes.uv_id) + "," +
                              named("COLOR_0", packed.color) + "}}";
    return "\"extensionsUsed\":[\"KHR_draco_mesh_compression\"],\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]"
           "," +
           scene_of("{\"mesh\":0}", mesh_of("\"attributes\":{" + attributes + "},\"indices\":" + indices +
                                            ",\"extensions\":{" + draco + "}" + changes.primitive));
  }
  std::string document(const Packed& packed) { return document(packed, packed.bytes, {}); }
};

TEST_F(ToolGltfDraco, PackedTrianglesComeOutAsTheyWentIn) {
  for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    const Packed packed = pack(method);
    const SceneDescription scene = read_document(document(packed));
    const TriangleMesh& mesh = this->mesh(scene);
    EXPECT_EQ(notes_with("KHR_draco"), 0u) << notes();
    ASSERT_EQ(mesh.indices.size(), 3 * packed.faces);
    ASSERT_EQ(mesh.vertex_count(), packed.vertices);
    EXPECT_GT(packed.vertices, std::size_t{(kSide + 1) * (kSide + 1)});  // the seam
    double area = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return &mesh.positions[3 * std::size_t{mesh.indices[i + k]}]; };
      const float *a = corner(0), *b = corner(1), *c = corner(2);
      const double flat = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
      EXPECT_NEAR(flat, 0.5 / (kSide * kSide), 1e-4);  // none turned over
      area += flat;
    }
    EXPECT_NEAR(area, 1, 1e-3);
    for (std::size_t v = 0; v < packed.vertices; ++v) {
      const float* p = &mesh.positions[3 * v];
      const int x = int(std::lround(p[0] * kSide)), y = int(std::lround(p[1] * kSide));
      const std::array<float, 3> expected = point(x, y);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(p[k], expected[k], 1.0f / (1 << 13));
      const float u = mesh.uv[2 * v];
      EXPECT_LT(std::min(std::abs(u - p[0]), std::abs(u - p[0] - 1)), 1e-3f);
      EXPECT_NEAR(mesh.uv[2 * v + 1], 1 - p[1], 1e-3f);
      EXPECT_NEAR(mesh.normals[3 * v + 2], 1, 1e-3f);
      EXPECT_EQ(mesh.colors[4 * v], float(40 * x) / 255);
      EXPECT_EQ(mesh.colors[4 * v + 1], float(40 * y) / 255);
      EXPECT_EQ(mesh.colors[4 * v + 3], 1);
    }
  }
}

TEST_F(ToolGltfDraco, AGlbIsReadAlike) {
  const Packed packed = pack(draco::MESH_EDGEBREAKER_ENCODING);
  const SceneDescription text = read_document(document(packed));
  std::string json = "{\"asset\":{\"version\":\"2.0\"}," + document(packed) + "}";
  const std::string uri = ",\"uri\":\"data:application/octet-stream;base64," + base64(buffer_.bytes()) + "\"";
  json.erase(json.find(uri), uri.size());
  write("scene.glb", glb(json, buffer_.bytes()));
  const SceneDescription binary = read_scene(folder_.file("scene.glb"), diagnostics_);
  EXPECT_EQ(mesh(binary).positions, mesh(text).positions);
  EXPECT_EQ(mesh(binary).indices, mesh(text).indices);
}

TEST_F(ToolGltfDraco, WhatDoesNotFitItsAccessorsIsAnError) {
  const Packed packed = pack(draco::MESH_EDGEBREAKER_ENCODING);
  const auto error = [&](const Changes& changes) { return error_of(document(packed, packed.bytes, changes)); };
  const std::string data = "meshes[0].primitives[0]: the data of KHR_draco_mesh_compression ";
  expect_contains(error({.primitive = ",\"mode\":5"}), data + "must be of triangles with indices");
  expect_contains(error({.normal_type = "VEC2"}), data + "has 3 components for NORMAL, and the accessor 2");
  expect_contains(error({.more_vertices = 1}), data + "has 72 triangles of 56 vertices, and the accessors 72 of 57");
  expect_contains(error({.more_faces = 1}), data + "has 72 triangles of 49 vertices, and the accessors 73 of 56");
  expect_contains(error({.uv_id = 99}), data + "holds no attribute 99, which TEXCOORD_0 is to be");
  expect_contains(error({.more_vertices = 4000000000u}), "cannot hold 72 triangles");
  expect_contains(error_of(document(packed, "glTF", {})), data + "is damaged, or not of Draco's version 2.2");
  std::string text = document(packed);
  text.replace(text.find("{\"bufferView\":0,\"attributes\""), 15, "{\"bufferView\":9");
  expect_contains(error_of(text), "KHR_draco_mesh_compression.bufferView is 9");
}

// What a process of its own makes of files: the number of those read and of those refused, and by how many bytes its
// memory grew at most.
struct Outcome {
  long read = 0, refused = 0, growth = 0;
};

template <class Run>
Outcome in_process(const Run& run) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    alarm(100);  // a hang
    rusage before, after;
    getrusage(RUSAGE_SELF, &before);
    Outcome outcome = run();
    getrusage(RUSAGE_SELF, &after);
    outcome.growth = 1024 * (after.ru_maxrss - before.ru_maxrss);
    const bool written = write(ends[1], &outcome, sizeof outcome) == sizeof outcome;
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  Outcome outcome;
  EXPECT_EQ(read(ends[0], &outcome, sizeof outcome), static_cast<ssize_t>(sizeof outcome)) << "it did not end well";
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  return outcome;
}

TEST_F(ToolGltfDraco, DamagedDataIsReadOrRefused) {
  for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    const Packed packed = pack(method);
    const auto attempt = [&](const std::string& bytes, Outcome& outcome) {
      try {
        read_document(document(packed, bytes, {}));
        ++outcome.read;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::kInput);
        ++outcome.refused;
      }
    };
    const Outcome cut = in_process([&] {
      Outcome outcome;
      for (std::size_t size = 1; size < packed.bytes.size(); ++size) attempt(packed.bytes.substr(0, size), outcome);
      return outcome;
    });
    EXPECT_EQ(cut.read, 0);
    const Outcome changed = in_process([&] {
      Outcome outcome;
      std::mt19937 random(7);
      for (int i = 0; i < 600; ++i) {
        std::string bytes = packed.bytes;
        const std::size_t head = i % 3 == 0 ? 40 : bytes.size();
        for (int n = 0; n <= i % 4; ++n) bytes[random() % head] = char(random());
        attempt(bytes, outcome);
      }
      return outcome;
    });
    EXPECT_EQ(changed.read + changed.refused, 600);
    EXPECT_GT(changed.refused, 100);
    for (const Outcome& outcome : {cut, changed}) EXPECT_LT(outcome.growth, 16 << 20);
  }
}

#endif

}  // namespace bdpt_tool::tool_gltf_draco_test
