// The readers of images: what pixels they give, and that headers which promise too much are refused before memory is
// taken.
//
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>

#include "image.h"
#include "pbrt/environment.h"
#include "temp_folder.h"

namespace bdpt_tool::tool_image_test {

std::string error_of(const std::string& name, const std::string& bytes) {
  try {
    decode_image(name, bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << text << "' lacks '" << part << "'";
}

std::string png(std::uint32_t width, std::uint32_t height, png_uint_32 format, const void* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = format;
  png_alloc_size_t size = 0;
  EXPECT_TRUE(png_image_write_get_memory_size(image, size, 0, pixels, 0, nullptr));
  std::string bytes(size, '\0');
  EXPECT_TRUE(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr));
  return bytes.substr(0, size);
}

TEST(ToolImage, PngKeepsItsAlphaAndItsSixteenBits) {
  const std::uint8_t rgba[] = {1, 2, 3, 4, 5, 6, 7, 8};
  const auto bytes = std::get<ByteImage>(decode_image("a.png", png(2, 1, PNG_FORMAT_RGBA, rgba)));
  EXPECT_EQ(bytes.channels, 4u);
  EXPECT_EQ(bytes.pixels, std::vector<std::uint8_t>(rgba, rgba + 8));
  const std::uint8_t grey[] = {7, 200, 255, 9};  // two of grey and alpha
  const auto expanded = std::get<ByteImage>(decode_image("a.png", png(2, 1, PNG_FORMAT_GA, grey)));
  EXPECT_EQ(expanded.pixels, (std::vector<std::uint8_t>{7, 7, 7, 200, 255, 255, 255, 9}));
}

TEST(ToolImage, SinglePaletteBitsMayGrow) {
  // A hundred thousand white pixels in a few hundred bytes are no bomb.
  const std::vector<std::uint8_t> white(1 << 20, 255);
  EXPECT_EQ(width_of(decode_image("a.png", png(1024, 1024, PNG_FORMAT_GRAY, white.data()))), 1024u);
}

TEST(ToolImage, HeadersThatPromiseMoreThanTheFileCanHoldAreRefused) {
  const std::uint8_t grey[] = {0};
  std::string huge = png(1, 1, PNG_FORMAT_GRAY, grey);
  for (const std::size_t at : {18, 22}) huge[at] = '\x70';  // 28672 x 28672
  // The check sum of the header no longer fits, which libpng finds first or not at all.
  EXPECT_NE(error_of("a.png", huge), "no error");
  std::string tga(18, '\0');
  tga[2] = 2;
  tga[12] = tga[14] = '\xFF';
  tga[13] = tga[15] = '\x7F';
  tga[16] = 24;
  expect_contains(error_of("a.tga", tga), "more than 2^28 pixels");
  tga[13] = tga[15] = '\x1F';
  expect_contains(error_of("a.tga", tga), "more pixels than the file can hold");
  expect_contains(error_of("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 20000 +X 10000\n"),
                  "more pixels than the file can hold");
  expect_contains(error_of("a.hdr", "#?RADIANCE\n\n-Y 99999 +X 1\n"), "larger than 65536");
  expect_contains(error_of("a.pfm", "PF\n60000 60000\n-1\n1234"), "cut off");
}

TEST(ToolImage, TgaIsReadPlainAndInRunsFromTopOrBottom) {
  std::string tga(18, '\0');
  tga[2] = 2;
  tga[12] = 2;
  tga[14] = 2;
  tga[16] = 24;
  const std::string pixels("\1\2\3\4\5\6\7\10\11\12\13\14", 12);
  const auto below = std::get<ByteImage>(decode_image("a.tga", tga + pixels));
  EXPECT_EQ(below.pixels, (std::vector<std::uint8_t>{9, 8, 7, 12, 11, 10, 3, 2, 1, 6, 5, 4}));
  tga[17] = 0x20;
  const auto above = std::get<ByteImage>(decode_image("a.tga", tga + pixels));
  EXPECT_EQ(above.pixels, (std::vector<std::uint8_t>{3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}));
  tga[2] = 10;
  const auto runs = std::get<ByteImage>(decode_image("a.tga", tga + std::string("\x82\1\2\3\0\4\5\6", 8)));
  EXPECT_EQ(runs.pixels, (std::vector<std::uint8_t>{3, 2, 1, 3, 2, 1, 3, 2, 1, 6, 5, 4}));
  expect_contains(error_of("a.tga", tga + std::string("\x85\1\2\3", 4)), "a run goes past its end");
  expect_contains(error_of("a.tga", tga + std::string("\x82\1\2", 3)), "cut off");
}

TEST(ToolImage, PfmHasItsLowestRowFirstInEitherOrderOfBytes) {
  const float values[] = {1, 2, 3, 4, 5, 6};
  std::string little(reinterpret_cast<const char*>(values), sizeof values), big = little;
  for (std::size_t i = 0; i < big.size(); i += 4) std::reverse(big.begin() + long(i), big.begin() + long(i) + 4);
  for (const std::string& text : {"PF\n1 2\n-1.0\n" + little, "PF\n1 2\n1.0\n" + big}) {
    EXPECT_EQ(std::get<Image>(decode_image("a.pfm", text)).pixels, (std::vector<float>{4, 5, 6, 1, 2, 3}));
  }
  EXPECT_EQ(std::get<Image>(decode_image("a.pfm", "Pf\n1 1\n-1\n" + little.substr(0, 4))).pixels,
            (std::vector<float>{1, 1, 1}));
  expect_contains(error_of("a.pfm", "PF\n1 2\n-1\n" + little.substr(1)), "cut off");
  expect_contains(error_of("a.pfm", "PF\n-1 2\n-1\n" + little), "header is damaged");
}

TEST(ToolImage, RadianceIsReadPlainAndInRuns) {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  const std::string flat = header + "-Y 1 +X 2\n" + std::string("\200\100\0\201\1\1\1\1", 8);
  const auto two = std::get<Image>(decode_image("a.hdr", flat));
  EXPECT_FLOAT_EQ(two.pixels[0], 128.5f / 128);  // 2^(129 - 136) of each half step up
  EXPECT_FLOAT_EQ(two.pixels[1], 64.5f / 128);
  EXPECT_EQ(two.pixels[3], two.pixels[0]);  // repeated once
  std::string runs = header + "-Y 1 +X 8\n" + std::string("\2\2\0\10", 4);
  for (const char c : {'\200', '\100', '\0', '\201'}) runs += std::string("\210") + c;
  const auto eight = std::get<Image>(decode_image("a.hdr", runs));
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(eight.pixels[i], two.pixels[i % 3]) << i;
  expect_contains(error_of("a.hdr", runs.substr(0, runs.size() - 1)), "cut off");
  runs[runs.size() - 2] = '\377';
  expect_contains(error_of("a.hdr", runs), "a run goes past its row");
}

TEST(ToolImage, EveryTruncationIsAnErrorOrAnImage) {
  const std::uint8_t rgba[64] = {1, 2, 3};
  const std::string bytes = png(4, 4, PNG_FORMAT_RGBA, rgba);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(error_of("a.png", bytes.substr(0, size)), "no error") << size;
  }
}

// Environments

TEST(ToolEnvironment, ClarbergsSquareKeepsAreasAndGoesThereAndBack) {
  double cosines = 0;
  const int n = 64;
  for (int i = 0; i < n * n; ++i) {
    const std::array<double, 2> place = {(i % n + 0.5) / n, (i / n + 0.5) / n};
    const Vec3 d = direction_of(place);
    EXPECT_NEAR(dot(d, d), 1, 1e-9);
    const auto back = square_of(d);
    EXPECT_NEAR(back[0], place[0], 1e-9);
    EXPECT_NEAR(back[1], place[1], 1e-9);
    cosines += d[0] > 0.5;  // a cap of a quarter of the sphere
  }
  EXPECT_NEAR(cosines / (n * n), 0.25, 0.01);
  EXPECT_NEAR(direction_of({0.5, 0.5})[2], 1, 1e-12);
}

// A bright spot in one direction of pbrt's is seen there, through whatever transform.
TEST(ToolEnvironment, PicturesAreSeenWhereTheFilePutThem) {
  const Vec3 bright = normalized({0.3, 0.5, 0.8});
  const std::uint32_t n = 64;
  Image square(n, n), rows(2 * n, n);
  for (std::uint32_t i = 0; i < n * n; ++i) {
    const double cosine = dot(direction_of({(i % n + 0.5) / n, (i / n + 0.5) / n}), bright);
    for (std::size_t c = 0; c < 3; ++c) square.pixels[3 * i + c] = cosine > 0.97 ? 1 : 0;
  }
  for (std::uint32_t i = 0; i < 2 * n * n; ++i) {
    const double phi = 2 * std::numbers::pi * (i % (2 * n) + 0.5) / (2 * n),
                 theta = std::numbers::pi * (i / (2 * n) + 0.5) / n;
    const Vec3 d = {std::cos(phi) * std::sin(theta), std::sin(phi) * std::sin(theta), std::cos(theta)};
    for (std::size_t c = 0; c < 3; ++c) rows.pixels[3 * i + c] = dot(d, bright) > 0.97 ? 1 : 0;
  }
  for (const Transform& to_world :
       {Transform{}, rotation(50, {1, 2, 3}), scaling(-1, 1, 1) * rotation(20, {1, 0, 0})}) {
    const Vec3 expected = normalized(to_world.vector(bright));
    for (const Image* image : {&square, &rows}) {
      const PlacedPicture placed = place_picture(*image, to_world);
      Transform turned;
      for (int i = 0; i < 12; ++i)
        turned.m[i / 4][i % 4] = static_cast<double>(placed.to_world[static_cast<std::size_t>(i)]);
      EXPECT_NEAR(turned.determinant(), 1, 1e-5);
      Vec3 mean = {};
      const std::uint32_t width = placed.image.width, height = placed.image.height;
      for (std::uint32_t i = 0; i < width * height; ++i) {
        const double longitude = 2 * std::numbers::pi * ((i % width + 0.5) / width - 0.5);
        const double latitude = std::numbers::pi * (0.5 - (i / width + 0.5) / height), c = std::cos(latitude);
        const Vec3 d = turned.vector({std::sin(longitude) * c, std::sin(latitude), -std::cos(longitude) * c});
        for (std::size_t k = 0; k < 3; ++k) mean[k] += c * static_cast<double>(placed.image.pixels[3 * i]) * d[k];
      }
      EXPECT_GT(dot(normalized(mean), expected), 0.999);
    }
  }
}

}  // namespace bdpt_tool::tool_image_test
