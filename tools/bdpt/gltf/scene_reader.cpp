// SPDX-License-Identifier: Apache-2.0
#include "gltf/scene_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gltf/accessor.h"
#include "gltf/materials.h"
#include "gltf/meshes.h"
#include "gltf/nodes.h"
#include "gltf/view.h"

namespace bdpt_tool {
namespace gltf {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kMaxPixels = 65536;

// Extensions that are read; materials.cpp tells how far.
constexpr const char* kRead[] = {"KHR_lights_punctual",    "KHR_materials_emissive_strength",
                                 "KHR_materials_ior",      "KHR_materials_transmission",
                                 "KHR_materials_unlit",    "KHR_materials_volume",
                                 "KHR_mesh_quantization",  "KHR_texture_transform",
                                 "EXT_mesh_gpu_instancing"};

Rgb rgb(const Vec3& v) { return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}; }

// Scaling and shear taken out.
Transform rigid(const Transform& t) {
  const Vec3 z = normalized(t.vector({0, 0, 1}));
  const Vec3 x = normalized(cross(t.vector({0, 1, 0}), z));
  const Vec3 y = cross(z, x);
  const Vec3 origin = t.point({0, 0, 0});
  return {{{x[0], y[0], z[0], origin[0]}, {x[1], y[1], z[1], origin[1]}, {x[2], y[2], z[2], origin[2]}}};
}

class Reader {
 public:
  Reader(const std::string& path, Diagnostics& diagnostics)
      : where_{path, 0},
        document_(read_document(path)),
        notes_(path, diagnostics),
        materials_(document_, scene_, notes_),
        shapes_(document_.meshes.size()) {
    scene_.path = path;
  }

  SceneDescription read() {
    note_what_is_left_out();
    const std::vector<PlacedNode> nodes = place_nodes(document_, where_);
    for (const PlacedNode& node : nodes) {
      place_mesh(node);
      place_light(node);
      place_camera(node);
    }
    if (scene_.instances.empty() && scene_.lights.empty()) {
      notes_.tell();
      throw Error(where_, "the scene is empty; it needs a mesh");
    }
    if (!has_camera_) {
      scene_.camera = framing_camera(scene_);
      notes_.add("there is no camera; one that sees all of the scene is used");
    }
    scene_.camera.where = where_;
    notes_.tell();
    return std::move(scene_);
  }

 private:
  // The shape of a primitive, and its material; no shape for what has no triangles.
  struct Part {
    int shape = -1, material = -1;
  };

  const Node& node(const PlacedNode& placed) const { return document_.nodes[static_cast<std::size_t>(placed.node)]; }
  std::string name(const PlacedNode& placed) const {
    return place("nodes", static_cast<std::size_t>(placed.node), node(placed).name);
  }

  void note_what_is_left_out() {
    if (document_.scene_count > 1) {
      notes_.add("one scene of " + std::to_string(document_.scene_count) + " is read, the default one or the first");
    }
    if (document_.has_animations) notes_.add("animations are left out: everything stays as it is at rest");
    for (const std::string& extension : document_.extensions) {
      if (std::find(std::begin(kRead), std::end(kRead), extension) == std::end(kRead)) {
        notes_.add("the extension " + extension + " is not known, and is left out");
      }
    }
  }

  const std::vector<Part>& parts(int mesh) {
    const auto slot = static_cast<std::size_t>(mesh);
    if (!shapes_[slot])
      shapes_[slot] = read_mesh(document_.meshes[slot], place("meshes", slot, document_.meshes[slot].name));
    return *shapes_[slot];
  }

  std::vector<Part> read_mesh(const Mesh& mesh, const std::string& place) {
    std::vector<Part> parts;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const Primitive& primitive = mesh.primitives[i];
      const TextureUse texture =
          primitive.material < 0 ? TextureUse()
                                 : document_.materials[static_cast<std::size_t>(primitive.material)].base_color_texture;
      const std::string where = place + ".primitives[" + std::to_string(i) + "]";
      auto triangles = read_primitive(document_, primitive, texture, where_, where, notes_);
      Part part;
      if (triangles) {
        part.material = materials_.use(primitive.material);
        part.shape = static_cast<int>(scene_.shapes.size());
        scene_.shapes.push_back({mesh.name.empty() ? place : mesh.name, where_, std::move(*triangles)});
      }
      parts.push_back(part);
    }
    return parts;
  }

  void place_mesh(const PlacedNode& placed) {
    const Node& from = node(placed);
    if (from.mesh < 0) return;
    if (from.skin >= 0) notes_.add("skins are left out: meshes stay as they are at rest", name(placed));
    const std::string label = from.name.empty() ? name(placed) : from.name;
    if (from.instancing.empty()) return place_mesh(placed, placed.to_world, label);
    const std::vector<Transform> copies = instancing(placed);
    for (std::size_t i = 0; i < copies.size(); ++i) {
      place_mesh(placed, placed.to_world * copies[i], label + "[" + std::to_string(i) + "]");
    }
  }

  void place_mesh(const PlacedNode& placed, const Transform& to_world, const std::string& label) {
    if (!to_world.is_finite()) throw Error(where_, name(placed) + " has a transform that is not finite");
    if (!to_world.is_invertible()) return notes_.add("what is scaled to nothing is left out", name(placed));
    const std::vector<Part>& all = parts(node(placed).mesh);
    const std::size_t number = scene_.instances.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].shape < 0) continue;
      scene_.instances.push_back({all[i].shape, all[i].material, to_world.rows(), where_,
                                  all.size() > 1 ? label + "/" + std::to_string(i) : label, number, label});
    }
  }

  // EXT_mesh_gpu_instancing.
  std::vector<Transform> instancing(const PlacedNode& placed) const {
    const std::vector<float> translations = instancing_attribute(placed, "TRANSLATION", 3);
    const std::vector<float> rotations = instancing_attribute(placed, "ROTATION", 4);
    const std::vector<float> scales = instancing_attribute(placed, "SCALE", 3);
    const std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
    for (const std::size_t other : {translations.size() / 3, rotations.size() / 4, scales.size() / 3}) {
      if (other != 0 && other != count) {
        throw Error(where_, name(placed) + ": EXT_mesh_gpu_instancing has attributes of different lengths");
      }
    }
    std::vector<Transform> copies(std::max<std::size_t>(count, 1));
    for (std::size_t i = 0; i < count; ++i) {
      std::array<double, 3> translation = {0, 0, 0}, scale = {1, 1, 1};
      std::array<double, 4> rotation = {0, 0, 0, 1};
      if (!translations.empty())
        std::copy_n(translations.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, translation.begin());
      if (!rotations.empty()) std::copy_n(rotations.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, rotation.begin());
      if (!scales.empty()) std::copy_n(scales.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, scale.begin());
      copies[i] = compose(translation, rotation, scale);
    }
    return copies;
  }

  std::vector<float> instancing_attribute(const PlacedNode& placed, const std::string& attribute,
                                          int components) const {
    const auto found = node(placed).instancing.find(attribute);
    if (found == node(placed).instancing.end()) return {};
    return read_floats(document_.accessors[static_cast<std::size_t>(found->second)], components, where_,
                       name(placed) + " " + attribute);
  }

  void place_light(const PlacedNode& placed) {
    if (node(placed).light < 0) return;
    const auto slot = static_cast<std::size_t>(node(placed).light);
    const Light& from = document_.lights[slot];
    const std::string what = place("lights", slot, from.name);
    if (from.type == "directional") return notes_.add("directional lights are not known yet, and are left out", what);
    if (from.type != "point" && from.type != "spot") {
      throw Error(where_, what + " is of the unknown type '" + from.type + "'");
    }
    LightDescription light;
    light.where = where_;
    light.position = rgb(placed.to_world.point({0, 0, 0}));
    for (std::size_t c = 0; c < 3; ++c) light.value[c] = static_cast<float>(from.color[c] * from.intensity);
    if (from.has_range) notes_.add("the range of a light is left out: it reaches everywhere", what);
    if (from.type == "spot") set_spot(from, what, placed, light);
    scene_.lights.push_back(light);
  }

  void set_spot(const Light& from, const std::string& what, const PlacedNode& placed, LightDescription& light) {
    if (from.inner_angle >= from.outer_angle) {
      throw Error(where_, what + ": innerConeAngle must be less than outerConeAngle");
    }
    const Vec3 axis = placed.to_world.vector({0, 0, -1});
    if (!(length(axis) > 0)) throw Error(where_, name(placed) + " has a light, and no direction: its scale is zero");
    light.type = BDPT_LIGHT_SPOT;
    light.direction = rgb(normalized(axis));
    light.cone_angle = static_cast<float>(from.outer_angle * kDegrees);
    light.cone_falloff =
        std::min(light.cone_angle, static_cast<float>((from.outer_angle - from.inner_angle) * kDegrees));
    notes_.add("the edge of a spot falls off smoothly at both its ends", what);
  }

  void place_camera(const PlacedNode& placed) {
    if (node(placed).camera < 0) return;
    const auto slot = static_cast<std::size_t>(node(placed).camera);
    const Camera& from = document_.cameras[slot];
    const std::string what = place("cameras", slot, from.name);
    if (has_camera_) return notes_.add("only the first camera is used; left out", what);
    const Transform to_world = rigid(placed.to_world);
    if (!to_world.is_finite()) throw Error(where_, name(placed) + " has a camera, and no direction: its scale is zero");
    has_camera_ = true;
    scene_.camera.transform = to_world.rows();
    scene_.camera.fov_short_axis = static_cast<float>(from.yfov * kDegrees);
    scene_.camera.fov_is_vertical = true;
    if (!from.perspective) {
      scene_.camera.type = BDPT_CAMERA_ORTHOGRAPHIC;
      scene_.camera.screen_scale = static_cast<float>(from.ymag);
    }
    if (from.aspect > 0) {
      const double height = std::round(scene_.film.width / from.aspect);
      scene_.film.height = static_cast<std::uint32_t>(std::clamp(height, 1.0, kMaxPixels));
    }
  }

  Location where_;
  Document document_;
  SceneDescription scene_;
  Notes notes_;
  MaterialTable materials_;
  std::vector<std::optional<std::vector<Part>>> shapes_;  // by mesh
  bool has_camera_ = false;
};

}  // namespace
}  // namespace gltf

SceneDescription read_gltf_scene(const std::string& path, Diagnostics& diagnostics) {
  return gltf::Reader(path, diagnostics).read();
}

}  // namespace bdpt_tool
