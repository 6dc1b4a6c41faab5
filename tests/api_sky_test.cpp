// The analytic sky: the paper's values, where the sun is, and what is refused.
#include "api_scene.h"

#include <cmath>

namespace bdpt_api::api_sky_test {

constexpr uint32_t kWidth = 72, kHeight = 36;

bdpt_sky_desc sky_desc(float x, float y, float z, float turbidity = 3) {
  bdpt_sky_desc desc = make<bdpt_sky_desc>();
  desc.width = kWidth, desc.height = kHeight;
  desc.to_sun[0] = x, desc.to_sun[1] = y, desc.to_sun[2] = z;
  desc.turbidity = turbidity;
  desc.ground[1] = 7;
  return desc;
}

std::vector<float> fill(const bdpt_sky_desc& desc) {
  std::vector<float> pixels(size_t(desc.width) * desc.height * 3);
  EXPECT_OK(bdpt_sky_fill(&desc, pixels.data(), pixels.size()));
  return pixels;
}
double luminance(const std::vector<float>& pixels, uint32_t x, uint32_t y) {
  const float* p = &pixels[(size_t(y) * kWidth + x) * 3];
  return 0.2126729 * p[0] + 0.7151522 * p[1] + 0.0721750 * p[2];
}

TEST(ApiSky, TheZenithIsAsBrightAsThePaperSays) {
  for (double angle : {20.0, 45.0, 70.0}) {
    const double a = angle * M_PI / 180;
    bdpt_sky_desc desc = sky_desc(float(std::sin(a)), float(std::cos(a)), 0);
    desc.height = 4001, desc.width = 1;
    // Y_z of turbidity 3, kcd/m².
    const double expected =
        (4.0453 * 3 - 4.9710) * std::tan((4.0 / 9 - 3.0 / 120) * (M_PI - 2 * a)) - 0.2155 * 3 + 2.4192;
    EXPECT_NEAR(luminance(fill(desc), 0, 0), expected, 0.01 * expected) << angle;
  }
}

TEST(ApiSky, IsBrightestRoundTheSunAndAlikeOnBothSides) {
  const std::vector<float> pixels = fill(sky_desc(1, 0.8f, 0));  // to the right: column 3/4
  double most = 0;
  uint32_t column = 0;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      ASSERT_TRUE(std::isfinite(luminance(pixels, x, y)));
      if (y < kHeight / 2 && luminance(pixels, x, y) > most) most = luminance(pixels, x, y), column = x;
      if (y >= kHeight / 2) {
        EXPECT_FLOAT_EQ(pixels[(size_t(y) * kWidth + x) * 3 + 1], 7);
      }
      const uint32_t mirrored = (3 * kWidth / 2 - 1 - x) % kWidth;  // the sun's meridian
      EXPECT_NEAR(luminance(pixels, x, y), luminance(pixels, mirrored, y), 1e-3 * luminance(pixels, x, y));
    }
  EXPECT_NEAR(column, 3 * kWidth / 4 - 0.5, 1);
  // Away from the sun the sky is blue.
  const float* blue = &pixels[(size_t(8) * kWidth + kWidth / 4) * 3];
  EXPECT_GT(blue[2], 1.3f * blue[0]);
}

TEST(ApiSky, WhatMakesNoSenseIsRefused) {
  std::vector<float> pixels(kWidth * kHeight * 3);
  const auto expect = [&](const char* field, bdpt_sky_desc desc, uint64_t capacity) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_sky_fill(&desc, pixels.data(), capacity)) << field;
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), field)) << bdpt_last_error();
  };
  expect("to_sun", sky_desc(1, -0.1f, 0), pixels.size());
  expect("to_sun", sky_desc(0, 0, 0), pixels.size());
  expect("turbidity", sky_desc(0, 1, 0, 1), pixels.size());
  expect("turbidity", sky_desc(0, 1, 0, 11), pixels.size());
  expect("capacity", sky_desc(0, 1, 0), pixels.size() - 1);
  bdpt_sky_desc desc = sky_desc(0, 1, 0);
  desc.width = 0;
  expect("width", desc, pixels.size());
  desc = sky_desc(0, 1, 0);
  desc.ground[0] = -1;
  expect("ground", desc, pixels.size());
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_sky_fill(&desc, nullptr, pixels.size()));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_sky_fill(nullptr, pixels.data(), pixels.size()));
}

}  // namespace bdpt_api::api_sky_test
