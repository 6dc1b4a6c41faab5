// Colour spaces through the header: the context's, conversions, errors that help, and views of it.
#include "api_scene.h"
#include "temp_folder.h"

#include <array>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>

namespace bdpt_api::api_color_test {

using Color = std::array<float, 3>;

Context context_in(const char* config, const char* space) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.threads = 1;
  desc.color_config = config;
  desc.rendering_space = space;
  return make_context(&desc);
}

bdpt_result try_context(const char* config, const char* space) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.color_config = config;
  desc.rendering_space = space;
  bdpt_context* context = nullptr;
  const bdpt_result result = bdpt_context_create(BDPT_ABI, &desc, &context);
  EXPECT_EQ(nullptr, context);
  return result;
}

Color convert(const Context& context, const char* from, const char* to, Color color) {
  EXPECT_OK(bdpt_color_convert(context.get(), from, to, color.data(), 1));
  return color;
}

void expect_text(const char* part) { EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), part)) << bdpt_last_error(); }

TEST(ApiColor, TheRenderingSpaceIsRec709UnlessAnotherIsNamed) {
  bdpt_color_info info = make<bdpt_color_info>();
  const Context plain = context_in(nullptr, nullptr);
  EXPECT_OK(bdpt_color_get_info(plain.get(), &info));
  EXPECT_STREQ("Linear Rec.709 (sRGB)", info.rendering_space);
  EXPECT_EQ(0.64f, info.chromaticities.red[0]);
  EXPECT_NEAR(0.7152f, info.luminance[1], 1e-4f);
  const Context aces = context_in(nullptr, "ACEScg");
  EXPECT_OK(bdpt_color_get_info(aces.get(), &info));
  EXPECT_STREQ("ACEScg", info.rendering_space);
  EXPECT_EQ(0.713f, info.chromaticities.red[0]);
  EXPECT_EQ(0.33767f, info.chromaticities.white[1]);
  // S-2014-004's second row.
  EXPECT_NEAR(0.2722287f, info.luminance[0], 1e-6f);
  EXPECT_NEAR(0.6740818f, info.luminance[1], 1e-6f);
  EXPECT_NEAR(1, std::accumulate(info.luminance, info.luminance + 3, 0.0f), 1e-6f);
}

TEST(ApiColor, ConvertsBetweenNamedSpaces) {
  const Context context = context_in(nullptr, "ACEScg");
  const Color red = convert(context, "lin_rec709", nullptr, {1, 0, 0});
  EXPECT_NEAR(0.61309740f, red[0], 1e-5f);
  EXPECT_NEAR(0.07019372f, red[1], 1e-5f);
  EXPECT_NEAR(0.02061559f, red[2], 1e-5f);
  EXPECT_EQ(red, convert(context, "Linear Rec.709 (sRGB)", "acescg", {1, 0, 0}));
  const Color back = convert(context, nullptr, "lin_rec709", red);
  EXPECT_NEAR(1, back[0], 1e-5f);
  EXPECT_NEAR(0, back[1], 1e-5f);
  const Color same = convert(context, nullptr, nullptr, {0.1f, 0.2f, 0.3f});
  EXPECT_EQ((Color{0.1f, 0.2f, 0.3f}), same);
  EXPECT_OK(bdpt_color_convert(context.get(), "sRGB", nullptr, nullptr, 0));
}

TEST(ApiColor, ConvertsByChromaticities) {
  const bdpt_chromaticities acescg = {{0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}};
  Color color = {0.5f, 0.2f, 0.1f};
  EXPECT_OK(bdpt_color_convert_chromaticities(nullptr, &acescg, color.data(), 1));
  const Color named = convert(context_in(nullptr, nullptr), nullptr, "ACEScg", {0.5f, 0.2f, 0.1f});
  for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(named[c], color[c], 1e-6f);
  bdpt_chromaticities line = acescg;
  line.green[0] = line.red[0], line.green[1] = line.red[1];
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_color_convert_chromaticities(&line, nullptr, color.data(), 1));
  expect_text("on a line");
}

TEST(ApiColor, NamesThatAreWrongBringCloseOnes) {
  const Context context = context_in(nullptr, nullptr);
  float rgb[3] = {0.25f, 0.5f, 1};
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_color_convert(context.get(), "ACES_cg", nullptr, rgb, 1));
  expect_text("did you mean 'ACEScg'");
  EXPECT_EQ(0.25f, rgb[0]);
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_context(nullptr, "ACEScgg"));
  expect_text("did you mean 'ACEScg'");
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_context(nullptr, "sRGB"));
  expect_text("not linear");
}

TEST(ApiColor, ConfigurationsThatCannotBeReadAreTold) {
  const bdpt::TempFolder folder;
  EXPECT_EQ(BDPT_ERROR_IO, try_context(folder.file("no.ocio").c_str(), nullptr));
  expect_text("no.ocio");
  std::ofstream(folder.file("bad.ocio")) << "ocio_profile_version: [[";
  EXPECT_EQ(BDPT_ERROR_FORMAT, try_context(folder.file("bad.ocio").c_str(), nullptr));
  expect_text("bad.ocio");
}

// What a texture's texels became is seen by the material that refuses them for reflecting too much.
void expect_largest(const Context& context, bdpt_texture_desc desc, const char* largest) {
  const Builder builder = make_builder(context.get());
  desc.width = desc.height = 1;
  bdpt_texture_id texture{};
  ASSERT_OK(bdpt_texture_add(builder.get(), &desc, &texture));
  bdpt_material_desc material = grey_desc();
  material.reflectance_texture = texture;
  bdpt_material_id id{};
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_material_add(builder.get(), &material, &id));
  expect_text(largest);
}

TEST(ApiColor, TexturesOfAllFormatsAreConverted) {
  const Context context = context_in(nullptr, nullptr);
  const uint8_t bytes[4] = {0, 255, 0, 128};
  const uint16_t words[4] = {0, 65535, 0, 32768}, halves[4] = {0, 0x3C00, 0, 0x3800};
  const float floats[4] = {0, 1, 0, 0.5f};
  const std::pair<bdpt_texel, const void*> formats[] = {
      {BDPT_TEXEL_UINT8, bytes}, {BDPT_TEXEL_UINT16, words}, {BDPT_TEXEL_HALF, halves}, {BDPT_TEXEL_FLOAT, floats}};
  for (const auto& [texel, pixels] : formats)
    for (const uint32_t channels : {3u, 4u}) {
      bdpt_texture_desc desc = make<bdpt_texture_desc>();
      desc.channels = channels, desc.texel = texel, desc.pixels = pixels;
      desc.color_space = "ACEScg";
      expect_largest(context, desc, "1.1408");  // AP1's green in Rec. 709
    }
}

TEST(ApiColor, TexturesThatCannotBeConvertedAreRefused) {
  const Context context = context_in(nullptr, nullptr);
  const Builder builder = make_builder(context.get());
  float pixels[4] = {0.5f, 0.5f, 0.5f, 1};
  const auto add = [&](const std::function<void(bdpt_texture_desc&)>& change) {
    bdpt_texture_desc desc = make<bdpt_texture_desc>();
    desc.channels = 4, desc.width = desc.height = 1, desc.texel = BDPT_TEXEL_FLOAT, desc.pixels = pixels;
    desc.color_space = "ACEScg";
    change(desc);
    bdpt_texture_id texture{};
    return bdpt_texture_add(builder.get(), &desc, &texture);
  };
  EXPECT_OK(add([](auto&) {}));
  EXPECT_OK(add([](auto& d) { d.channels = 1; }));
  EXPECT_OK(add([](auto& d) { d.channels = 2; }));
  EXPECT_OK(add([](auto& d) { d.mip_levels = 4; }));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, add([](auto& d) { d.color_space = "ACESgc"; }));
  expect_text("did you mean 'ACEScg'");
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, add([](auto& d) { d.encoding = BDPT_ENCODING_LINEAR; }));
  expect_text("leave it 0");
  pixels[3] = -1;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, add([](auto&) {}));
  expect_text("alpha -1");
  pixels[3] = 1, pixels[1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, add([](auto&) {}));
  expect_text("inf");
}

// Executor and log are the library's to drop, once, also where the colours are refused.
TEST(ApiColor, AContextThatIsRefusedForItsColoursDropsWhatItWasGiven) {
  int executors = 0, logs = 0;
  const auto count = [](void* user) { ++*static_cast<int*>(user); };
  bdpt_executor executor = make<bdpt_executor>();
  executor.worker_count = 1;
  executor.run = [](void*, uint32_t n, void (*body)(void*, uint32_t), void* user) {
    for (uint32_t i = 0; i < n; ++i) body(user, i);
  };
  executor.user = &executors, executor.drop = count;
  bdpt_log log = make<bdpt_log>();
  log.write = [](void*, bdpt_log_level, const char*) {};
  log.user = &logs, log.drop = count;
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.executor = &executor, desc.log = &log;
  desc.rendering_space = "no such space";
  bdpt_context* context = nullptr;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_context_create(BDPT_ABI, &desc, &context));
  EXPECT_EQ(1, executors);
  EXPECT_EQ(1, logs);
}

// One screen shows the numbers of ap0 halved, so that each value is known.
TEST(ApiColor, AViewOfTheContextsConfiguration) {
  const bdpt::TempFolder folder;
  const std::string path = folder.file("user.ocio");
  std::ofstream(path) << "ocio_profile_version: 2\n"
                         "roles: {aces_interchange: ap0, default: ap0, scene_linear: ap0}\n"
                         "displays:\n"
                         "  Screen:\n"
                         "    - !<View> {name: Half, colorspace: halved}\n"
                         "    - !<View> {name: Whole, colorspace: ap0}\n"
                         "colorspaces:\n"
                         "  - !<ColorSpace> {name: ap0}\n"
                         "  - !<ColorSpace> {name: halved, from_scene_reference: !<MatrixTransform> "
                         "{matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}}\n";
  const Context context = context_in(path.c_str(), "ACEScg");
  const auto show = [&](const std::function<void(bdpt_display_desc&)>& change, Color color) {
    bdpt_display_desc desc = make<bdpt_display_desc>();
    desc.view = BDPT_VIEW_OCIO;
    desc.context = context.get();
    change(desc);
    EXPECT_OK(bdpt_image_display(&desc, color.data(), 1, 1));
    return color;
  };
  const Color color = {0.5f, 0.2f, 0.1f}, ap0 = convert(context, nullptr, "ap0", color);
  const Color half = show([](auto&) {}, color), whole = show([](auto&d) { d.ocio_view = "Whole"; }, color);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(ap0[c] / 2, half[c], 1e-5f);
    EXPECT_NEAR(ap0[c], whole[c], 1e-5f);
  }
  const Color brighter = show([](auto& d) { d.exposure = 1; }, color);
  EXPECT_NEAR(ap0[1], brighter[1], 1e-5f);

  bdpt_display_desc desc = make<bdpt_display_desc>();
  desc.view = BDPT_VIEW_OCIO;
  desc.context = context.get();
  desc.ocio_view = "Hlf";
  Color pixel = color;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_image_display(&desc, pixel.data(), 1, 1));
  expect_text("did you mean 'Half'");
  desc.ocio_view = nullptr;
  const Context plain = context_in(nullptr, nullptr);
  desc.context = plain.get();
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_image_display(&desc, pixel.data(), 1, 1));
  expect_text("no configuration");
  EXPECT_EQ(color, pixel);
}

}  // namespace bdpt_api::api_color_test
