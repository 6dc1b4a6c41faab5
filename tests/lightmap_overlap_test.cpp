// The sweep finds the pairs, and the areas, that looking at all pairs does.
#include "lightmap/overlap.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace bdpt::lightmap_overlap_test {

using Pairs = std::map<std::pair<size_t, size_t>, double>;

Pairs overlaps(const std::vector<UvTriangle>& triangles, double height) {
  Pairs found;
  for_each_overlap(triangles, height, [&](const UvOverlap& o) {
    EXPECT_LT(o.a, o.b);
    EXPECT_TRUE(found.emplace(std::pair(o.a, o.b), o.area).second) << o.a << " " << o.b;
    return true;
  });
  return found;
}

// The area that two triangles share, by counting on a grid of points.
double count_area(const UvTriangle& a, const UvTriangle& b, int n, double size) {
  const auto inside = [](const UvTriangle& t, const Vec2d& p) {
    const double d0 = signed_double_area(t[0], t[1], p), d1 = signed_double_area(t[1], t[2], p),
                 d2 = signed_double_area(t[2], t[0], p);
    return (d0 >= 0 && d1 >= 0 && d2 >= 0) || (d0 <= 0 && d1 <= 0 && d2 <= 0);
  };
  int hits = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vec2d p((x + 0.5) * size / n, (y + 0.5) * size / n);
      hits += inside(a, p) && inside(b, p);
    }
  return hits * size * size / (double(n) * n);
}

std::vector<UvTriangle> random_triangles(size_t count, double extent, double size, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, extent), offset(-size, size);
  std::vector<UvTriangle> triangles;
  while (triangles.size() < count) {
    const Vec2d p(place(random), place(random));
    UvTriangle t;
    for (Vec2d& corner : t) corner = p + Vec2d(offset(random), offset(random));
    if (area(t) > 1e-3) triangles.push_back(t);
  }
  return triangles;
}

TEST(LightmapOverlap, AreasAreThoseThatPointsCount) {
  const std::vector<UvTriangle> triangles = random_triangles(8, 8, 6, 1);
  const Pairs found = overlaps(triangles, 8);
  EXPECT_GT(found.size(), 5u);
  for (size_t a = 0; a < triangles.size(); ++a)
    for (size_t b = a + 1; b < triangles.size(); ++b) {
      // Points count within [0, 20] only: move both there.
      UvTriangle p = triangles[a], q = triangles[b];
      for (Vec2d& c : p) c += Vec2d(6, 6);
      for (Vec2d& c : q) c += Vec2d(6, 6);
      const auto it = found.find({a, b});
      EXPECT_NEAR(count_area(p, q, 1000, 20), it == found.end() ? 0 : it->second, 0.05) << a << " " << b;
    }
}

TEST(LightmapOverlap, TheSweepFindsEachPairOnce) {
  for (const double size : {0.5, 3.0, 40.0}) {
    std::vector<UvTriangle> triangles = random_triangles(300, 64, size, 2);
    for (const UvTriangle& t : random_triangles(20, 64, 30, 3)) triangles.push_back(t);
    const Pairs found = overlaps(triangles, 64);
    Pairs expected;
    for (size_t a = 0; a < triangles.size(); ++a)
      for (size_t b = a + 1; b < triangles.size(); ++b)
        for (const auto& [pair, shared] : overlaps({triangles[a], triangles[b]}, 64)) expected[{a, b}] = shared;
    EXPECT_EQ(expected.size(), found.size());
    for (const auto& [pair, shared] : expected) {
      const auto it = found.find(pair);
      ASSERT_NE(found.end(), it);
      EXPECT_NEAR(shared, it->second, 1e-9);
    }
  }
}

}  // namespace bdpt::lightmap_overlap_test
