// Textures: what is looked up where.
#include "geometry/texture.h"

#include "scenes.h"

#include <gtest/gtest.h>

#include <Imath/half.h>

namespace bdpt::texture_test {

TextureSampler sampler(TextureFilter filter, TextureWrap wrap, float level = 0) { return {wrap, wrap, filter, level}; }

// Texel (x, y) has the value x + 10 y; its centre is at the place returned.
Texture numbers(uint32_t width, uint32_t height, uint32_t levels = 1) {
  std::vector<float> texels;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) texels.push_back(float(x) + 10 * float(y));
  return scenes::texture(width, height, 1, texels, levels);
}
Vec2 center(int x, int y, int width, int height) {
  return {(float(x) + 0.5f) / float(width), 1 - (float(y) + 0.5f) / float(height)};
}

TEST(Texture, HasItsTexelsAtTheirCentres) {
  const Texture t = numbers(5, 3);
  for (TextureFilter filter : {TextureFilter::Nearest, TextureFilter::Bilinear})
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x)
        EXPECT_NEAR(t.lookup(center(x, y, 5, 3), sampler(filter, TextureWrap::Repeat))[0], float(x + 10 * y), 1e-4);
}

TEST(Texture, WrapsAsItIsTold) {
  const Texture t = numbers(4, 1);
  const auto at = [&](int x, TextureWrap wrap) {
    return t.lookup({(float(x) + 0.5f) / 4, 0.5f}, sampler(TextureFilter::Nearest, wrap))[0];
  };
  const float repeat[] = {1, 2, 3, 0, 1, 2, 3, 0, 1, 2}, mirror[] = {2, 3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0, 1},
              clamp[] = {0, 0, 0, 0, 1, 2, 3, 3, 3};
  for (int i = 0; i < 10; ++i) EXPECT_EQ(at(i - 3, TextureWrap::Repeat), repeat[i]) << i;
  for (int i = 0; i < 16; ++i) EXPECT_EQ(at(i - 6, TextureWrap::Mirror), mirror[i]) << i;
  for (int i = 0; i < 9; ++i) EXPECT_EQ(at(i - 3, TextureWrap::Clamp), clamp[i]) << i;
}

TEST(Texture, IsInterpolatedBetweenCentres) {
  const Texture t = numbers(4, 4);
  const Vec2 a = center(1, 1, 4, 4), b = center(2, 2, 4, 4);
  for (float s : {0.0f, 0.25f, 0.7f}) {
    const Vec2 uv(a.x + (b.x - a.x) * s, a.y);
    EXPECT_NEAR(t.lookup(uv, sampler(TextureFilter::Bilinear, TextureWrap::Repeat))[0], 11 + s, 1e-4);
    // B-splines keep lines, too.
    EXPECT_NEAR(t.lookup(uv, sampler(TextureFilter::Bicubic, TextureWrap::Clamp))[0], 11 + s, 2e-1);
  }
  const Texture line = numbers(8, 1);
  EXPECT_NEAR(line.lookup({4.3f / 8, 0.5f}, sampler(TextureFilter::Bicubic, TextureWrap::Clamp))[0], 3.8f, 1e-4);
}

TEST(Texture, BicubicStaysWithinTheTexels) {
  const Texture t = scenes::texture(4, 1, 1, {0, 1, 0, 0});
  for (int i = 0; i <= 400; ++i) {
    const float v = t.lookup({float(i) / 400, 0.5f}, sampler(TextureFilter::Bicubic, TextureWrap::Repeat))[0];
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 1);
  }
}

TEST(Texture, EachLevelHasTheMeanOfTheOneBefore) {
  const Texture t = numbers(5, 6, 17);
  ASSERT_EQ(t.levels(), 3u);  // 5 x 6, 2 x 3, 1 x 1
  EXPECT_FLOAT_EQ(t.texel(0, 0, 1)[0], (0 + 1 + 10 + 11) / 4.0f);
  EXPECT_FLOAT_EQ(t.texel(1, 0, 1)[0], (2 + 3 + 4 + 12 + 13 + 14) / 6.0f);
  const float last = t.texel(0, 0, 2)[0];
  EXPECT_FLOAT_EQ(t.lookup({0.3f, 0.3f}, sampler(TextureFilter::Bilinear, TextureWrap::Repeat, 9))[0], last);
  const auto level = [&](float l) {
    return t.lookup({0.3f, 0.3f}, sampler(TextureFilter::Nearest, TextureWrap::Clamp, l))[0];
  };
  EXPECT_FLOAT_EQ(level(1.25f), 0.75f * level(1) + 0.25f * last);
}

TEST(Texture, KeepsEachFormat) {
  const auto one = [](TexelFormat format, uint32_t channels, bool srgb, const auto& values) {
    TextureImage image;
    image.width = image.height = 1;
    image.channels = channels;
    image.format = format;
    image.srgb = srgb;
    const auto* bytes = reinterpret_cast<const std::byte*>(std::data(values));
    image.texels.assign(bytes, bytes + std::size(values) * sizeof(values[0]));
    return Texture(std::move(image)).lookup({0.5f, 0.5f});
  };
  const uint8_t bytes[] = {255, 128, 0, 51};
  EXPECT_EQ(one(TexelFormat::Uint8, 4, true, bytes), (Rgba{1, srgb_to_linear(128 / 255.0f), 0, 0.2f}));
  const uint8_t grey_alpha[] = {51, 102};
  EXPECT_EQ(one(TexelFormat::Uint8, 2, false, grey_alpha), (Rgba{0.2f, 0.2f, 0.2f, 0.4f}));
  const uint16_t shorts[] = {65535, 13107, 0};
  EXPECT_EQ(one(TexelFormat::Uint16, 3, false, shorts), (Rgba{1, 0.2f, 0, 1}));
  const uint16_t halves[] = {imath_float_to_half(0.25f)};
  EXPECT_EQ(one(TexelFormat::Half, 1, false, halves), (Rgba{0.25f, 0.25f, 0.25f, 1}));
}

}  // namespace bdpt::texture_test
