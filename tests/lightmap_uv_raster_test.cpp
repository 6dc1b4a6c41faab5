// Which texels a triangle touches, and how much of each.
#include "math/uv_raster.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

namespace bdpt::lightmap_uv_raster_test {

constexpr TexelRect kAll{0, 0, 8, 8};

std::map<std::pair<int64_t, int64_t>, double> areas(const UvTriangle& triangle, const TexelRect& bounds = kAll) {
  std::map<std::pair<int64_t, int64_t>, double> result;
  rasterize(triangle, bounds, [&](int64_t x, int64_t y, const TexelPolygon& polygon) {
    EXPECT_TRUE(result.emplace(std::pair(x, y), polygon.area()).second) << x << " " << y;
    EXPECT_LE(x, polygon.low(0));
    EXPECT_GE(x + 1, polygon.high(0));
    EXPECT_LE(y, polygon.low(1));
    EXPECT_GE(y + 1, polygon.high(1));
  });
  return result;
}

TEST(LightmapUvRaster, ATriangleOnTheGridTouchesTheTexelsItCutsAndNoNeighbours) {
  const auto found = areas({Vec2d(1, 1), Vec2d(3, 1), Vec2d(1, 3)});
  const std::map<std::pair<int64_t, int64_t>, double> expected{{{1, 1}, 1.0}, {{2, 1}, 0.5}, {{1, 2}, 0.5}};
  EXPECT_EQ(expected, found);
}

TEST(LightmapUvRaster, ATriangleWithinATexelKeepsItsArea) {
  const UvTriangle small{Vec2d(2.25, 5.25), Vec2d(2.75, 5.25), Vec2d(2.5, 5.75)};
  const std::map<std::pair<int64_t, int64_t>, double> expected{{{2, 5}, 0.125}};
  EXPECT_EQ(expected, areas(small));
}

TEST(LightmapUvRaster, ATexelIsCutIntoSevenCornersAtMost) {
  // All four sides cut it, and one corner lies inside.
  int corners = 0;
  rasterize({Vec2d(4.5, 4.9), Vec2d(2.9, 3.4), Vec2d(6.1, 3.4)}, kAll,
            [&](int64_t x, int64_t y, const TexelPolygon& p) {
              if (x == 4 && y == 4) corners = p.count;
            });
  EXPECT_EQ(5, corners);
  int most = 0;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-0.6, 1.6);
  for (int i = 0; i < 100000; ++i) {
    const UvTriangle t{Vec2d(number(random), number(random)), Vec2d(number(random), number(random)),
                       Vec2d(number(random), number(random))};
    rasterize(t, {0, 0, 1, 1}, [&](int64_t, int64_t, const TexelPolygon& p) { most = std::max(most, p.count); });
  }
  EXPECT_EQ(7, most);
}

TEST(LightmapUvRaster, AreasAddUpToTheTriangles) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(0, 8);
  for (int i = 0; i < 2000; ++i) {
    const UvTriangle t{Vec2d(number(random), number(random)), Vec2d(number(random), number(random)),
                       Vec2d(number(random), number(random))};
    double sum = 0;
    for (const auto& [texel, area] : areas(t)) sum += area;
    EXPECT_NEAR(area(t), sum, 1e-12);
  }
}

TEST(LightmapUvRaster, TexelsOutsideTheBoundsAreNotVisitedHoweverLargeTheTriangle) {
  const auto found = areas({Vec2d(-1e30, -1e30), Vec2d(1e30, -1e30), Vec2d(0, 1e30)}, {2, 3, 4, 5});
  EXPECT_EQ(4u, found.size());
  for (const auto& [texel, area] : found) EXPECT_EQ(1.0, area);
  EXPECT_TRUE(areas({Vec2d(9, 9), Vec2d(12, 9), Vec2d(9, 12)}).empty());
}

TEST(LightmapUvRaster, ATriangleWithoutAreaTouchesNothing) {
  EXPECT_TRUE(areas({Vec2d(1, 1), Vec2d(5, 5), Vec2d(3, 3)}).empty());
  EXPECT_TRUE(areas({Vec2d(1, 1), Vec2d(1, 1), Vec2d(1, 1)}).empty());
}

TEST(LightmapUvRaster, RowZeroIsTheTopOfTheTexture) {
  EXPECT_EQ(Vec2d(2, 0), to_texels(Vec2d(0.5, 1), 4, 8));
  EXPECT_EQ(Vec2d(0, 8), to_texels(Vec2d(0, 0), 4, 8));
  EXPECT_EQ(Vec2d(0.5, 0.25), to_uv(to_texels(Vec2d(0.5, 0.25), 4, 8), 4, 8));
}

}  // namespace bdpt::lightmap_uv_raster_test
