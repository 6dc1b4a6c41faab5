// Image calls: what they refuse. What they write is tested inside.
#include "api_scene.h"
#include "temp_folder.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace bdpt_api::api_image_test {

TEST(ApiImage, DisplayDescriptionsAreChecked) {
  const auto try_display = [](const std::function<void(bdpt_display_desc&)>& change, uint32_t width = 1) {
    bdpt_display_desc desc = make<bdpt_display_desc>();
    change(desc);
    float pixel[3] = {0.18f, 0.18f, 0.18f};
    return bdpt_image_display(&desc, pixel, width, 1);
  };
  const auto refused = [&](const std::function<void(bdpt_display_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_display(change)) << bdpt_last_error();
  };
  EXPECT_OK(try_display([](auto&) {}));
  refused([](auto& d) { d.view = 3; });
  refused([](auto& d) { d.view = -1; });
  refused([](auto& d) { d.exposure = std::numeric_limits<float>::quiet_NaN(); });
  refused([](auto& d) { d.exposure = std::numeric_limits<float>::infinity(); });
  refused([](auto& d) { d.reserved = 1; });
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_display([](auto&) {}, 0));
  EXPECT_EQ(BDPT_ERROR_IO, try_display([](auto& d) { d.view = BDPT_VIEW_OCIO, d.config = "/no/such/config.ocio"; }));
  float pixel[3] = {0, 1, 2};
  EXPECT_OK(bdpt_image_display(nullptr, pixel, 1, 1));
  EXPECT_EQ(0, pixel[0]);
  EXPECT_NEAR(1, pixel[1], 1e-6);
  EXPECT_NEAR(1, pixel[2], 1e-6);
}

TEST(ApiImage, ExposureIsThatOfIso12232) {
  const auto stops = [](const std::function<void(bdpt_exposure_desc&)>& change) {
    bdpt_exposure_desc desc = make<bdpt_exposure_desc>();
    change(desc);
    float value = 0;
    EXPECT_OK(bdpt_exposure_stops(&desc, &value));
    return value;
  };
  // f/1 for a second is EV 0, where 1.2 candela per square metre are white.
  const float zero = stops([](auto& d) { d.f_number = d.shutter_time = 1; });
  EXPECT_NEAR(std::exp2(-zero), 1.2, 1e-6);
  EXPECT_EQ(zero, stops([](auto&) {}));
  EXPECT_NEAR(stops([](auto& d) { d.ev100 = 15; }), zero - 15, 1e-5);
  // Sunny 16: f/16 and 1/100 s at ISO 100 are EV 14.6.
  const float sunny = stops([](auto& d) { d.f_number = 16, d.shutter_time = 0.01f, d.iso = 100; });
  EXPECT_NEAR(sunny, zero - std::log2(25600.0f), 1e-4);
  // A stop each: twice the time, twice the sensitivity, an aperture of twice the area.
  EXPECT_NEAR(stops([](auto& d) { d.f_number = 16, d.shutter_time = 0.02f; }), sunny + 1, 1e-4);
  EXPECT_NEAR(stops([](auto& d) { d.f_number = 16, d.shutter_time = 0.01f, d.iso = 200; }), sunny + 1, 1e-4);
  EXPECT_NEAR(stops([](auto& d) { d.f_number = 11.3137f, d.shutter_time = 0.01f; }), sunny + 1, 1e-4);
  const auto refused = [](const char* field, const std::function<void(bdpt_exposure_desc&)>& change) {
    bdpt_exposure_desc desc = make<bdpt_exposure_desc>();
    change(desc);
    float value = 0;
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_exposure_stops(&desc, &value)) << field;
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), field)) << bdpt_last_error();
  };
  refused("iso", [](auto& d) { d.iso = 100; });
  refused("iso", [](auto& d) { d.iso = -1, d.f_number = d.shutter_time = 1; });
  refused("f_number", [](auto& d) { d.shutter_time = 1; });
  refused("shutter_time", [](auto& d) { d.f_number = 1; });
  refused("ev100", [](auto& d) { d.f_number = d.shutter_time = d.ev100 = 1; });
  refused("ev100", [](auto& d) { d.ev100 = std::numeric_limits<float>::quiet_NaN(); });
  refused("reserved", [](auto& d) { d.reserved = 1; });
}

TEST(ApiImage, ExrDescriptionsAreChecked) {
  const bdpt::TempFolder folder;
  const std::vector<float> pixels(2 * 2 * 3, 0.5f);
  const bdpt_image_layer layers[2] = {{nullptr, pixels.data()}, {"light", pixels.data()}};
  const auto try_exr = [&](const std::function<void(bdpt_exr_desc&)>& change) {
    bdpt_exr_desc desc = make<bdpt_exr_desc>();
    desc.width = desc.height = desc.layer_count = 2;
    desc.layers = layers;
    change(desc);
    return bdpt_image_write_exr(folder.file("a.exr").c_str(), &desc);
  };
  const auto refused = [&](const std::function<void(bdpt_exr_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_exr(change)) << bdpt_last_error();
  };
  refused([](auto& d) { d.width = 0; });
  refused([](auto& d) { d.height = 1 << 20; });
  refused([](auto& d) { d.layer_count = 0; });
  refused([](auto& d) { d.layer_count = ~0u; });
  refused([](auto& d) { d.half = 2; });
  refused([](auto& d) { d.layer_stride = 8; });
  refused([](auto& d) { d.layer_stride = 17; });
  const bdpt_image_layer twins[2] = {layers[1], layers[1]};
  refused([&](auto& d) { d.layers = twins; });
  EXPECT_EQ(0u, folder.count());
  EXPECT_OK(try_exr([](auto&) {}));
  EXPECT_EQ(1u, folder.count());
}

TEST(ApiImage, ExrFilesTakeOnlyChromaticitiesOfColours) {
  const bdpt::TempFolder folder;
  const float pixel[3] = {0, 0.5f, 1};
  const bdpt_image_layer layer{nullptr, pixel};
  bdpt_chromaticities chromaticities = {{0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}};
  bdpt_exr_desc desc = make<bdpt_exr_desc>();
  desc.width = desc.height = desc.layer_count = 1;
  desc.layers = &layer;
  desc.chromaticities = &chromaticities;
  EXPECT_OK(bdpt_image_write_exr(folder.file("a.exr").c_str(), &desc));
  chromaticities.white[1] = 0;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_image_write_exr(folder.file("b.exr").c_str(), &desc));
  EXPECT_EQ(1u, folder.count());
}

TEST(ApiImage, LayersMayBeOfALaterAndLongerKind) {
  const bdpt::TempFolder folder;
  const std::vector<float> pixels(3, 0.5f);
  struct Longer {
    bdpt_image_layer layer;
    uint64_t more;
  } const layers[2] = {{{nullptr, pixels.data()}, 1}, {{"light", pixels.data()}, 2}};
  bdpt_exr_desc desc = make<bdpt_exr_desc>();
  desc.width = desc.height = 1;
  desc.layer_count = 2;
  desc.layers = &layers[0].layer;
  desc.layer_stride = sizeof(Longer);
  EXPECT_OK(bdpt_image_write_exr(folder.file("a.exr").c_str(), &desc));
}

TEST(ApiImage, PngsAreChecked) {
  const bdpt::TempFolder folder;
  float pixels[3] = {0, 0.5f, 1};
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_image_write_png(folder.file("a.png").c_str(), pixels, 0, 1));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_image_write_png("", pixels, 1, 1));
  EXPECT_EQ(BDPT_ERROR_IO, bdpt_image_write_png(folder.file("no/such/folder").c_str(), pixels, 1, 1));
  EXPECT_OK(bdpt_image_write_png(folder.file("a.png").c_str(), pixels, 1, 1));
  pixels[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_image_write_png(folder.file("b.png").c_str(), pixels, 1, 1));
  EXPECT_EQ(1u, folder.count());
}

}  // namespace bdpt_api::api_image_test
