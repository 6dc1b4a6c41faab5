// The PLY reader of the program: what it reads, and that nothing broken gets through.
//
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "ply.h"

namespace bdpt_tool::tool_ply_test {

const char kHeader[] =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string ascii(const std::string& body) { return std::string("ply\nformat ascii 1.0\n") + kHeader + body; }

template <class T>
void append(std::string& data, T value, bool big_endian) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (big_endian) std::reverse(bytes, bytes + sizeof(T));
  data.append(bytes, sizeof(T));
}

std::string binary_quad(bool big_endian) {
  std::string data = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" + kHeader;
  for (float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) append(data, x, big_endian);
  append<unsigned char>(data, 4, big_endian);
  for (int i : {0, 1, 2, 3}) append(data, i, big_endian);
  return data;
}

std::string error_of(const std::string& data) {
  try {
    parse_ply(data, "mesh.ply");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    return error.what();
  }
  return "no error";
}

TEST(ToolPly, QuadBecomesTwoTrianglesOfTheSameWinding) {
  const TriangleMesh mesh = parse_ply(ascii("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"), "mesh.ply");
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(mesh.vertex_count(), 4u);
}

TEST(ToolPly, AllEncodingsGiveTheSameMesh) {
  const TriangleMesh text = parse_ply(ascii("0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3"), "mesh.ply");
  for (bool big_endian : {false, true}) {
    const TriangleMesh mesh = parse_ply(binary_quad(big_endian), "mesh.ply");
    EXPECT_EQ(mesh.positions, text.positions);
    EXPECT_EQ(mesh.indices, text.indices);
  }
}

TEST(ToolPly, NormalsAndUvAreFoundByNameInAnyOrder) {
  const TriangleMesh mesh = parse_ply(
      "ply\r\nformat ascii 1.0\r\ncomment c\r\nelement vertex 3\r\nproperty uchar red\r\nproperty float t\r\n"
      "property float s\r\nproperty double nx\r\nproperty double ny\r\nproperty double nz\r\nproperty float z\r\n"
      "property float y\r\nproperty float x\r\nelement face 1\r\nproperty uchar flag\r\n"
      "property list uint8 uint16 vertex_index\r\nend_header\r\n"
      "9 .5 .25 0 0 1 3 2 1\r\n9 .5 .25 0 0 1 3 2 4\r\n9 .5 .25 0 0 1 3 5 1\r\n7 3 0 1 2\r\n",
      "mesh.ply");
  EXPECT_EQ(mesh.positions, (std::vector<float>{1, 2, 3, 4, 2, 3, 1, 5, 3}));
  EXPECT_EQ(mesh.normals, (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(mesh.uv, (std::vector<float>{.25f, .5f, .25f, .5f, .25f, .5f}));
}

TEST(ToolPly, EveryTruncationOfABinaryFileIsAnError) {
  const std::string data = binary_quad(false);
  for (std::size_t size = 0; size < data.size(); ++size) {
    EXPECT_THROW(parse_ply(std::string_view(data).substr(0, size), "mesh.ply"), Error) << size;
  }
}

TEST(ToolPly, EveryFlippedByteIsAnErrorOrAMeshWithIndicesInRange) {
  const std::string data = binary_quad(false);
  for (std::size_t i = 0; i < data.size(); ++i) {
    for (int flip : {1, 0x80, 0xff}) {
      std::string changed = data;
      changed[i] = static_cast<char>(changed[i] ^ flip);
      try {
        const TriangleMesh mesh = parse_ply(changed, "mesh.ply");
        for (std::uint32_t index : mesh.indices) EXPECT_LT(index, mesh.vertex_count());
      } catch (const Error&) {
      }
    }
  }
}

TEST(ToolPly, CountsBeyondTheFileAreRefusedBeforeMemoryIsTaken) {
  EXPECT_NE(error_of("ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
                     "property float y\nproperty float z\nend_header\n1234")
                .find("too short"),
            std::string::npos);
}

TEST(ToolPly, IndexOutOfRangeIsAnError) {
  EXPECT_NE(error_of(ascii("0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 4")).find("vertex 4 does not exist"), std::string::npos);
  EXPECT_NE(error_of(ascii("0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 -1")).find("out of range"), std::string::npos);
}

TEST(ToolPly, PolygonsAreCutIntoTriangles) {
  const TriangleMesh mesh = parse_ply(ascii("0 0 0 1 0 0 1 1 0 0 1 0 5 0 1 2 3 0"), "mesh.ply");
  EXPECT_EQ(mesh.triangle_count(), 3u);
  EXPECT_NE(error_of(ascii("0 0 0 1 0 0 1 1 0 0 1 0 5 0 1 2 3 4")).find("vertex 4 does not exist"), std::string::npos);
}

TEST(ToolPly, ColoursAreReadAsBytesOrFloats) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const auto colors = [&](const std::string& type, const std::string& color) {
    const std::string names[] = {"red", "green", "blue", "alpha"};
    std::string properties;
    for (const std::string& name : names) properties += "property " + type + " " + name + "\n";
    return parse_ply(head + properties + faces + "0 0 0 " + color + " 1 0 0 " + color + " 0 1 0 " + color + " 3 0 1 2",
                     "mesh.ply")
        .colors;
  };
  const std::vector<float> bytes = colors("uchar", "255 0 188 51");
  EXPECT_EQ(bytes.size(), 12u);
  EXPECT_EQ(bytes[0], 1);
  EXPECT_NEAR(bytes[2], 0.503f, 0.001f);  // out of the curve
  EXPECT_NEAR(bytes[3], 0.2f, 1e-6f);
  EXPECT_EQ(colors("float", ".25 .5 .75 1")[1], 0.5f);
}

TEST(ToolPly, PolygonsOfFewerThanThreeCornersAreAnError) {
  EXPECT_NE(error_of(ascii("0 0 0 1 0 0 1 1 0 0 1 0 2 0 1")).find("2 corners"), std::string::npos);
}

TEST(ToolPly, CoordinatesThatAreNotFiniteAreAnErrorWithALine) {
  EXPECT_EQ(error_of(ascii("0 0 0\n1 nan 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")).rfind("mesh.ply:11: vertex 1: y", 0), 0u)
      << error_of(ascii("0 0 0\n1 nan 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"));
  EXPECT_NE(error_of(ascii("0 0 0 1 inf 0 1 1 0 0 1 0 4 0 1 2 3")).find("not finite"), std::string::npos);
}

TEST(ToolPly, HeaderErrorsNameTheLine) {
  EXPECT_EQ(error_of("ply\nformat ascii\n").rfind("mesh.ply:2:", 0), 0u);
  EXPECT_EQ(error_of("ply\nformat ascii 1.0\nelement vertex many\n").rfind("mesh.ply:3:", 0), 0u);
  EXPECT_EQ(error_of("solid\n").rfind("mesh.ply:1: not a PLY file", 0), 0u);
}

TEST(ToolPly, PointsWithoutFacesAreAnError) {
  EXPECT_NE(error_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                     "property float z\nend_header\n0 0 0\n")
                .find("no faces"),
            std::string::npos);
}

TEST(ToolMesh, ZeroNormalsAreMadeFromTheTriangles) {
  TriangleMesh mesh = parse_ply(ascii("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"), "mesh.ply");
  mesh.normals = {0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 1};
  EXPECT_EQ(repair_zero_normals(mesh), 1u);
  EXPECT_EQ(mesh.normals[3], 0);
  EXPECT_GT(mesh.normals[5], 0);
}

}  // namespace bdpt_tool::tool_ply_test
