// A scene as a file describes it, before the library sees it. Indices refer to the vectors of SceneDescription.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bdpt.h"
#include "error.h"
#include "image.h"
#include "mesh.h"

namespace bdpt_tool {

using Rgb = std::array<float, 3>;

struct SphereShape {
  float radius = 1;
};

struct ShapeDescription {
  std::string label;
  Location where;
  std::variant<TriangleMesh, SphereShape> geometry;
};

// Bytes in the sRGB curve, or linear floats.
struct TextureDescription {
  std::string label;
  Location where;
  std::variant<ByteImage, Image> image;
};

struct MaterialDescription {
  bdpt_material_type type = BDPT_MATERIAL_DIFFUSE;
  std::string label;
  Location where;
  Rgb reflectance = {0.5f, 0.5f, 0.5f};
  int texture = -1;
  Rgb eta = {}, k = {};
  float ior = 1.5f;
  std::array<float, 2> roughness = {};
  Rgb emission = {};
  bool emission_two_sided = false;
  bool one_sided = false;

  bool emits() const { return emission[0] > 0 || emission[1] > 0 || emission[2] > 0; }
};

struct InstanceDescription {
  int shape = 0;
  int material = 0;
  std::array<float, 12> transform = {};
  Location where;
  std::string label;      // by which it is named in errors
  std::size_t node = 0;   // what is placed at once, the parts of a mesh, has one number
  std::string node_name;  // by which that is named on the command line; several may have one name
  bdpt_instance_id id{};  // once the library has it
};

struct LightDescription {
  bdpt_light_type type = BDPT_LIGHT_POINT;
  Location where;
  Rgb position = {}, direction = {0, 0, 1};
  Rgb value = {};  // intensity, or radiance of an environment
  float cone_angle = 30, cone_falloff = 5;
};

// What is not given in the file is empty, so that the program's own defaults can stand in.
struct CameraDescription {
  bdpt_camera_type type = BDPT_CAMERA_PERSPECTIVE;
  Location where;
  std::array<float, 12> transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // the library's camera to the world
  float fov_short_axis = 90;                                               // degrees over two units of the screen
  bool fov_is_vertical = false;                // the above is of the image's height, whatever its shape
  std::optional<std::array<float, 4>> screen;  // x0, x1, y0, y1; empty = fitted to the image
  std::optional<float> frame_aspect;           // width over height
  float screen_scale = 1;                      // orthographic: world units in one of the screen
  float lens_radius = 0, focus_distance = 0;   // world units
  std::vector<bdpt_lens_surface> lens;         // of a traced one, from the scene to the film
  float lens_unit = 0;                         // world units in one of its
};

struct FilmDescription {
  std::uint32_t width = 1280, height = 720;
  std::array<float, 4> crop_fractions = {0, 1, 0, 1};      // x0, x1, y0, y1
  std::optional<std::array<std::int64_t, 4>> crop_pixels;  // the same, in pixels
  bdpt_filter filter = BDPT_FILTER_GAUSSIAN;
  float filter_radius = 1.5f, filter_a = 0.5f, filter_b = 0;
  float diagonal = 35;  // of the whole image behind a traced lens, in its unit
};

struct SceneDescription {
  std::string path;
  std::vector<ShapeDescription> shapes;
  std::vector<TextureDescription> textures;
  std::vector<MaterialDescription> materials;
  std::vector<InstanceDescription> instances;
  std::vector<LightDescription> lights;
  CameraDescription camera;
  FilmDescription film;
  std::optional<std::uint32_t> samples_per_pixel;
  std::uint32_t max_edges = 6;  // 0 = no limit
};

}  // namespace bdpt_tool
