// What a glTF 2.0 file says, as far as this program reads it. Whatever made it checked it: every index points at
// something, -1 where there is none; every element of an accessor lies within the data; numbers are in their ranges.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bdpt_tool::gltf {

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
  bool repeats = true, nearest = false;
};

// How a material uses a texture.
struct TextureUse {
  int texture = -1;
  int uv_set = 0;
  struct {
    std::array<double, 2> offset = {0, 0}, scale = {1, 1};
    double rotation = 0;
  } transform;  // KHR_texture_transform
};

struct Material {
  std::string name;
  std::array<double, 4> base_color = {1, 1, 1, 1};
  TextureUse base_color_texture;
  double metallic = 1, roughness = 1;
  std::array<double, 3> emissive = {0, 0, 0};  // times KHR_materials_emissive_strength
  int emissive_texture = -1;
  bool has_metallic_roughness_texture = false, has_normal_texture = false, has_occlusion_texture = false;
  bool double_sided = false, opaque = true, unlit = false;
  std::optional<double> ior;  // KHR_materials_ior
  double transmission = 0;    // KHR_materials_transmission
  bool has_transmission_texture = false;
  bool has_volume = false;  // KHR_materials_volume, of any thickness
};

enum class Mode { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kTriangleStrip, kTriangleFan };

struct Primitive {
  Mode mode = Mode::kTriangles;
  int indices = -1, material = -1;
  std::map<std::string, int> attributes;
  bool has_targets = false;

  int attribute(const std::string& name) const {
    const auto found = attributes.find(name);
    return found == attributes.end() ? -1 : found->second;
  }
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

struct Node {
  std::string name;
  std::vector<int> children;
  int mesh = -1, camera = -1, skin = -1, light = -1;
  std::optional<std::array<double, 16>> matrix;  // by columns; in place of the three below
  std::array<double, 3> translation = {0, 0, 0}, scale = {1, 1, 1};
  std::array<double, 4> rotation = {0, 0, 0, 1};
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
  std::vector<Material> materials;
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
Document read_document(const std::string& path);

}  // namespace bdpt_tool::gltf
