// SPDX-License-Identifier: Apache-2.0
#include "gltf/nodes.h"

#include <cmath>

namespace bdpt_tool::gltf {
namespace {

constexpr int kNone = -1;

class Tree {
 public:
  Tree(const Document& document, const Location& where)
      : document_(document), where_(where), parents_(document.nodes.size(), kNone) {}

  std::vector<PlacedNode> placed() {
    find_parents();
    check_roots();
    return placed_below(document_.roots);
  }

  std::vector<PlacedNode> all_placed() {
    find_parents();
    std::vector<int> roots;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
      if (parents_[i] == kNone) roots.push_back(static_cast<int>(i));
    }
    return placed_below(roots);
  }

 private:
  void find_parents() {
    for (std::size_t i = 0; i < document_.nodes.size(); ++i) {
      for (const int child : document_.nodes[i].children) set_parent(child, static_cast<int>(i));
    }
    check_cycles();
  }

  std::vector<PlacedNode> placed_below(const std::vector<int>& roots) const {
    std::vector<PlacedNode> placed;
    std::vector<PlacedNode> open;
    push(roots, Transform(), open);
    while (!open.empty()) {
      const PlacedNode next = open.back();
      open.pop_back();
      placed.push_back(next);
      push(node(next.node).children, next.to_world, open);
    }
    return placed;
  }

  const Node& node(int index) const { return document_.nodes[static_cast<std::size_t>(index)]; }
  std::string name(int index) const { return place("nodes", static_cast<std::size_t>(index), node(index).name); }
  [[noreturn]] void fail(int index, const std::string& text) const { throw Error(where_, name(index) + " " + text); }

  void set_parent(int child, int parent) {
    int& known = parents_[static_cast<std::size_t>(child)];
    if (known != kNone)
      fail(child, "is a child of " + name(known) + " and of " + name(parent) + "; it may have one parent");
    known = parent;
  }

  void check_roots() const {
    std::vector<bool> seen(parents_.size());
    for (const int root : document_.roots) {
      const auto slot = static_cast<std::size_t>(root);
      if (parents_[slot] != kNone) fail(root, "is a root of the scene and a child of " + name(parents_[slot]));
      if (seen[slot]) fail(root, "is a root of the scene twice");
      seen[slot] = true;
    }
  }

  // Walks up from every node, as far as no walk has been; one that meets itself goes round.
  void check_cycles() const {
    std::vector<int> walks(parents_.size(), kNone);
    for (int first = 0; first < static_cast<int>(parents_.size()); ++first) {
      int n = first;
      while (n != kNone && walks[static_cast<std::size_t>(n)] == kNone) {
        walks[static_cast<std::size_t>(n)] = first;
        n = parents_[static_cast<std::size_t>(n)];
      }
      if (n != kNone && walks[static_cast<std::size_t>(n)] == first) fail(n, "is its own ancestor");
    }
  }

  Transform local(int index) const {
    const Node& n = node(index);
    if (!n.matrix) {
      if (n.rotation == std::array<double, 4>{}) fail(index, "has a rotation of length zero");
      return compose(n.translation, n.rotation, n.scale);
    }
    const std::array<double, 16>& m = *n.matrix;
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
      fail(index, "has a matrix whose last row is not 0 0 0 1; apply it to the mesh");
    }
    Transform result;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 4; ++column) result.m[row][column] = m[4 * column + row];
    }
    return result;
  }

  // In reverse, so that the first is taken first.
  void push(const std::vector<int>& nodes, const Transform& parent, std::vector<PlacedNode>& open) const {
    for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) {
      const Transform to_world = parent * local(*it);
      if (!to_world.is_finite()) fail(*it, "has a transform that is not finite");
      open.push_back({*it, to_world});
    }
  }

  const Document& document_;
  const Location& where_;
  std::vector<int> parents_;
};

}  // namespace

std::vector<PlacedNode> place_nodes(const Document& document, const Location& where) {
  return Tree(document, where).placed();
}

std::vector<Transform> transforms_to_world(const Document& document, const Location& where) {
  std::vector<Transform> transforms(document.nodes.size());
  for (const PlacedNode& placed : Tree(document, where).all_placed()) {
    transforms[static_cast<std::size_t>(placed.node)] = placed.to_world;
  }
  return transforms;
}

Transform compose(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                  const std::array<double, 3>& scale) {
  const double norm =
      rotation[0] * rotation[0] + rotation[1] * rotation[1] + rotation[2] * rotation[2] + rotation[3] * rotation[3];
  const double s = 2 / norm;
  const auto [x, y, z, w] = rotation;
  Transform t;
  t = {{{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), 0},
        {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w), 0},
        {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y), 0}}};
  t = t * scaling(scale[0], scale[1], scale[2]);
  for (std::size_t i = 0; i < 3; ++i) t.m[i][3] = translation[i];
  return t;
}

}  // namespace bdpt_tool::gltf
