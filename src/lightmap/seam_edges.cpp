#include "lightmap/seam_edges.h"

#include "lightmap/weld.h"

#include <algorithm>
#include <tuple>

namespace bdpt {
namespace {

constexpr size_t kLookBack = 64;

// A triangle's edge from its corner to the next, or the other way round, so that it begins at the lower point.
struct HalfEdge {
  uint32_t low, high;  // points in the world
  uint32_t mesh, triangle;
  uint8_t from, to;  // corners
};

class SeamFinder {
 public:
  SeamFinder(const std::vector<UvMesh>& meshes, const SeamOptions& options) : meshes_(meshes), options_(options) {
    Weld weld(options.position_tolerance);
    for (uint32_t m = 0; m < meshes.size(); ++m) add_edges(m, weld);
    std::stable_sort(edges_.begin(), edges_.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    });
  }

  std::vector<Seam> find() const {
    std::vector<Seam> seams;
    for (size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
      while (end < edges_.size() && edges_[end].low == edges_[begin].low && edges_[end].high == edges_[begin].high)
        ++end;
      for (size_t i = begin + 1; i < end; ++i)
        if (const HalfEdge* partner = find_partner(i, begin)) seams.push_back({side(*partner), side(edges_[i])});
    }
    return seams;
  }

 private:
  void add_edges(uint32_t m, Weld& weld) {
    const UvMesh& mesh = meshes_[m];
    constexpr uint32_t kNone = 0xFFFFFFFFu;
    std::vector<uint32_t> points(mesh.positions.size(), kNone);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (has_no_world_area(mesh, t) || has_no_uv_area(mesh, t)) continue;
      for (const uint32_t v : mesh.triangles[t])
        if (points[v] == kNone) points[v] = weld.point(mesh.positions[v]);
      for (uint8_t i = 0; i < 3; ++i) {
        const uint8_t j = uint8_t((i + 1) % 3);
        const uint32_t a = points[mesh.triangles[t][i]], b = points[mesh.triangles[t][j]];
        if (a < b) edges_.push_back({a, b, m, t, i, j});
        if (b < a) edges_.push_back({b, a, m, t, j, i});
      }
    }
  }

  // The first edge before edge i on the same place that is another one in the atlas; none if one of them is the same.
  const HalfEdge* find_partner(size_t i, size_t begin) const {
    const HalfEdge* partner = nullptr;
    for (size_t k = begin; k < i && k - begin < kLookBack; ++k) {
      if (!fit(edges_[k], edges_[i])) continue;
      if (coincide(side(edges_[k]), side(edges_[i]))) return nullptr;
      if (!partner) partner = &edges_[k];
    }
    return partner;
  }

  bool fit(const HalfEdge& a, const HalfEdge& b) const {
    return normal(a, a.from).dot(normal(b, b.from)) >= options_.cos_angle &&
           normal(a, a.to).dot(normal(b, b.to)) >= options_.cos_angle;
  }
  Vec3d normal(const HalfEdge& e, int corner) const {
    const UvMesh& mesh = meshes_[e.mesh];
    if (mesh.normals.empty()) return mesh.area_vector(e.triangle).normalized();
    return mesh.normals[mesh.triangles[e.triangle][size_t(corner)]];
  }
  SeamSide side(const HalfEdge& e) const {
    const UvTriangle uv = meshes_[e.mesh].uv(e.triangle);
    return {meshes_[e.mesh].atlas, uv[e.from], uv[e.to]};
  }
  static bool coincide(const SeamSide& a, const SeamSide& b) {
    return a.atlas == b.atlas && (a.from - b.from).length() <= kTexelTolerance &&
           (a.to - b.to).length() <= kTexelTolerance;
  }

  const std::vector<UvMesh>& meshes_;
  const SeamOptions& options_;
  std::vector<HalfEdge> edges_;
};

}  // namespace

std::vector<Seam> find_seams(const std::vector<UvMesh>& meshes, const SeamOptions& options) {
  return SeamFinder(meshes, options).find();
}

}  // namespace bdpt
