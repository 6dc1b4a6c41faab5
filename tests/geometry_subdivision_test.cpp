// Subdivision surfaces: what is known of their limit, and that the triangles are closed.
#include "geometry/limit_surface.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <random>
#include <set>

namespace bdpt::geometry_subdivision_test {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

ControlCage cage_of(std::vector<Vec3> positions, std::vector<uint32_t> counts, std::vector<uint32_t> indices) {
  ControlCage cage;
  cage.positions = std::move(positions);
  cage.positions.resize(cage.positions.size() + 2, Vec3(0));
  cage.counts = std::move(counts), cage.indices = std::move(indices);
  return cage;
}

// Corner i has -1 or 1 in x, y and z by its bits.
ControlCage cube() {
  std::vector<Vec3> p;
  for (int i = 0; i < 8; ++i) p.emplace_back(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
  return cage_of(p, std::vector<uint32_t>(6, 4),
                 {4, 5, 7, 6, 1, 0, 2, 3, 0, 4, 6, 2, 5, 1, 3, 7, 6, 7, 3, 2, 0, 1, 5, 4});
}
ControlCage tetrahedron() {
  return cage_of({Vec3(1, 1, 1), Vec3(-1, -1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1)}, std::vector<uint32_t>(4, 3),
                 {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}
// Sides of four corners between two pentagons.
ControlCage prism() {
  std::vector<Vec3> p;
  std::vector<uint32_t> counts = {5, 5}, indices = {4, 3, 2, 1, 0, 5, 6, 7, 8, 9};
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < 5; ++i)
      p.emplace_back(float(std::cos(0.4 * M_PI * i)), float(std::sin(0.4 * M_PI * i)), side ? 1.0f : -1.0f);
  for (uint32_t i = 0; i < 5; ++i) {
    counts.push_back(4);
    for (uint32_t v : {i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i}) indices.push_back(v);
  }
  return cage_of(p, counts, indices);
}
ControlCage square() {
  return cage_of({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}, {4}, {0, 1, 2, 3});
}

Diced diced(const ControlCage& cage, uint32_t level, const Displace& displace = {}) {
  CageEdges edges;
  EXPECT_EQ(find_edges(cage, edges).kind, CageFault::Kind::None);
  const DiceSize size = size_of_dice(cage, edges, level);
  Diced d = dice(cage, edges, level, *scenes::device(), displace);
  EXPECT_EQ(size.triangles, d.triangles.size());
  EXPECT_GE(size.points, d.positions.size());
  return d;
}

// Vertices by position alone, to the bit.
struct Welded {
  std::vector<Triangle> triangles;
  size_t points = 0;
  explicit Welded(const Diced& d) {
    std::map<std::array<float, 3>, uint32_t> numbers;
    const auto number = [&](uint32_t v) {
      const Vec3 p = d.positions[v];
      return numbers.try_emplace({p.x, p.y, p.z}, uint32_t(numbers.size())).first->second;
    };
    for (const Triangle& t : d.triangles) triangles.push_back({number(t.a), number(t.b), number(t.c)});
    points = numbers.size();
  }
  // V - E + F, of which every edge must have two triangles that turn alike.
  long euler() const {
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const Triangle& t : triangles)
      for (const auto& e : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)})
        EXPECT_TRUE(edges.insert(e).second);
    for (const auto& [a, b] : edges) EXPECT_TRUE(edges.count({b, a}));
    return long(points) - long(edges.size() / 2) + long(triangles.size());
  }
};

double volume(const Diced& d) {
  double six = 0;
  for (const Triangle& t : d.triangles) six += double(dot(d.positions[t.a], cross(d.positions[t.b], d.positions[t.c])));
  return six / 6;
}

// (n² P + 4 sum E + sum F) / (n (n + 5)) with the neighbours along edges and across faces (Halstead et al. 1993).
TEST(GeometrySubdivision, ACubesCornersGoWhereTheFormulaSays) {
  const Diced d = diced(cube(), 4);
  int found = 0;
  for (const Vec3& p : d.positions) {
    EXPECT_LT(largest(p), 0.9f);
    if (std::fabs(std::fabs(p.x) - 0.5f) + std::fabs(std::fabs(p.y) - 0.5f) + std::fabs(std::fabs(p.z) - 0.5f) < 1e-5f)
      ++found;
  }
  EXPECT_EQ(found, 8);
}

TEST(GeometrySubdivision, ASymmetricCageHasASymmetricSurface) {
  const Diced d = diced(cube(), 6);
  for (const Vec3& p : d.positions)
    for (const Vec3& image : {Vec3(p.y, p.z, p.x), Vec3(-p.x, p.y, p.z), Vec3(p.y, p.x, p.z)}) {
      float nearest = 1;
      for (const Vec3& q : d.positions) nearest = std::min(nearest, length(q - image));
      EXPECT_LT(nearest, 1e-5f);
    }
}

TEST(GeometrySubdivision, IsClosedWhereTheCageIs) {
  for (const auto& [cage, even_only] : {std::pair(cube(), false), {tetrahedron(), true}, {prism(), true}})
    for (const uint32_t level : {1u, 2u, 3u, 4u, 8u}) {
      if (even_only && level % 2) continue;
      const Diced d = diced(cage, level);
      const Welded welded(d);
      EXPECT_EQ(welded.euler(), 2) << level;
      EXPECT_GT(volume(d), 0);
      EXPECT_EQ(welded.points, d.positions.size());  // smooth: nothing is split
    }
}

TEST(GeometrySubdivision, NormalsAreUnitAndThoseOfTheTriangles) {
  for (const ControlCage& cage : {cube(), tetrahedron(), prism()}) {
    const Diced d = diced(cage, 16);
    for (const Vec3& n : d.normals) EXPECT_NEAR(length(n), 1, 1e-5f);
    for (const Triangle& t : d.triangles) {
      const Vec3 n = unit(cross(d.positions[t.b] - d.positions[t.a], d.positions[t.c] - d.positions[t.a]));
      for (uint32_t v : {t.a, t.b, t.c}) EXPECT_GT(dot(n, d.normals[v]), 0.93f);
    }
  }
}

// Every edge of the cube, or every position.
TEST(GeometrySubdivision, SharpEdgesKeepACubeACube) {
  ControlCage cage = cube();
  for (uint32_t a = 0; a < 8; ++a)
    for (uint32_t axis : {1u, 2u, 4u})
      if (!(a & axis)) {
        cage.crease_edges.insert(cage.crease_edges.end(), {a, a | axis});
        cage.crease_weights.push_back(kInfinity);
      }
  const Diced d = diced(cage, 8);
  for (size_t i = 0; i < d.positions.size(); ++i) {
    EXPECT_NEAR(largest(d.positions[i]), 1, 1e-3f);
    EXPECT_GT(largest(d.normals[i]), 0.999f);
    EXPECT_GT(dot(d.positions[i], d.normals[i]), 0.99f);  // that of its own side
  }
  EXPECT_NEAR(volume(d), 8, 0.02);
  EXPECT_EQ(Welded(d).euler(), 2);
  EXPECT_EQ(d.positions.size(), 6u * 81);  // each side has its own
}

TEST(GeometrySubdivision, BoundariesAreAsAsked) {
  const auto corner = [](SubdivisionBoundary boundary) {
    ControlCage cage = square();
    cage.boundary = boundary;
    const Diced d = diced(cage, 4);
    for (const Vec3& n : d.normals) EXPECT_LT(length(n - Vec3(0, 0, 1)), 1e-5f);
    return d.positions[0];
  };
  EXPECT_LT(length(corner(SubdivisionBoundary::Smooth) - Vec3(1 / 6.0f, 1 / 6.0f, 0)), 1e-5f);
  EXPECT_EQ(corner(SubdivisionBoundary::PinCorners), Vec3(0));
  EXPECT_EQ(corner(SubdivisionBoundary::Pin), Vec3(0));
}

TEST(GeometrySubdivision, DisplacementGoesAlongTheNormalsGiven) {
  const auto raise = [](size_t count, const Vec3* p, const Vec3* n, const Vec2*, Vec3* displaced) {
    for (size_t i = 0; i < count; ++i) {
      EXPECT_EQ(displaced[i], p[i]);
      displaced[i] = p[i] + n[i] * 0.25f;
    }
  };
  for (const Vec3& p : diced(square(), 8, raise).positions) EXPECT_NEAR(p.z, 0.25f, 1e-6f);
  // A ball, and one of which each point is raised.
  const auto ball = [](float radius) {
    return [radius](size_t count, const Vec3* p, const Vec3*, const Vec2*, Vec3* displaced) {
      for (size_t i = 0; i < count; ++i) displaced[i] = unit(p[i]) * radius;
    };
  };
  for (const ControlCage& cage : {cube(), tetrahedron()}) {
    const Diced d = diced(cage, 32, ball(2));
    EXPECT_EQ(Welded(d).euler(), 2);
    EXPECT_NEAR(volume(d), 32 * M_PI / 3, 0.3);
    for (size_t i = 0; i < d.positions.size(); ++i) {
      EXPECT_NEAR(length(d.positions[i]), 2, 1e-5f);
      EXPECT_GT(dot(d.positions[i], d.normals[i]), 1.98f);  // of the ball, not of the cage
    }
  }
}

// Each side of the cube shows the whole picture: seams split vertices, but no points.
TEST(GeometrySubdivision, TextureSeamsAreClosed) {
  ControlCage cage = cube();
  cage.uv = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  for (uint32_t i = 0; i < 24; ++i) cage.uv_indices.push_back(i % 4);
  size_t asked = 0;
  const Diced d = diced(cage, 4, [&](size_t count, const Vec3* p, const Vec3* n, const Vec2* uv, Vec3* displaced) {
    asked += count;
    for (size_t i = 0; i < count; ++i) displaced[i] = p[i] + n[i] * (0.1f * std::sin(9 * uv[i].x + 5 * uv[i].y));
  });
  const Welded welded(d);
  EXPECT_EQ(welded.euler(), 2);
  EXPECT_EQ(asked, welded.points);
  EXPECT_GT(d.positions.size(), welded.points);
  // The area of all triangles in the picture is that of six.
  double area = 0;
  for (const Triangle& t : d.triangles) {
    const Vec2 a = d.uv[t.b] - d.uv[t.a], b = d.uv[t.c] - d.uv[t.a];
    EXPECT_GT(a.x * b.y - a.y * b.x, 0);
    area += 0.5 * double(a.x * b.y - a.y * b.x);
  }
  EXPECT_NEAR(area, 6, 1e-5);
}

TEST(GeometrySubdivision, FaultsOfCagesAreFound) {
  using Kind = CageFault::Kind;
  const std::vector<Vec3> p = {Vec3(0),       Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
                               Vec3(1, 0, 1), Vec3(0, 0, 1), Vec3(2)};
  const auto fault = [&](const std::vector<uint32_t>& counts, const std::vector<uint32_t>& indices) {
    CageEdges edges;
    return find_edges(cage_of(p, counts, indices), edges);
  };
  EXPECT_EQ(fault({4, 4}, {0, 1, 2, 3, 1, 0, 5, 4}).kind, Kind::None);
  const CageFault twice = fault({4, 4}, {0, 1, 2, 3, 0, 1, 4, 5});
  EXPECT_EQ(twice.kind, Kind::Edge);
  EXPECT_EQ(twice.position + twice.other + twice.faces[0] + twice.faces[1], 2u);
  EXPECT_EQ(fault({4, 4, 3}, {0, 1, 2, 3, 1, 0, 5, 4, 0, 1, 6}).kind, Kind::Edge);  // three on an edge
  const CageFault bow = fault({3, 3}, {0, 1, 2, 0, 5, 6});
  EXPECT_EQ(bow.kind, Kind::Position);
  EXPECT_EQ(bow.position, 0u);
}

// Embree aborts where a cage is beyond it: whatever passes the checks must not be.
TEST(GeometrySubdivision, CagesOfAnyShapeAreDiced) {
  std::mt19937 random(3);
  const auto below = [&](uint32_t n) { return uint32_t(random() % n); };
  int sound = 0;
  for (int i = 0; i < 3000; ++i) {
    const uint32_t points = 3 + below(8), most = i % 10 == 0 ? 15 : 5;
    std::vector<Vec3> p;
    for (uint32_t k = 0; k < points; ++k)
      p.emplace_back(float(below(5)) * (i % 7 == 0 ? 1e16f : 1), float(below(3)), i % 5 == 0 ? 0.0f : float(below(4)));
    std::vector<uint32_t> counts, indices;
    for (uint32_t faces = 1 + below(8); faces-- > 0;) {
      std::vector<uint32_t> order(points);
      std::iota(order.begin(), order.end(), 0u);
      std::shuffle(order.begin(), order.end(), random);
      const uint32_t n = std::min(points, 3 + below(most - 2));
      // Now and then the back of the face before: pillows.
      if (!counts.empty() && below(3) == 0) {
        const std::vector<uint32_t> last(indices.rbegin(), indices.rbegin() + counts.back());
        indices.insert(indices.end(), last.begin(), last.end());
        counts.push_back(counts.back());
      } else {
        indices.insert(indices.end(), order.begin(), order.begin() + n);
        counts.push_back(n);
      }
    }
    ControlCage cage = cage_of(p, counts, indices);
    cage.boundary = SubdivisionBoundary(below(3));
    CageEdges edges;
    if (find_edges(cage, edges).kind != CageFault::Kind::None) continue;
    ++sound;
    for (uint32_t k = below(4); k > 0; --k) {
      const uint32_t c = below(uint32_t(indices.size()));
      if (edges.opposite[c] != CageEdges::kNone && edges.opposite[c] < c) continue;
      cage.crease_edges.insert(cage.crease_edges.end(), {indices[c], indices[edges.next(c)]});
      cage.crease_weights.push_back(below(2) ? kInfinity : float(below(4)));
    }
    if (below(3) == 0) cage.corners = {indices[0]}, cage.corner_weights = {below(2) ? kInfinity : 1.5f};
    const Diced d = dice(cage, edges, 4, *scenes::device(), {});
    for (size_t k = 0; k < d.positions.size(); ++k) {
      EXPECT_TRUE(std::isfinite(d.positions[k].x + d.positions[k].y + d.positions[k].z)) << i;
      EXPECT_NEAR(length(d.normals[k]), 1, 1e-4f) << i;
    }
  }
  EXPECT_GT(sound, 300);
  // As many faces at a position as may meet, in a fan and all round, of triangles and of four corners.
  for (const uint32_t sides : {3u, 4u})
    for (const bool closed : {false, true}) {
      const uint32_t n = ControlCage::kMostFaces;
      std::vector<Vec3> p = {Vec3(0, 0, 1)};
      std::vector<uint32_t> counts, indices;
      for (uint32_t i = 0; i <= 2 * n; ++i)
        p.emplace_back(std::cos(0.05f * float(i)), std::sin(0.05f * float(i)), 0.0f);
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t next = closed && i + 1 == n ? 0 : 2 * (i + 1);
        counts.push_back(sides);
        indices.insert(indices.end(), {0, 1 + 2 * i});
        if (sides == 4) indices.push_back(2 + 2 * i);
        indices.push_back(1 + next);
      }
      const Diced d = diced(cage_of(p, counts, indices), 2);
      for (const Vec3& q : d.positions) EXPECT_TRUE(std::isfinite(q.x + q.y + q.z));
    }
}

}  // namespace bdpt::geometry_subdivision_test
