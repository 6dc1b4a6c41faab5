// SPDX-License-Identifier: Apache-2.0
#include "gltf/skins.h"

#include <cmath>

#include "gltf/accessor.h"

namespace bdpt_tool::gltf {
namespace {

Transform affine(const float* m, const Location& where, const std::string& place) {
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
    throw Error(where, place + ": the last row of an inverse bind matrix is not 0 0 0 1");
  }
  Transform result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) result.m[row][column] = static_cast<double>(m[4 * column + row]);
  }
  return result;
}

void add(Transform& sum, const Transform& t, double weight) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) sum.m[row][column] += weight * t.m[row][column];
  }
}

Vec3 get(const std::vector<float>& values, std::size_t at) { return {values[at], values[at + 1], values[at + 2]}; }

void set(std::vector<float>& values, std::size_t at, const Vec3& v) {
  for (std::size_t i = 0; i < 3; ++i) values[at + i] = static_cast<float>(v[i]);
}

// Cofactors turn normals, whatever the scale; what has no direction stays as it is.
Vec3 turned_normal(const Transform& t, const Vec3& n) {
  const Vec3 r0 = {t.m[0][0], t.m[0][1], t.m[0][2]}, r1 = {t.m[1][0], t.m[1][1], t.m[1][2]},
             r2 = {t.m[2][0], t.m[2][1], t.m[2][2]};
  const Vec3 turned = {dot(cross(r1, r2), n), dot(cross(r2, r0), n), dot(cross(r0, r1), n)};
  const double l = length(turned);
  return l > 0 && std::isfinite(l) ? normalized(turned) : n;
}

class Bender {
 public:
  Bender(const std::vector<Influences>& influences, const std::vector<Transform>& joints, const Location& where,
         const std::string& place)
      : influences_(influences), joints_(joints), where_(where), place_(place) {}

  // Weights that do not add up to 1 are scaled so.
  Transform blend(std::size_t vertex) const {
    Transform sum = {{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
    double weights = 0;
    for (const Influences& influence : influences_) {
      for (std::size_t i = 4 * vertex; i < 4 * vertex + 4; ++i) {
        const auto weight = static_cast<double>(influence.weights[i]);
        if (weight == 0) continue;
        const auto joint = static_cast<std::size_t>(influence.joints[i]);
        if (joint >= joints_.size()) {
          throw Error(where_, place_ + ": vertex " + std::to_string(vertex) + " follows joint " +
                                  std::to_string(joint) + " of " + std::to_string(joints_.size()));
        }
        add(sum, joints_[joint], weight);
        weights += weight;
      }
    }
    if (!(weights > 0)) throw Error(where_, place_ + ": vertex " + std::to_string(vertex) + " follows no joint");
    Transform mean = {{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
    add(mean, sum, 1 / weights);
    if (!mean.is_finite()) throw Error(where_, place_ + ": a joint's transform is not finite");
    return mean;
  }

 private:
  const std::vector<Influences>& influences_;
  const std::vector<Transform>& joints_;
  const Location& where_;
  const std::string& place_;
};

}  // namespace

std::vector<Transform> joint_matrices(const Document& document, int skin, const std::vector<Transform>& to_world,
                                      const Location& where) {
  const auto slot = static_cast<std::size_t>(skin);
  const Skin& from = document.skins[slot];
  const std::string what = place("skins", slot);
  std::vector<float> inverse;
  if (from.inverse_bind_matrices >= 0) {
    inverse = read_floats(document.accessors[static_cast<std::size_t>(from.inverse_bind_matrices)], 16, where,
                          what + ".inverseBindMatrices");
    if (inverse.size() / 16 < from.joints.size()) {
      throw Error(where, what + " has " + std::to_string(from.joints.size()) + " joints and " +
                             std::to_string(inverse.size() / 16) + " inverse bind matrices");
    }
  }
  std::vector<Transform> matrices;
  for (std::size_t i = 0; i < from.joints.size(); ++i) {
    const Transform& joint = to_world[static_cast<std::size_t>(from.joints[i])];
    matrices.push_back(inverse.empty() ? joint : joint * affine(&inverse[16 * i], where, what));
  }
  return matrices;
}

void bend(TriangleMesh& mesh, const std::vector<Influences>& influences, const std::vector<Transform>& joints,
          const Location& where, const std::string& place) {
  const Bender bender(influences, joints, where, place);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Transform t = bender.blend(v);
    set(mesh.positions, 3 * v, t.point(get(mesh.positions, 3 * v)));
    if (!mesh.normals.empty()) set(mesh.normals, 3 * v, turned_normal(t, get(mesh.normals, 3 * v)));
    if (!mesh.tangents.empty()) set(mesh.tangents, 4 * v, t.vector(get(mesh.tangents, 4 * v)));
  }
}

}  // namespace bdpt_tool::gltf
