// Warps of the unit square have the densities they claim.
#include "sampling/warp.h"
#include "statistics.h"

#include <gtest/gtest.h>

#include <functional>

namespace bdpt::sampling_warp_test {

using statistics::chi_square_test;
using statistics::kSignificance;
using statistics::Uniform;

constexpr int kSamples = 200000, kRows = 12, kColumns = 16;

// `place` maps the warp's value to the square such that uniform there is what the density means.
void expect_uniform(const std::function<Vec2(float, float)>& place, const char* what) {
  Uniform uniform(17);
  std::vector<double> observed(kRows * kColumns), expected(kRows * kColumns, double(kSamples) / (kRows * kColumns));
  for (int i = 0; i < kSamples; ++i) {
    const float u0 = uniform(), u1 = uniform();
    const Vec2 p = place(u0, u1);
    ASSERT_TRUE(p.x > -1e-5f && p.x < 1.00001f && p.y > -1e-5f && p.y < 1.00001f) << what << p.x << ' ' << p.y;
    const int row = std::clamp(int(p.x * kRows), 0, kRows - 1),
              column = std::clamp(int(p.y * kColumns), 0, kColumns - 1);
    ++observed[size_t(row * kColumns + column)];
  }
  EXPECT_GT(chi_square_test(observed, expected), kSignificance / 5) << what;
}

float turn(float x, float y) {
  const float phi = std::atan2(y, x) / kTwoPi;
  return phi < 0 ? phi + 1 : phi;
}

TEST(SamplingWarp, DiskIsUniform) {
  expect_uniform(
      [](float u0, float u1) {
        const Vec2 d = sample_disk(u0, u1);
        return Vec2(d.x * d.x + d.y * d.y, turn(d.x, d.y));
      },
      "disk");
}

TEST(SamplingWarp, CosineHemisphere) {
  expect_uniform(
      [](float u0, float u1) {
        const Vec3 w = sample_cosine_hemisphere(u0, u1);
        EXPECT_NEAR(length(w), 1, 1e-5);
        return Vec2(w.x * w.x + w.y * w.y, turn(w.x, w.y));  // sin^2 is uniform
      },
      "hemisphere");
}

TEST(SamplingWarp, Sphere) {
  expect_uniform(
      [](float u0, float u1) {
        const Vec3 w = sample_sphere(u0, u1);
        EXPECT_NEAR(length(w), 1, 1e-5);
        return Vec2((w.z + 1) / 2, turn(w.x, w.y));
      },
      "sphere");
}

TEST(SamplingWarp, ConesFromNarrowToAll) {
  for (float one_minus_cos : {1e-6f, 1e-2f, 0.5f, 1.0f, 1.9f})
    expect_uniform(
        [=](float u0, float u1) {
          const Vec3 w = sample_cone(u0, u1, one_minus_cos);
          EXPECT_NEAR(length(w), 1, 1e-5);
          // 1 - cos without cancellation where the cone is narrow
          const float from_axis = w.z > 0.5f ? (w.x * w.x + w.y * w.y) / (1 + w.z) : 1 - w.z;
          return Vec2(from_axis / one_minus_cos, turn(w.x, w.y));
        },
        "cone");
}

TEST(SamplingWarp, TriangleIsUniform) {
  expect_uniform(
      [](float u0, float u1) {
        const Vec2 b = sample_triangle(u0, u1);
        EXPECT_GE(b.x, 0);
        EXPECT_GE(b.y, 0);
        EXPECT_LE(b.x + b.y, 1.000001f);
        const float c = b.x + b.y;  // its square is uniform, and so is what part of it is x
        return Vec2(c * c, c > 0 ? b.x / c : 0);
      },
      "triangle");
}

}  // namespace bdpt::sampling_warp_test
