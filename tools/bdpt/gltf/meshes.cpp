// SPDX-License-Identifier: Apache-2.0
#include "gltf/meshes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gltf/accessor.h"

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

void transform_uv(const TextureUse& texture, std::vector<float>& uv) {
  const auto& [offset, scale, rotation] = texture.transform;
  const double c = std::cos(rotation), s = std::sin(rotation);
  for (std::size_t i = 0; i < uv.size(); i += 2) {
    const double u = scale[0] * uv[i], v = scale[1] * uv[i + 1];
    uv[i] = static_cast<float>(c * u + s * v + offset[0]);
    uv[i + 1] = static_cast<float>(c * v - s * u + offset[1]);
  }
}

void turn_v_up(std::vector<float>& uv) {
  for (std::size_t i = 1; i < uv.size(); i += 2) uv[i] = 1 - uv[i];
}

class PrimitiveReader {
 public:
  PrimitiveReader(const Document& document, const Primitive& primitive, const Location& where, const std::string& place)
      : document_(document), primitive_(primitive), where_(where), place_(place) {}

  TriangleMesh read(const TextureUse& texture, Notes& notes) const {
    TriangleMesh mesh;
    mesh.positions = attribute("POSITION", 3, 0);
    mesh.normals = attribute("NORMAL", 3, mesh.vertex_count());
    mesh.uv = attribute("TEXCOORD_" + std::to_string(texture.uv_set), 2, mesh.vertex_count());
    transform_uv(texture, mesh.uv);
    turn_v_up(mesh.uv);
    mesh.uv_lightmap = attribute("TEXCOORD_1", 2, mesh.vertex_count());
    turn_v_up(mesh.uv_lightmap);
    if (texture.texture >= 0 && mesh.uv.empty())
      notes.add("a texture without texture coordinates is shown anyhow", place_);
    mesh.indices = triangles(primitive_.mode, vertices(mesh.vertex_count()));
    if (repair_zero_normals(mesh) > 0) notes.add("normals of length zero are made from the triangles", place_);
    return mesh;
  }

 private:
  [[noreturn]] void fail(const std::string& text) const { throw Error(where_, place_ + ": " + text); }

  // Empty if there is none; else `count` of them, 0 = any.
  std::vector<float> attribute(const std::string& name, int components, std::size_t count) const {
    const int accessor = primitive_.attribute(name);
    if (accessor < 0) return {};
    std::vector<float> values =
        read_floats(document_.accessors[static_cast<std::size_t>(accessor)], components, where_, place_ + " " + name);
    const std::size_t elements = values.size() / static_cast<std::size_t>(components);
    if (count > 0 && elements != count) {
      fail(name + " has " + std::to_string(elements) + " elements, POSITION has " + std::to_string(count));
    }
    return values;
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

std::optional<TriangleMesh> read_primitive(const Document& document, const Primitive& primitive,
                                           const TextureUse& texture, const Location& where, const std::string& place,
                                           Notes& notes) {
  if (primitive.mode < Mode::kTriangles) {
    notes.add("points and lines are left out", place);
    return std::nullopt;
  }
  if (primitive.attribute("POSITION") < 0) {
    notes.add("primitives without positions are left out", place);
    return std::nullopt;
  }
  if (primitive.has_targets) notes.add("morph targets are left out: meshes stay as they are at rest", place);
  if (primitive.attribute("COLOR_0") >= 0) notes.add("colours of vertices are left out", place);
  return PrimitiveReader(document, primitive, where, place).read(texture, notes);
}

}  // namespace bdpt_tool::gltf
