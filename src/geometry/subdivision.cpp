#include "geometry/subdivision.h"

#include "geometry/limit_surface.h"

#include <unordered_map>

namespace bdpt {
namespace {

constexpr uint32_t kNone = CageEdges::kNone;
constexpr float kSameNormal = 0.999f;  // cosine: 2.6 degrees
constexpr size_t kBatch = 4096;        // places of one displacement

bool is_same(const Vec3& a, const Vec3& b) {
  return dot(a, b) >= kSameNormal * std::sqrt(length_squared(a) * length_squared(b));
}
bool is_same(const Vec2& a, const Vec2& b) {
  const float scale = std::max({1.0f, std::fabs(a.x), std::fabs(a.y)});
  return std::max(std::fabs(a.x - b.x), std::fabs(a.y - b.y)) <= 1e-5f * scale;
}

// A point of the surface is one; its vertices differ where texture coordinates or normals do.
class Dicer {
 public:
  Dicer(const ControlCage& cage, const CageEdges& edges, uint32_t level, const RayDevice& device)
      : cage_(cage), edges_(edges), level_(level), surface_(device, cage), next_point_(cage.position_count()) {
    edge_base_ = next_point_;
    next_point_ += uint32_t(edges.count) * (level - 1);
    points_.resize(next_point_);
    vertex_of_.resize(next_point_, kNone);
  }

  void dice() {
    for (uint32_t face = 0; face < cage_.counts.size(); ++face) {
      const uint32_t n = cage_.counts[face];
      if (n == 4) {
        const uint32_t base = add_points((level_ - 1) * (level_ - 1));
        dice_quad(face, 0, level_, [&](uint32_t i, uint32_t j) { return point_of_quad(face, base, i, j); });
        continue;
      }
      const uint32_t half = level_ / 2, inner = half - 1;
      const uint32_t base = add_points(1 + n * inner + n * inner * inner);
      for (uint32_t k = 0; k < n; ++k)
        dice_quad(face, k, half, [&](uint32_t i, uint32_t j) { return point_of_part(face, k, base, i, j); });
    }
  }

  void displace(const Displace& displace) {
    std::vector<uint32_t> batch;
    std::vector<Vec3> positions, normals, displaced;
    std::vector<Vec2> uv;
    const auto flush = [&] {
      displaced = positions;
      displace(batch.size(), positions.data(), normals.data(), uv.data(), displaced.data());
      for (size_t i = 0; i < batch.size(); ++i) points_[batch[i]] = displaced[i];
      batch.clear(), positions.clear(), normals.clear(), uv.clear();
    };
    for (uint32_t point = 0; point < points_.size(); ++point) {
      if (vertex_of_[point] == kNone) continue;
      Vec3 normal(0);
      for (uint32_t v = vertex_of_[point]; v != kNone; v = vertices_[v].next) normal += unit_of(vertices_[v].normal);
      batch.push_back(point);
      positions.push_back(points_[point]);
      normals.push_back(unit_of(normal));
      uv.push_back(vertices_[vertex_of_[point]].uv);
      if (batch.size() == kBatch) flush();
    }
    if (!batch.empty()) flush();
    average_normals();
  }

  Diced result() {
    Diced d;
    d.positions.reserve(vertices_.size());
    for (const Vertex& v : vertices_) {
      d.positions.push_back(points_[v.point]);
      const Vec3 n = unit_of(v.normal);
      d.normals.push_back(n == Vec3(0) ? Vec3(0, 0, 1) : n);  // of triangles without an area alone
      if (!cage_.uv.empty()) d.uv.push_back(v.uv);
    }
    d.triangles = std::move(triangles_);
    return d;
  }

 private:
  struct Vertex {
    uint32_t point, next;  // next vertex of the point
    Vec3 normal;           // of any length
    Vec2 uv;
  };

  static Vec3 unit_of(const Vec3& v) {
    const float l2 = length_squared(v);
    return l2 > 0 ? v * (1 / std::sqrt(l2)) : Vec3(0);
  }

  uint32_t add_points(uint32_t n) {
    const uint32_t base = next_point_;
    next_point_ += n;
    points_.resize(next_point_);
    vertex_of_.resize(next_point_, kNone);
    return base;
  }

  // At k segments from the beginning of a corner's edge.
  uint32_t point_of_edge(uint32_t corner, uint32_t k) const {
    if (k == 0) return cage_.indices[corner];
    if (k == level_) return cage_.indices[edges_.next(corner)];
    const uint32_t opposite = edges_.opposite[corner];
    if (opposite != kNone && opposite < corner) k = level_ - k;
    return edge_base_ + edges_.edge[corner] * (level_ - 1) + k - 1;
  }
  uint32_t point_of_quad(uint32_t face, uint32_t base, uint32_t i, uint32_t j) const {
    const uint32_t c = edges_.first[face];
    if (j == 0) return point_of_edge(c, i);
    if (i == level_) return point_of_edge(c + 1, j);
    if (j == level_) return point_of_edge(c + 2, level_ - i);
    if (i == 0) return point_of_edge(c + 3, level_ - j);
    return base + (j - 1) * (level_ - 1) + i - 1;
  }
  // The quad at corner k of another face, between the middles of its edges and of the face.
  uint32_t point_of_part(uint32_t face, uint32_t k, uint32_t base, uint32_t i, uint32_t j) const {
    const uint32_t n = cage_.counts[face], half = level_ / 2, inner = half - 1;
    const uint32_t before = (k + n - 1) % n;
    if (j == 0) return point_of_edge(edges_.first[face] + k, i);
    if (i == 0) return point_of_edge(edges_.first[face] + before, level_ - j);
    if (i == half && j == half) return base;
    if (i == half) return base + 1 + k * inner + j - 1;
    if (j == half) return base + 1 + before * inner + i - 1;
    return base + 1 + n * inner + k * inner * inner + (j - 1) * inner + i - 1;
  }

  // Texture coordinates are linear on the faces.
  void uv_of_quad(uint32_t face, uint32_t k, Vec2 corner[4]) const {
    if (cage_.uv.empty()) {
      for (int i = 0; i < 4; ++i) corner[i] = Vec2(0);
      return;
    }
    const uint32_t n = cage_.counts[face], c = edges_.first[face];
    const auto at = [&](uint32_t i) { return cage_.uv[cage_.uv_indices[c + i % n]]; };
    if (n == 4) {
      for (uint32_t i = 0; i < 4; ++i) corner[i] = at(i);
      return;
    }
    Vec2 middle(0);
    for (uint32_t i = 0; i < n; ++i) middle += at(i) / float(n);
    corner[0] = at(k), corner[1] = (at(k) + at(k + 1)) * 0.5f, corner[2] = middle;
    corner[3] = (at(k) + at(k + n - 1)) * 0.5f;
  }

  template <class PointOf>
  void dice_quad(uint32_t face, uint32_t quad, uint32_t level, const PointOf& point_of) {
    places_.clear();
    for (uint32_t j = 0; j <= level; ++j)
      for (uint32_t i = 0; i <= level; ++i) places_.emplace_back(float(i) / float(level), float(j) / float(level));
    surface_.evaluate(face, quad, places_, positions_, normals_);
    Vec2 uv[4];
    uv_of_quad(face, quad, uv);
    grid_.clear();
    for (uint32_t j = 0; j <= level; ++j)
      for (uint32_t i = 0; i <= level; ++i) {
        const size_t k = grid_.size();
        const float u = places_[k].x, v = places_[k].y;
        const Vec2 at = (uv[0] * (1 - u) + uv[1] * u) * (1 - v) + (uv[3] * (1 - u) + uv[2] * u) * v;
        grid_.push_back(add_vertex(point_of(i, j), positions_[k], normals_[k], at));
      }
    const auto at = [&](uint32_t i, uint32_t j) { return grid_[j * (level + 1) + i]; };
    for (uint32_t j = 0; j < level; ++j)
      for (uint32_t i = 0; i < level; ++i) {
        triangles_.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        triangles_.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }

  uint32_t add_vertex(uint32_t point, const Vec3& position, const Vec3& normal, const Vec2& uv) {
    uint32_t* last = &vertex_of_[point];
    if (*last == kNone) points_[point] = position;
    for (; *last != kNone; last = &vertices_[*last].next) {
      Vertex& v = vertices_[*last];
      if (!is_same(v.normal, normal) || !is_same(v.uv, uv)) continue;
      v.normal += normal;
      return *last;
    }
    const auto added = uint32_t(vertices_.size());
    *last = added;
    vertices_.push_back({point, kNone, normal, uv});
    return added;
  }

  // Of the triangles round a point, but for those across a crease.
  void average_normals() {
    std::vector<Vec3> sums(vertices_.size(), Vec3(0));
    for (const Triangle& t : triangles_) {
      const Vec3 a = points_[vertices_[t.a].point];
      const Vec3 n = cross(points_[vertices_[t.b].point] - a, points_[vertices_[t.c].point] - a);
      for (uint32_t v : {t.a, t.b, t.c}) sums[v] += n;
    }
    std::vector<Vec3> means(vertices_.size(), Vec3(0));
    for (uint32_t v = 0; v < vertices_.size(); ++v)
      for (uint32_t w = vertex_of_[vertices_[v].point]; w != kNone; w = vertices_[w].next)
        if (is_same(vertices_[v].normal, vertices_[w].normal)) means[v] += sums[w];
    for (uint32_t v = 0; v < vertices_.size(); ++v) vertices_[v].normal = means[v];
  }

  const ControlCage& cage_;
  const CageEdges& edges_;
  const uint32_t level_;
  LimitSurface surface_;
  uint32_t next_point_, edge_base_;
  std::vector<Vec3> points_;
  std::vector<uint32_t> vertex_of_;  // the first of each point
  std::vector<Vertex> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Vec2> places_;  // of the quad in hand
  std::vector<Vec3> positions_, normals_;
  std::vector<uint32_t> grid_;
};

}  // namespace

CageFault find_edges(const ControlCage& cage, CageEdges& e) {
  const size_t corners = cage.indices.size();
  e.first.push_back(0);
  for (uint32_t face = 0; face < cage.counts.size(); ++face) {
    e.first.push_back(e.first.back() + cage.counts[face]);
    e.face.insert(e.face.end(), cage.counts[face], face);
  }
  const auto key = [&](uint32_t from, uint32_t to) { return uint64_t(from) << 32 | to; };
  std::unordered_map<uint64_t, uint32_t> directed;
  directed.reserve(corners);
  for (uint32_t c = 0; c < corners; ++c) {
    const uint32_t a = cage.indices[c], b = cage.indices[e.next(c)];
    const auto [place, is_new] = directed.try_emplace(key(a, b), c);
    if (!is_new) return {CageFault::Kind::Edge, a, b, {e.face[place->second], e.face[c]}};
  }
  e.opposite.resize(corners, kNone), e.edge.resize(corners);
  std::vector<uint32_t> some(cage.position_count(), kNone), faces(cage.position_count());
  for (uint32_t c = 0; c < corners; ++c) {
    const uint32_t a = cage.indices[c], b = cage.indices[e.next(c)];
    if (const auto found = directed.find(key(b, a)); found != directed.end()) e.opposite[c] = found->second;
    e.edge[c] = e.opposite[c] != kNone && e.opposite[c] < c ? e.edge[e.opposite[c]] : e.count++;
    some[a] = c;
    ++faces[a];
  }
  for (uint32_t v = 0; v < some.size(); ++v) {
    if (some[v] == kNone) continue;
    uint32_t reached = 1, c = some[v];
    while ((c = e.opposite[e.previous(c)]) != kNone && c != some[v]) ++reached;
    if (c == kNone)
      for (c = some[v]; e.opposite[c] != kNone;) c = e.next(e.opposite[c]), ++reached;
    if (reached != faces[v]) return {CageFault::Kind::Position, v, 0, {}};
  }
  return {};
}

DiceSize size_of_dice(const ControlCage& cage, const CageEdges& edges, uint32_t level) {
  DiceSize size;
  const uint64_t l = level, half = level / 2;
  uint64_t quads = 0, places = 0;
  for (const uint64_t n : cage.counts) {
    quads += n == 4 ? l * l : n * half * half;
    places += n == 4 ? (l + 1) * (l + 1) : n * (half + 1) * (half + 1);
  }
  size.points = cage.position_count() + edges.count * (l - 1) + places;  // at most
  size.triangles = 2 * quads;
  size.fits = size.points < 0xFFFFFFFEu && size.triangles < 0xFFFFFFFEu;
  // Points with their first vertex, vertices, what becomes of them, and triangles.
  size.bytes = size.points * (16 + 32 + 32 + 24) + size.triangles * sizeof(Triangle);
  return size;
}

Diced dice(const ControlCage& cage, const CageEdges& edges, uint32_t level, const RayDevice& device,
           const Displace& displace) {
  Dicer dicer(cage, edges, level, device);
  dicer.dice();
  if (displace) dicer.displace(displace);
  return dicer.result();
}

}  // namespace bdpt
