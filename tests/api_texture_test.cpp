// Textures: every layout is read as it is said to be, and what is refused.
#include "api_builder.h"

#include <vector>

namespace bdpt_api::api_texture_test {

using ApiTexture = BuilderTest;

TEST_F(ApiTexture, EveryRefusalNamesFieldValueAndRemedy) {
  EXPECT_OK(try_texture([](bdpt_texture_desc& d) { d.label = "bricks"; }));
  const auto refused = [&](std::initializer_list<const char*> parts,
                           const std::function<void(bdpt_texture_desc&)>& change) {
    expect_refused(try_texture([&](bdpt_texture_desc& d) {
                     d.label = "bricks";
                     change(d);
                   }),
                   parts);
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "\"bricks\"")) << bdpt_last_error();
  };
  refused({"channels", "is 0", "from 1 to 4"}, [](auto& d) { d.channels = 0; });
  refused({"channels", "is 5", "from 1 to 4"}, [](auto& d) { d.channels = 5; });
  refused({"width", "is 0", "from 1 to 65536"}, [](auto& d) { d.width = 0; });
  refused({"height", "is 65537", "from 1 to 65536"}, [](auto& d) { d.height = 65537; });
  refused({"texel", "is 4", "0 to 3"}, [](auto& d) { d.texel = 4; });
  refused({"texel", "is -1", "0 to 3"}, [](auto& d) { d.texel = -1; });
  refused({"encoding", "is 2", "0 to 1"}, [](auto& d) { d.encoding = 2; });
  refused({"mip_levels", "is 18", "from 0 to 17"}, [](auto& d) { d.mip_levels = 18; });
  refused({"reserved", "is 9", "must be 0"}, [](auto& d) { d.reserved = 9; });
  refused({"pixels", "is NULL", "pass the texels"}, [](auto& d) { d.pixels = nullptr; });
  refused({"encoding", "is 1", "color_space", "leave it 0"},
          [](auto& d) { d.color_space = "sRGB - Texture", d.encoding = BDPT_ENCODING_LINEAR; });
  refused({"color_space", "no such space", "there are"}, [](auto& d) { d.color_space = "no such space"; });
}

TEST_F(ApiTexture, RowsMustHoldTheirTexels) {
  const auto refused = [&](std::initializer_list<const char*> parts,
                           const std::function<void(bdpt_texture_desc&)>& change) {
    expect_refused(try_texture(change), parts);
  };
  refused({"row_stride", "is 5", "multiple of 1 from 6", "0 for packed"}, [](auto& d) { d.row_stride = 5; });
  refused({"row_stride", "18446744073709551615", "4294967296"}, [](auto& d) { d.row_stride = ~uint64_t(0); });
  refused({"row_stride", "is 26", "multiple of 4 from 24"},
          [](auto& d) { d.texel = BDPT_TEXEL_FLOAT, d.row_stride = 26; });
  for (const bdpt_texel texel : {BDPT_TEXEL_UINT16, BDPT_TEXEL_HALF}) {
    refused({"row_stride", "is 13", "multiple of 2 from 12"}, [&](auto& d) { d.texel = texel, d.row_stride = 13; });
    refused({"pixels", "align it to 2 bytes"},
            [&](auto& d) { d.texel = texel, d.pixels = static_cast<const char*>(d.pixels) + 1; });
  }
  refused({"pixels", "align it to 4 bytes"},
          [](auto& d) { d.texel = BDPT_TEXEL_FLOAT, d.pixels = static_cast<const char*>(d.pixels) + 2; });
}

TEST_F(ApiTexture, ValuesAreFiniteAndNotNegative) {
  for (const float bad : {kNan, kInfinity, -0.5f}) {
    const float pixels[12] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, bad};
    for (const bdpt_encoding encoding : {BDPT_ENCODING_SRGB, BDPT_ENCODING_LINEAR})
      expect_refused(
          try_texture([&](auto& d) { d.texel = BDPT_TEXEL_FLOAT, d.encoding = encoding, d.pixels = pixels; }),
          {"pixels", "(1, 1)", "finite values of at least 0"});
  }
  constexpr uint16_t kHalfOne = 0x3C00, kHalfInfinity = 0x7C00, kHalfNan = 0x7E00, kHalfBelow = 0xB800;
  for (const uint16_t bad : {kHalfInfinity, kHalfNan, kHalfBelow}) {
    const uint16_t pixels[12] = {kHalfOne, 0, 0, bad};
    expect_refused(try_texture([&](auto& d) { d.texel = BDPT_TEXEL_HALF, d.pixels = pixels; }),
                   {"pixels", "(1, 0)", "finite values of at least 0"});
  }
  const float alpha[4] = {0.5f, 1, 0.5f, kNan};
  expect_refused(try_texture([&](auto& d) {
                   d.channels = 2, d.width = 2, d.height = 1, d.texel = BDPT_TEXEL_FLOAT, d.pixels = alpha;
                   d.color_space = "sRGB - Texture";
                 }),
                 {"pixels", "alpha", "(1, 0)", "finite values of at least 0"});
}

// In blocks of exactly their bytes, so that a sanitizer sees what is read beyond them.
TEST_F(ApiTexture, EveryFormatIsReadToTheLastTexelOnly) {
  constexpr uint32_t kSizes[] = {1, 4, 2, 2};
  for (bdpt_texel texel = BDPT_TEXEL_UINT8; texel <= BDPT_TEXEL_HALF; ++texel)
    for (uint32_t channels = 1; channels <= 4; ++channels)
      for (const uint32_t gap : {0u, 4u, 4096u})
        for (const bdpt_encoding encoding : {BDPT_ENCODING_SRGB, BDPT_ENCODING_LINEAR}) {
          const uint64_t row = uint64_t(3) * channels * kSizes[texel], stride = row + gap;
          const std::vector<uint8_t> block(stride + row);
          const auto exact = std::make_unique<uint8_t[]>(block.size());
          EXPECT_OK(try_texture([&](bdpt_texture_desc& d) {
            d.channels = channels, d.width = 3, d.height = 2, d.texel = texel, d.encoding = encoding;
            d.pixels = exact.get(), d.row_stride = gap ? stride : 0, d.mip_levels = 17;
          }));
        }
}

TEST_F(ApiTexture, NoSideTimesSideOverflows) {
  bdpt_context_desc limited = make<bdpt_context_desc>();
  limited.threads = 1;
  limited.memory_limit = uint64_t(64) << 20;
  const Context context = make_context(&limited);
  const Builder builder = make_builder(context.get());
  const uint64_t before = memory_in_use(context.get());
  const float pixel[4] = {};
  for (const uint32_t channels : {1u, 4u})
    for (bdpt_texel texel = BDPT_TEXEL_UINT8; texel <= BDPT_TEXEL_HALF; ++texel)
      for (const char* space : {static_cast<const char*>(nullptr), "sRGB - Texture"}) {
        bdpt_texture_desc desc = texture_desc(pixel, 65536, 65536);
        desc.label = "the sky";
        desc.channels = channels, desc.texel = texel, desc.mip_levels = 17, desc.color_space = space;
        bdpt_texture_id texture{7};
        expect_refused(bdpt_texture_add(builder.get(), &desc, &texture), {"the sky"}, BDPT_ERROR_MEMORY_LIMIT);
        EXPECT_EQ(0u, texture.id);
      }
  EXPECT_EQ(before, memory_in_use(context.get()));
}

TEST_F(ApiTexture, MemoryCountsAllLevelsAndIsGivenBack) {
  const uint64_t before = memory_in_use(context_.get());
  const std::vector<uint8_t> pixels(64 * 64);
  bdpt_texture_desc desc = texture_desc(pixels.data(), 64, 64);
  desc.channels = 1;
  desc.mip_levels = 17;
  bdpt_texture_id texture{};
  ASSERT_OK(bdpt_texture_add(b_, &desc, &texture));
  EXPECT_EQ(before + (4 * 4096 - 1) / 3, memory_in_use(context_.get()));
  ASSERT_OK(bdpt_texture_remove(b_, texture));
  EXPECT_EQ(before, memory_in_use(context_.get()));
}

}  // namespace bdpt_api::api_texture_test
