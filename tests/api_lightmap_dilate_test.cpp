// Gutters: filled from their own chart, as far as asked, and from nothing that is not a number.
#include "api_scene.h"

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

namespace bdpt_api::api_lightmap_dilate_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Image {
  uint32_t width, height, channels;
  std::vector<float> pixels;
  std::vector<uint8_t> mask;
  std::vector<uint32_t> charts;  // empty = none are given

  Image(uint32_t w, uint32_t h, uint32_t c = 1)
      : width(w), height(h), channels(c), pixels(size_t(w) * h * c), mask(size_t(w) * h) {}
  size_t at(uint32_t x, uint32_t y) const { return size_t(y) * width + x; }
  bdpt_lightmap_dilate_desc desc(uint32_t steps) {
    bdpt_lightmap_dilate_desc d = make<bdpt_lightmap_dilate_desc>();
    d.width = width, d.height = height, d.channels = channels, d.steps = steps;
    d.pixels = pixels.data(), d.pixels_capacity = pixels.size() * sizeof(float);
    d.mask = mask.data(), d.mask_capacity = mask.size();
    if (!charts.empty()) d.charts = charts.data(), d.charts_capacity = charts.size() * sizeof(uint32_t);
    return d;
  }
  bdpt_lightmap_dilate_report dilate(uint32_t steps) {
    const bdpt_lightmap_dilate_desc d = desc(steps);
    bdpt_lightmap_dilate_report report = make<bdpt_lightmap_dilate_report>();
    EXPECT_OK(bdpt_lightmap_dilate(&d, &report));
    return report;
  }
};

TEST(ApiLightmapDilate, AChartOfOneTexelGrowsByARingAStep) {
  for (const uint32_t steps : {1u, 2u, 3u, 7u}) {
    Image image(9, 9, 2);
    std::fill(image.pixels.begin(), image.pixels.end(), -1.0f);
    image.mask[image.at(4, 4)] = 200;
    image.pixels[2 * image.at(4, 4)] = 0.1f;
    image.pixels[2 * image.at(4, 4) + 1] = 3;
    const bdpt_lightmap_dilate_report r = image.dilate(steps);
    const int reach = std::min(int(steps), 4);
    EXPECT_EQ(uint64_t((2 * reach + 1) * (2 * reach + 1) - 1), r.filled);
    EXPECT_EQ(80 - r.filled, r.left);
    EXPECT_EQ(0u, r.not_finite);
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 9; ++x) {
        const bool inside = std::max(std::abs(x - 4), std::abs(y - 4)) <= reach;
        const size_t i = image.at(uint32_t(x), uint32_t(y));
        EXPECT_EQ(inside ? 0.1f : -1, image.pixels[2 * i]);
        EXPECT_EQ(inside ? 3 : -1, image.pixels[2 * i + 1]);
        EXPECT_EQ(x == 4 && y == 4 ? 200 : inside, image.mask[i]);
      }
  }
}

TEST(ApiLightmapDilate, ATexelTakesTheMeanOfTheStepBefore) {
  Image row(5, 1);
  row.pixels = {1, 0, 0, 0, 5};
  row.mask = {1, 0, 0, 0, 1};
  EXPECT_EQ(2u, row.dilate(1).filled);
  EXPECT_EQ((std::vector<float>{1, 1, 0, 5, 5}), row.pixels);
  EXPECT_EQ((std::vector<uint8_t>{1, 1, 0, 1, 1}), row.mask);
  EXPECT_EQ(1u, row.dilate(1).filled);
  EXPECT_EQ((std::vector<float>{1, 1, 3, 5, 5}), row.pixels);
}

TEST(ApiLightmapDilate, AGutterTakesTheChartOfMostOfItsNeighboursTheLowestOfEquals) {
  Image image(3, 2);
  image.pixels = {1, 9, 2, 1, 9, 2};
  image.mask = {1, 0, 1, 1, 0, 1};
  image.charts = {7, 0, 4, 7, 0, 4};
  image.dilate(1);
  EXPECT_EQ((std::vector<uint32_t>{7, 4, 4, 7, 4, 4}), image.charts);
  EXPECT_EQ((std::vector<float>{1, 2, 2, 1, 2, 2}), image.pixels);

  Image most(3, 2);
  most.pixels = {1, 9, 2, 1, 3, 9};
  most.mask = {1, 0, 1, 1, 1, 0};
  most.charts = {7, 0, 4, 7, 7, 0};
  most.dilate(1);
  EXPECT_EQ((std::vector<uint32_t>{7, 7, 4, 7, 7, 4}), most.charts);
  EXPECT_EQ((std::vector<float>{1, 5.0f / 3, 2, 1, 3, 2}), most.pixels);
}

TEST(ApiLightmapDilate, ATexelOfAChartTakesThatChartsValuesOnly) {
  Image image(4, 1);
  image.pixels = {1, 0, 0, 2};
  image.mask = {1, 0, 0, 1};
  image.charts = {1, 2, 2, 2};
  EXPECT_EQ(2u, image.dilate(3).filled);
  EXPECT_EQ((std::vector<float>{1, 2, 2, 2}), image.pixels);
}

TEST(ApiLightmapDilate, WhatIsNotFiniteIsReplacedAndSpreadsNowhere) {
  Image image(7, 1, 2);
  image.pixels = {1, 2, kNan, 3, 0, 0, 0, 0, 0, 0, 0, 0, 5, std::numeric_limits<float>::infinity()};
  image.mask = {1, 1, 0, 0, 0, 0, 1};
  bdpt_lightmap_dilate_report r = image.dilate(2);
  EXPECT_EQ(2u, r.not_finite);
  EXPECT_EQ(2u, r.filled);
  EXPECT_EQ(4u, r.left);
  EXPECT_EQ((std::vector<uint8_t>{1, 1, 1, 0, 0, 0, 0}), image.mask);
  for (size_t i = 0; i < 6; ++i) EXPECT_EQ(i % 2 ? 2 : 1, image.pixels[i]);
  EXPECT_EQ(5, image.pixels[12]);
  EXPECT_TRUE(std::isinf(image.pixels[13]));
}

TEST(ApiLightmapDilate, TheValuesOfTexelsWithoutOneAreNotRead) {
  Image image(8, 8);
  std::fill(image.pixels.begin(), image.pixels.end(), kNan);
  image.mask[image.at(0, 7)] = 1;
  image.pixels[image.at(0, 7)] = 2;
  const bdpt_lightmap_dilate_report r = image.dilate(100);
  EXPECT_EQ(0u, r.not_finite + r.left);
  EXPECT_EQ(std::vector<float>(64, 2), image.pixels);
}

TEST(ApiLightmapDilate, AnImageWithoutValuesStaysAsItIs) {
  Image image(4, 4);
  const bdpt_lightmap_dilate_report r = image.dilate(3);
  EXPECT_EQ(0u, r.filled);
  EXPECT_EQ(16u, r.left);
}

// By the definition, all texels in each step.
void dilate_plainly(Image& image, uint32_t steps) {
  for (uint32_t step = 0; step < steps; ++step) {
    const Image before = image;
    for (int y = 0; y < int(image.height); ++y)
      for (int x = 0; x < int(image.width); ++x) {
        const size_t i = image.at(uint32_t(x), uint32_t(y));
        if (before.mask[i]) continue;
        const auto for_each = [&](auto&& visit) {
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
              const int nx = x + dx, ny = y + dy;
              if (nx < 0 || ny < 0 || nx >= int(image.width) || ny >= int(image.height)) continue;
              if (const size_t n = before.at(uint32_t(nx), uint32_t(ny)); before.mask[n]) visit(n);
            }
        };
        uint32_t chart = before.charts[i];
        if (chart == 0) {
          std::map<uint32_t, int> votes;
          for_each([&](size_t n) { ++votes[before.charts[n]]; });
          int most = 0;
          for (const auto& [id, n] : votes)
            if (n > most) most = n, chart = id;
        }
        std::vector<double> sum(image.channels);
        int n = 0;
        for_each([&](size_t from) {
          if (before.charts[from] != chart) return;
          for (uint32_t c = 0; c < image.channels; ++c) sum[c] += before.pixels[from * image.channels + c];
          ++n;
        });
        if (n == 0) continue;
        for (uint32_t c = 0; c < image.channels; ++c) image.pixels[i * image.channels + c] = float(sum[c] / n);
        image.mask[i] = 1;
        image.charts[i] = chart;
      }
  }
}

TEST(ApiLightmapDilate, RandomImagesAreFilledAsTheDefinitionSays) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    Image image(1 + random() % 24, 1 + random() % 24, 1 + random() % 5);
    image.charts.resize(image.mask.size());
    const float density = number(random);
    for (size_t i = 0; i < image.mask.size(); ++i) {
      image.mask[i] = number(random) < density * density;
      image.charts[i] = image.mask[i] ? 1 + random() % 3 : random() % 8 == 0 ? 1 + random() % 3 : 0;
    }
    for (float& v : image.pixels) v = number(random);
    Image expected = image;
    const uint32_t steps = 1 + random() % 6;
    dilate_plainly(expected, steps);
    image.dilate(steps);
    EXPECT_EQ(expected.pixels, image.pixels);
    EXPECT_EQ(expected.mask, image.mask);
    EXPECT_EQ(expected.charts, image.charts);
  }
}

TEST(ApiLightmapDilate, NoChartTakesAnothersValue) {
  std::mt19937 random(2);
  Image image(40, 30);
  image.charts.resize(image.mask.size());
  for (size_t i = 0; i < image.mask.size(); ++i)
    if (random() % 20 == 0) {
      image.mask[i] = 1;
      image.charts[i] = 1 + random() % 9;
      image.pixels[i] = float(image.charts[i]);
    }
  EXPECT_EQ(0u, image.dilate(1000).left);
  for (size_t i = 0; i < image.mask.size(); ++i) EXPECT_EQ(float(image.charts[i]), image.pixels[i]);
}

TEST(ApiLightmapDilate, BadInputIsRefusedAndNothingWritten) {
  const auto refused = [](const char* word, const std::function<void(bdpt_lightmap_dilate_desc&)>& change) {
    SCOPED_TRACE(word);
    Image image(4, 4);
    image.mask[5] = 1;
    image.charts.resize(16);
    const Image before = image;
    bdpt_lightmap_dilate_desc desc = image.desc(1);
    change(desc);
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_dilate(&desc, nullptr));
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), word)) << bdpt_last_error();
    EXPECT_EQ(before.mask, image.mask);
    EXPECT_EQ(before.pixels, image.pixels);
  };
  refused("width", [](auto& d) { d.width = 0; });
  refused("height", [](auto& d) { d.height = 0; });
  refused("height", [](auto& d) { d.height = 65537; });
  refused("texels", [](auto& d) { d.width = d.height = 65536; });
  refused("channels", [](auto& d) { d.channels = 0; });
  refused("channels", [](auto& d) { d.channels = 4097; });
  refused("reserved", [](auto& d) { d.reserved = 1; });
  refused("pixels_capacity", [](auto& d) { --d.pixels_capacity; });
  refused("pixels_capacity", [](auto& d) { d.width = 5, d.mask_capacity = d.charts_capacity = 1000; });
  refused("mask_capacity", [](auto& d) { --d.mask_capacity; });
  refused("charts_capacity", [](auto& d) { --d.charts_capacity; });
  refused("pixels", [](auto& d) { d.pixels = nullptr; });
  refused("pixels", [](auto& d) { d.pixels = reinterpret_cast<float*>(reinterpret_cast<char*>(d.pixels) + 1); });
  refused("mask", [](auto& d) { d.mask = nullptr; });
  refused("charts", [](auto& d) { d.charts = reinterpret_cast<uint32_t*>(reinterpret_cast<char*>(d.charts) + 2); });
  Image image(4, 4);
  const bdpt_lightmap_dilate_desc desc = image.desc(0);
  EXPECT_OK(bdpt_lightmap_dilate(&desc, nullptr));
}

TEST(ApiLightmapDilate, NoStepsMeansFour) {
  Image image(20, 1);
  image.mask[0] = 1;
  EXPECT_EQ(4u, image.dilate(0).filled);
}

}  // namespace bdpt_api::api_lightmap_dilate_test
