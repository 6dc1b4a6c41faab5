// Points are welded within the tolerance, wherever the cells' borders run.
#include "lightmap/weld.h"

#include <gtest/gtest.h>

#include <random>

namespace bdpt::lightmap_weld_test {

TEST(LightmapWeld, PointsWithinTheToleranceAreOneAndOthersAreNot) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-3, 3), jitter(-0.99, 0.99);
  for (const double tolerance : {1e-6, 0.01, 0.1}) {
    for (int i = 0; i < 2000; ++i) {
      Weld weld(tolerance);
      const Vec3d p(place(random), place(random), place(random));
      EXPECT_EQ(0u, weld.point(p));
      EXPECT_EQ(0u, weld.point(p + Vec3d(jitter(random), jitter(random), jitter(random)) * tolerance));
      Vec3d far = p;
      far[i % 3] += (i % 2 ? 1.01 : -1.01) * tolerance;
      EXPECT_EQ(1u, weld.point(far));
      EXPECT_EQ(0u, weld.point(p));
    }
  }
}

TEST(LightmapWeld, TheFirstOfTwoThatAreNearIsTaken) {
  Weld weld(1);
  EXPECT_EQ(0u, weld.point(Vec3d(0, 0, 0)));
  EXPECT_EQ(1u, weld.point(Vec3d(1.5, 0, 0)));
  EXPECT_EQ(0u, weld.point(Vec3d(0.9, 0, 0)));
  EXPECT_EQ(1u, weld.point(Vec3d(1.1, 0, 0)));
}

TEST(LightmapWeld, ZeroHasNoSign) {
  Weld weld(1e-300);
  EXPECT_EQ(0u, weld.point(Vec3d(0.0, 0.0, -0.0)));
  EXPECT_EQ(0u, weld.point(Vec3d(-0.0, 0.0, 0.0)));
}

}  // namespace bdpt::lightmap_weld_test
