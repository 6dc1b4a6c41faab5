// SPDX-License-Identifier: Apache-2.0
#include "gltf/meshes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gltf/accessor.h"
#include "gltf/skins.h"

namespace bdpt_tool::gltf {
namespace {

// The triangles of a strip or a fan, wound as the format says.
std::vector<std::uint32_t> triangles(Mode mode, std::vector<std::uint32_t> vertices) {
  if (mode == Mode::kTriangles) return vertices;
  std::vector<std::uint32_t> result;
  result.reserve(3 * (vertices.size() - 2));
  for (std::size_t i = 0; i + 2 < vertices.size(); ++i) {
    if (mode == Mode::kTriangleFan) {
      result.insert(result.end(), {vertices[i + 1], vertices[i + 2], vertices[0]});
    } else {
      result.insert(result.end(), {vertices[i], vertices[i + 1 + i % 2], vertices[i + 2 - i % 2]});
    }
  }
  return result;
}

void turn_v_up(std::vector<float>& uv) {
  for (std::size_t i = 1; i < uv.size(); i += 2) uv[i] = 1 - uv[i];
}

bool are_sound(const std::vector<float>& tangents) {
  for (std::size_t i = 0; i < tangents.size(); i += 4) {
    const float* t = &tangents[i];
    if ((t[0] == 0 && t[1] == 0 && t[2] == 0) || std::abs(t[3]) != 1) return false;
  }
  return true;
}

class PrimitiveReader {
 public:
  PrimitiveReader(const Document& document, const Primitive& primitive, const Location& where, const std::string& place)
      : document_(document), primitive_(primitive), where_(where), place_(place) {}

  TriangleMesh read(const Pose& pose, Notes& notes) const {
    TriangleMesh mesh;
    mesh.positions = posed("POSITION", 3, 0, pose);
    mesh.normals = posed("NORMAL", 3, mesh.vertex_count(), pose);
    mesh.tangents = posed("TANGENT", 4, mesh.vertex_count(), pose);
    mesh.uv = posed("TEXCOORD_0", 2, mesh.vertex_count(), pose);
    mesh.uv_lightmap = posed("TEXCOORD_1", 2, mesh.vertex_count(), pose);
    mesh.colors = colors(mesh.vertex_count(), pose);
    turn_v_up(mesh.uv);
    turn_v_up(mesh.uv_lightmap);
    if (!pose.joints.empty()) bend(mesh, influences(mesh.vertex_count()), pose.joints, where_, place_);
    if (!are_sound(mesh.tangents)) {
      notes.add("tangents of length zero, or without a sign, are made anew", place_);
      mesh.tangents.clear();
    }
    mesh.indices = triangles(primitive_.mode, vertices(mesh.vertex_count()));
    if (repair_zero_normals(mesh) > 0) notes.add("normals of length zero are made from the triangles", place_);
    return mesh;
  }

 private:
  [[noreturn]] void fail(const std::string& text) const { throw Error(where_, place_ + ": " + text); }

  // Empty if there is none; else `count` of them, 0 = any.
  std::vector<float> attribute(const std::string& name, int components, std::size_t count) const {
    return elements(primitive_.attribute(name), name, components, count);
  }

  std::vector<float> elements(int accessor, const std::string& name, int components, std::size_t count) const {
    if (accessor < 0) return {};
    std::vector<float> values =
        read_floats(document_.accessors[static_cast<std::size_t>(accessor)], components, where_, place_ + " " + name);
    const std::size_t elements = values.size() / static_cast<std::size_t>(components);
    if (count > 0 && elements != count) {
      fail(name + " has " + std::to_string(elements) + " elements, POSITION has " + std::to_string(count));
    }
    return values;
  }

  // With what the morph targets add. A target of tangents leaves their fourth component as it is.
  std::vector<float> posed(const std::string& name, int components, std::size_t count, const Pose& pose) const {
    std::vector<float> values = attribute(name, components, count);
    const auto width = static_cast<std::size_t>(components);
    const std::size_t moved = name == "TANGENT" ? 3 : width;
    for (std::size_t t = 0; t < std::min(pose.weights.size(), primitive_.targets.size()); ++t) {
      const auto found = primitive_.targets[t].find(name);
      if (found == primitive_.targets[t].end() || pose.weights[t] == 0 || values.empty()) continue;
      const std::vector<float> offsets = elements(found->second, "targets[" + std::to_string(t) + "]." + name,
                                                  static_cast<int>(moved), values.size() / width);
      for (std::size_t i = 0; i < offsets.size(); ++i) {
        values[i / moved * width + i % moved] += static_cast<float>(pose.weights[t]) * offsets[i];
      }
    }
    return values;
  }

  // Opaque where the file has three components.
  std::vector<float> colors(std::size_t count, const Pose& pose) const {
    const int accessor = primitive_.attribute("COLOR_0");
    if (accessor < 0) return {};
    if (document_.accessors[static_cast<std::size_t>(accessor)].components != 3) {
      return posed("COLOR_0", 4, count, pose);
    }
    const std::vector<float> rgb = posed("COLOR_0", 3, count, pose);
    std::vector<float> rgba(4 * count, 1.0f);
    for (std::size_t i = 0; i < rgb.size(); ++i) rgba[i / 3 * 4 + i % 3] = rgb[i];
    return rgba;
  }

  std::vector<Influences> influences(std::size_t count) const {
    std::vector<Influences> all;
    for (std::size_t set = 0; primitive_.attribute("JOINTS_" + std::to_string(set)) >= 0; ++set) {
      const std::string number = std::to_string(set);
      all.push_back({attribute("JOINTS_" + number, 4, count), attribute("WEIGHTS_" + number, 4, count)});
      if (all.back().weights.empty()) fail("JOINTS_" + number + " without WEIGHTS_" + number);
    }
    if (all.empty()) fail("has a skin, and no JOINTS_0");
    return all;
  }

  std::vector<std::uint32_t> vertices(std::size_t count) const {
    std::vector<std::uint32_t> vertices;
    if (primitive_.indices < 0) {
      vertices.resize(count);
      std::iota(vertices.begin(), vertices.end(), 0u);
    } else {
      vertices =
          read_indices(document_.accessors[static_cast<std::size_t>(primitive_.indices)], where_, place_ + " indices");
      const std::uint32_t greatest = *std::max_element(vertices.begin(), vertices.end());
      if (greatest >= count) {
        fail("vertex " + std::to_string(greatest) + " does not exist, there are " + std::to_string(count));
      }
    }
    if (vertices.size() < 3 || (primitive_.mode == Mode::kTriangles && vertices.size() % 3 != 0)) {
      fail(std::to_string(vertices.size()) + " vertices make no whole number of triangles");
    }
    return vertices;
  }

  const Document& document_;
  const Primitive& primitive_;
  const Location& where_;
  const std::string& place_;
};

}  // namespace

std::optional<TriangleMesh> read_primitive(const Document& document, const Primitive& primitive, const Pose& pose,
                                           const Location& where, const std::string& place, Notes& notes) {
  if (primitive.mode < Mode::kTriangles) {
    notes.add("points and lines are left out", place);
    return std::nullopt;
  }
  if (primitive.attribute("POSITION") < 0) {
    notes.add("primitives without positions are left out", place);
    return std::nullopt;
  }
  if (!primitive.targets.empty()) notes.add("morph targets stay as they are at rest", place);
  return PrimitiveReader(document, primitive, where, place).read(pose, notes);
}

}  // namespace bdpt_tool::gltf
