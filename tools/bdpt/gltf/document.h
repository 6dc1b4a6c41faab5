// What a glTF 2.0 file says, as far as this program reads it. Whatever made it checked it: every index points at
// something, -1 where there is none; every element of an accessor lies within the data; numbers are in their ranges.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "scene_description.h"
#include "scene_folder.h"

namespace bdpt_tool::gltf {

constexpr double kDegrees = 180 / std::numbers::pi;  // in a radian: the files have radians

using Bytes = std::vector<unsigned char>;

enum class Component { kByte = 5120, kUbyte = 5121, kShort = 5122, kUshort = 5123, kUint = 5125, kFloat = 5126 };

// A strided array of vectors, some of which other values may replace.
struct Accessor {
  const unsigned char* data = nullptr;  // none: all zero
  std::size_t count = 0, stride = 0;
  int components = 1;
  Component type = Component::kFloat;
  bool normalized = false;
  struct {
    std::size_t count = 0;
    const unsigned char* indices = nullptr;
    Component index_type = Component::kUint;
    const unsigned char* values = nullptr;
  } sparse;
};

struct Image {
  std::string name;
  std::string path;  // of its file; empty if the bytes are here
  const unsigned char* data = nullptr;
  std::size_t size = 0;
};

struct Texture {
  int image = -1;
  std::string unread;  // the extension that has the image, where there is no other
  std::array<Wrap, 2> wrap = {Wrap::kRepeat, Wrap::kRepeat};
  bool nearest = false;
};

enum class Mode { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kTriangleStrip, kTriangleFan };

struct Primitive {
  Mode mode = Mode::kTriangles;
  int indices = -1, material = -1;
  std::map<std::string, int> attributes;
  std::vector<std::map<std::string, int>> targets;  // what morph targets add to the attributes

  int attribute(const std::string& name) const {
    const auto found = attributes.find(name);
    return found == attributes.end() ? -1 : found->second;
  }
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<double> weights;  // of the morph targets
};

struct Skin {
  std::vector<int> joints;  // nodes
  int inverse_bind_matrices = -1;
};

struct Node {
  std::string name;
  std::vector<int> children;
  int mesh = -1, camera = -1, skin = -1, light = -1;
  std::optional<std::array<double, 16>> matrix;  // by columns; in place of the three below
  std::array<double, 3> translation = {0, 0, 0}, scale = {1, 1, 1};
  std::array<double, 4> rotation = {0, 0, 0, 1};
  std::vector<double> weights;            // in place of the mesh's, where there are any
  std::map<std::string, int> instancing;  // EXT_mesh_gpu_instancing: accessors by name; empty without it
};

struct Camera {
  std::string name;
  bool perspective = true;
  double yfov = 1;    // radians
  double aspect = 0;  // 0 = that of the image
  double ymag = 1;    // orthographic: half of the height
};

struct Light {
  std::string name, type;
  std::array<double, 3> color = {1, 1, 1};
  double intensity = 1;
  bool has_range = false;
  double inner_angle = 0, outer_angle = 0.7853981633974483;  // radians from the axis
};

struct Document {
  std::vector<Node> nodes;
  std::vector<int> roots;  // of the scene to be read
  std::size_t scene_count = 0;
  std::vector<Mesh> meshes;
  std::vector<Accessor> accessors;
  std::vector<MaterialDescription> materials;  // their textures are this document's
  std::vector<Skin> skins;
  std::vector<Texture> textures;
  std::vector<Image> images;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<std::string> extensions;  // all that are used
  bool has_animations = false;

  std::vector<Bytes> storage;  // what accessors and images point into
};

// "materials[3] 'Wood'", for errors and notes.
std::string place(const char* array, std::size_t index, const std::string& name = {});

// Throws an Error for a file that is damaged, breaks the format's rules, or needs an extension that is not known.
// `scene` is the name or the number of one; empty = the default one, or the first.
Document read_document(const std::string& path, const SceneFolder& folder, const std::string& scene);

}  // namespace bdpt_tool::gltf
