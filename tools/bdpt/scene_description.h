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
#include "ies.h"
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

enum class Wrap { kRepeat, kClamp, kMirror, kBlack };

struct TextureDescription {
  std::string label;
  Location where;
  AnyImage image;
  float exponent = 0;  // of the numbers of a coded image: 0 = the sRGB curve, 1 = linear, else a gamma
  std::array<Wrap, 2> wrap = {Wrap::kRepeat, Wrap::kRepeat};
  bool nearest = false;
};

// How a material looks a texture up.
struct TextureUse {
  int texture = -1;                                     // none
  int uv_set = 0;                                       // 0 = TriangleMesh::uv, 1 = uv_lightmap
  std::array<float, 6> transform = {1, 0, 0, 0, 1, 0};  // rows of a 2x3 matrix, applied to the mesh's (u, v)

  bool operator==(const TextureUse&) const = default;
};

// The factor, times the texel where there is a texture.
struct ColorValue {
  Rgb factor = {1, 1, 1};
  TextureUse texture;
};
struct FloatValue {
  float factor = 1;
  TextureUse texture;
  int channel = 0;  // of the texel
};

enum class AlphaMode { kOpaque, kMask, kBlend };

// The light that a coat of dielectric lets through and scatters.
struct CoatDescription {
  float ior = 1.5f, thickness = 0.01f, g = 0;
  std::array<float, 2> roughness = {};
  Rgb albedo = {};
};

// glTF's metallic-roughness material with the KHR extensions; base colour, normals, alpha and emission are the
// material's own. Roughnesses are glTF's: the square roots of GGX's alpha.
struct PrincipledDescription {
  FloatValue metallic = {.factor = 0, .texture = {}, .channel = 2};
  FloatValue roughness = {.factor = 1, .texture = {}, .channel = 1};
  FloatValue specular = {.factor = 1, .texture = {}, .channel = 3};
  ColorValue specular_color;
  FloatValue transmission = {.factor = 0, .texture = {}, .channel = 0};
  FloatValue thickness = {.factor = 0, .texture = {}, .channel = 1};  // 0 = thin walls
  float attenuation_distance = 0;                                     // 0 = no absorption
  Rgb attenuation_color = {1, 1, 1};
  float dispersion = 0;
  FloatValue clearcoat = {.factor = 0, .texture = {}, .channel = 0};
  FloatValue clearcoat_roughness = {.factor = 0, .texture = {}, .channel = 1};
  FloatValue clearcoat_normal;
  ColorValue sheen_color = {.factor = {0, 0, 0}, .texture = {}};
  FloatValue sheen_roughness = {.factor = 0, .texture = {}, .channel = 3};
  FloatValue iridescence = {.factor = 0, .texture = {}, .channel = 0};
  float iridescence_ior = 1.3f, iridescence_thickness_min = 100;                    // nanometres
  FloatValue iridescence_thickness = {.factor = 400, .texture = {}, .channel = 1};  // the texel goes from min to factor
  FloatValue anisotropy = {.factor = 0, .texture = {}, .channel = 2};  // channels 0 and 1 are a direction, 2 a strength
  float anisotropy_rotation = 0;                                       // radians
};

// A smooth window pane: in the library it is principled.
constexpr bdpt_material_type kMaterialThinDielectric = -1;

struct MaterialDescription {
  bdpt_material_type type = BDPT_MATERIAL_DIFFUSE;
  std::string label;
  Location where;
  // Diffuse, mirror, the base under a coat of diffuse, the reflected part of diffuse transmission, the base colour.
  Rgb reflectance = {0.5f, 0.5f, 0.5f};
  TextureUse reflectance_texture;
  ColorValue transmittance = {.factor = {0.25f, 0.25f, 0.25f}, .texture = {}};  // diffuse transmission
  Rgb eta = {}, k = {};
  float ior = 1.5f;
  std::array<float, 2> roughness = {};  // GGX's alpha
  bool single_scattering = false;       // of microfacets: the rest is lost
  CoatDescription coat;
  PrincipledDescription principled;
  int interior = -1;                    // what the surfaces enclose, in SceneDescription::media
  std::array<int, 2> mixed = {-1, -1};  // materials
  FloatValue mix_amount;                // of the second

  Rgb emission = {};
  TextureUse emission_texture;
  bool emission_two_sided = false;
  bool one_sided = false;
  bool unlit = false;  // shows its emission, and was not meant to shine

  AlphaMode alpha_mode = AlphaMode::kOpaque;
  float alpha_cutoff = 0.5f;
  FloatValue alpha = {.factor = 1, .texture = {}, .channel = 3};
  bool uses_vertex_colors = false;  // which multiply reflectance and alpha
  FloatValue normal;                // a map of normals, and the scale of its x and y
  FloatValue bump;                  // a map of heights, and their scale

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
  bdpt_material_id material_id{};
};

struct MediumDescription {
  std::string label;
  Location where;
  Rgb sigma_a = {}, sigma_s = {};  // of world units
  float g = 0;
};

// A rectangle that light from far away comes through.
struct PortalDescription {
  Rgb corner = {}, edge_u = {}, edge_v = {};
};

struct LightDescription {
  bdpt_light_type type = BDPT_LIGHT_POINT;
  std::string label;
  Location where;
  Rgb position = {}, direction = {0, 0, 1};
  Rgb value = {};  // intensity, radiance of an environment, irradiance of what a directional light faces
  float cone_angle = 30, cone_falloff = 5;
  float angular_radius = 0;  // directional, in degrees
  int texture = -1;          // environment: times the radiance; equirectangular, -z in its middle, +x to the right.
                             // Spot: thrown onto the square round its cone, its top towards `up`
  std::array<float, 12> transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // environment: local to world, local y up
  Rgb up = {};
  std::optional<Luminaire> luminaire;      // point: times the value; about the direction, from `up`
  std::vector<PortalDescription> portals;  // environment: hints, in the world
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
  std::vector<MediumDescription> media;
  int medium = -1;  // what fills the scene
  std::vector<LightDescription> lights;
  CameraDescription camera;
  FilmDescription film;
  std::optional<std::uint32_t> samples_per_pixel;
  std::uint32_t max_edges = 6;  // 0 = no limit
};

}  // namespace bdpt_tool
