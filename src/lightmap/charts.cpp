#include "lightmap/charts.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace bdpt {
namespace {

// Disjoint sets; the lowest member stands for each.
class Sets {
 public:
  explicit Sets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;
};

void join_equal_vertices(const UvMesh& mesh, Sets& sets) {
  const auto key = [&](uint32_t i) {
    const Vec3d& p = mesh.positions[i];
    const Vec2d& t = mesh.texels[i];
    return std::tuple(p.x, p.y, p.z, t.x, t.y);
  };
  std::vector<uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  for (size_t i = 1; i < order.size(); ++i)
    if (key(order[i - 1]) == key(order[i])) sets.join(order[i - 1], order[i]);
}

}  // namespace

Charts find_charts(const std::vector<UvMesh>& meshes, uint32_t atlas) {
  Charts charts;
  for (const UvMesh& mesh : meshes) {
    std::vector<uint32_t>& ids = charts.of_triangles.emplace_back(mesh.triangles.size());
    if (mesh.atlas != atlas) continue;
    Sets sets(mesh.positions.size());
    join_equal_vertices(mesh, sets);
    for (const auto& t : mesh.triangles) sets.join(t[0], t[1]), sets.join(t[0], t[2]);
    std::vector<uint32_t> id_of_set(mesh.positions.size());
    for (size_t i = 0; i < ids.size(); ++i) {
      uint32_t& id = id_of_set[sets.find(mesh.triangles[i][0])];
      if (id == 0) id = ++charts.count;
      ids[i] = id;
    }
  }
  return charts;
}

}  // namespace bdpt
