// SPDX-License-Identifier: Apache-2.0
#include "gltf/scene_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "default_view.h"
#include "gltf/draco.h"
#include "gltf/instancing.h"
#include "gltf/lights.h"
#include "gltf/materials.h"
#include "gltf/meshes.h"
#include "gltf/nodes.h"
#include "gltf/skins.h"

namespace bdpt_tool {
namespace gltf {
namespace {

constexpr double kMaxPixels = 65536;

// Extensions that are read, and those that change nothing here.
constexpr const char* kRead[] = {"KHR_lights_punctual",
                                 "KHR_materials_anisotropy",
                                 "KHR_materials_clearcoat",
                                 "KHR_materials_dispersion",
                                 "KHR_materials_emissive_strength",
                                 "KHR_materials_ior",
                                 "KHR_materials_iridescence",
                                 "KHR_materials_sheen",
                                 "KHR_materials_specular",
                                 "KHR_materials_transmission",
                                 "KHR_materials_unlit",
                                 "KHR_materials_volume",
                                 "KHR_mesh_quantization",
                                 "KHR_texture_transform",
                                 "EXT_mesh_gpu_instancing",
                                 "KHR_xmp",
                                 "KHR_xmp_json_ld"};

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
  Reader(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics)
      : where_{path, 0},
        document_(read_document(path, SceneFolder(path, options.folder), options.scene)),
        has_choice_(!options.scene.empty()),
        notes_(path, diagnostics),
        materials_(document_, scene_, notes_) {
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
    complete(scene_, has_camera_, notes_);
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
    if (document_.scene_count > 1 && !has_choice_) {
      notes_.add("one scene of " + std::to_string(document_.scene_count) +
                 " is read, the default one or the first; choose another by --scene");
    }
    if (document_.has_animations) notes_.add("animations are left out: everything stays as it is at rest");
    for (const std::string& extension : document_.extensions) {
      const bool is_draco = kReadsDraco && extension == "KHR_draco_mesh_compression";
      if (!is_draco && std::find(std::begin(kRead), std::end(kRead), extension) == std::end(kRead)) {
        notes_.add("the extension " + extension + " is not known, and is left out");
      }
    }
  }

  // The shapes of a node's mesh, in its pose; nodes that have it alike share them.
  const std::vector<Part>& parts(const PlacedNode& placed) {
    const Node& from = node(placed);
    const auto slot = static_cast<std::size_t>(from.mesh);
    const Mesh& mesh = document_.meshes[slot];
    Pose pose;
    pose.weights = from.weights.empty() ? mesh.weights : from.weights;
    const PoseKey key(from.mesh, from.skin, pose.weights);
    if (const auto found = shapes_.find(key); found != shapes_.end()) return found->second;
    if (from.skin >= 0) {
      if (to_world_.empty()) to_world_ = transforms_to_world(document_, where_);
      pose.joints = joint_matrices(document_, from.skin, to_world_, where_);
    }
    return shapes_[key] = read_mesh(mesh, pose, place("meshes", slot, mesh.name));
  }

  std::vector<Part> read_mesh(const Mesh& mesh, const Pose& pose, const std::string& place) {
    std::vector<Part> parts;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const Primitive& primitive = mesh.primitives[i];
      const std::string where = place + ".primitives[" + std::to_string(i) + "]";
      Part part;
      part.shape = shape_of(primitive, pose, mesh.name.empty() ? place : mesh.name, where);
      if (part.shape >= 0) {
        const auto& geometry = scene_.shapes[static_cast<std::size_t>(part.shape)].geometry;
        const auto& triangles = std::get<TriangleMesh>(geometry);
        part.material = materials_.use(primitive.material, !triangles.colors.empty());
        note_missing_uv(triangles, scene_.materials[static_cast<std::size_t>(part.material)], where);
      }
      parts.push_back(part);
    }
    return parts;
  }

  // Primitives of the same accessors are one shape, whatever their materials; -1 for what has no triangles. Those of
  // skins are made for each.
  int shape_of(const Primitive& primitive, const Pose& pose, const std::string& label, const std::string& where) {
    const PrimitiveKey key(primitive.mode, primitive.indices, primitive.attributes, primitive.targets, pose.weights);
    const bool shared = pose.joints.empty();
    if (const auto found = primitives_.find(key); shared && found != primitives_.end()) return found->second;
    auto triangles = read_primitive(document_, primitive, pose, where_, where, notes_);
    const int shape = triangles ? static_cast<int>(scene_.shapes.size()) : -1;
    if (triangles) scene_.shapes.push_back({label, where_, std::move(*triangles)});
    if (shared && triangles) primitives_.emplace(key, shape);
    return shape;
  }

  void note_missing_uv(const TriangleMesh& mesh, const MaterialDescription& material, const std::string& place) {
    const TextureUse& use = material.reflectance_texture;
    if (use.texture < 0 || !(use.uv_set == 0 ? mesh.uv : mesh.uv_lightmap).empty()) return;
    notes_.add("a texture without texture coordinates is shown anyhow", place);
  }

  // What has a skin stands where its joints are, wherever its node is.
  void place_mesh(const PlacedNode& placed) {
    const Node& from = node(placed);
    if (from.mesh < 0) return;
    const std::string label = from.name.empty() ? name(placed) : from.name;
    if (from.skin >= 0) {
      notes_.add("skins stay as they are at rest", name(placed));
      return place_mesh(placed, Transform(), label);
    }
    if (from.instancing.empty()) return place_mesh(placed, placed.to_world, label);
    const std::vector<Transform> copies = copies_of(document_, from, where_, name(placed));
    for (std::size_t i = 0; i < copies.size(); ++i) {
      place_mesh(placed, placed.to_world * copies[i], label + "[" + std::to_string(i) + "]");
    }
  }

  void place_mesh(const PlacedNode& placed, const Transform& to_world, const std::string& label) {
    if (!to_world.is_finite()) throw Error(where_, name(placed) + " has a transform that is not finite");
    if (!to_world.is_invertible()) return notes_.add("what is scaled to nothing is left out", name(placed));
    const std::vector<Part>& all = parts(placed);
    const std::size_t number = scene_.instances.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].shape < 0) continue;
      scene_.instances.push_back({all[i].shape, all[i].material, to_world.rows(), where_,
                                  all.size() > 1 ? label + "/" + std::to_string(i) : label, number, label});
    }
  }

  void place_light(const PlacedNode& placed) {
    if (node(placed).light < 0) return;
    const auto slot = static_cast<std::size_t>(node(placed).light);
    const Light& from = document_.lights[slot];
    const std::string what = place("lights", slot, from.name);
    scene_.lights.push_back(placed_light(from, placed.to_world, where_, what, notes_));
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

  using PoseKey = std::tuple<int, int, std::vector<double>>;  // mesh, skin, weights
  using Accessors = std::map<std::string, int>;
  using PrimitiveKey = std::tuple<Mode, int, Accessors, std::vector<Accessors>, std::vector<double>>;

  Location where_;
  Document document_;
  bool has_choice_;
  SceneDescription scene_;
  Notes notes_;
  MaterialTable materials_;
  std::map<PoseKey, std::vector<Part>> shapes_;
  std::map<PrimitiveKey, int> primitives_;
  std::vector<Transform> to_world_;  // of all nodes, if a skin asks
  bool has_camera_ = false;
};

}  // namespace
}  // namespace gltf

SceneDescription read_gltf_scene(const std::string& path, const ReadOptions& options, Diagnostics& diagnostics) {
  return gltf::Reader(path, options, diagnostics).read();
}

}  // namespace bdpt_tool
