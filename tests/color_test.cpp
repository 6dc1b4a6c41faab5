// Display transforms: their known values, and an answer for every input.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "color/color_spaces.h"
#include "color/display.h"
#include "temp_folder.h"

namespace bdpt::color_test {

using Pixel = std::array<float, 3>;

Pixel display(const DisplayOptions& options, Pixel pixel) {
  to_display(options, pixel.data(), 1, 1);
  return pixel;
}

float grey(const DisplayOptions& options, float value) { return display(options, {value, value, value})[1]; }

DisplayOptions view(DisplayView view, float exposure = 0) {
  DisplayOptions options;
  options.view = view;
  options.exposure = exposure;
  return options;
}

// IEC 61966-2-1.
float srgb(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }

TEST(SrgbView, IsTheCurve) {
  EXPECT_EQ(grey(view(DisplayView::Srgb), 0), 0);
  EXPECT_NEAR(grey(view(DisplayView::Srgb), 0.18f), 0.46135f, 1e-4f);
  EXPECT_NEAR(grey(view(DisplayView::Srgb), 1), 1, 1e-5f);
  for (int i = 0; i <= 1000; ++i) {
    const float x = static_cast<float>(i) / 1000;
    EXPECT_NEAR(grey(view(DisplayView::Srgb), x), srgb(x), 1e-4f) << x;
  }
}

TEST(SrgbView, ClipsAndKeepsChannelsApart) {
  const Pixel pixel = display(view(DisplayView::Srgb), {-0.5f, 0.5f, 7});
  EXPECT_EQ(pixel[0], 0);
  EXPECT_NEAR(pixel[1], srgb(0.5f), 1e-4f);
  EXPECT_EQ(pixel[2], 1);
}

TEST(DisplayViews, ExposureIsInStops) {
  for (const DisplayView v : {DisplayView::Srgb, DisplayView::Aces}) {
    EXPECT_EQ(grey(view(v, 2), 0.05f), grey(view(v), 0.2f));
    EXPECT_EQ(grey(view(v, -3), 0.8f), grey(view(v), 0.1f));
  }
}

// The tone curve puts 18 % grey at 4.8 cd/m², between black at 0.02 and white at 48; the step from a dark to a dim
// surround then takes the power 0.9811.
TEST(AcesView, PutsMiddleGreyAtATenthOfWhite) {
  const float light = std::pow((4.8f - 0.02f) / (48 - 0.02f), 0.9811f);
  EXPECT_NEAR(grey(view(DisplayView::Aces), 0.18f), srgb(light), 5e-4f);
}

TEST(AcesView, RisesToWhiteAndKeepsGreyGrey) {
  float last = -1;
  for (int i = -40; i <= 40; ++i) {
    const float stops = static_cast<float>(i) / 4;
    const Pixel pixel = display(view(DisplayView::Aces, stops), {0.18f, 0.18f, 0.18f});
    EXPECT_GE(pixel[1], last) << stops;
    EXPECT_NEAR(pixel[0], pixel[1], 2e-3f) << stops;
    EXPECT_NEAR(pixel[2], pixel[1], 2e-3f) << stops;
    last = pixel[1];
  }
  EXPECT_NEAR(grey(view(DisplayView::Aces), 0), 0, 1e-3f);
  EXPECT_NEAR(last, 1, 1e-3f);
  EXPECT_LT(grey(view(DisplayView::Aces), 1), 0.9f);  // highlights roll off
}

TEST(DisplayViews, HaveAnAnswerForEveryFloat) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const float largest = std::numeric_limits<float>::max();
  for (const DisplayView v : {DisplayView::Srgb, DisplayView::Aces}) {
    const DisplayOptions options = view(v);
    for (const float r : {inf, -inf, nan, largest, -largest, 0.0f, 1e-45f})
      for (const float g : {inf, -inf, nan, largest, -largest, 0.5f})
        for (const float value : display(options, {r, g, 0.25f})) {
          EXPECT_GE(value, 0);
          EXPECT_LE(value, 1);
        }
    EXPECT_EQ(grey(options, nan), grey(options, 0));
    EXPECT_NEAR(grey(options, inf), 1, 1e-3f);
    EXPECT_NEAR(grey(options, -inf), 0, 1e-3f);
    EXPECT_NEAR(grey(view(v, 1e6f), 0.1f), 1, 1e-3f);
    EXPECT_EQ(grey(view(v, 1e6f), 0), grey(options, 0));
  }
}

// Expects an error whose text holds every one of parts.
void expect_error(ErrorCode code, const std::vector<std::string>& parts, const DisplayOptions& options) {
  Pixel pixel = {0.25f, 0.5f, 0.75f};
  try {
    to_display(options, pixel.data(), 1, 1);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(code), static_cast<int>(error.code())) << error.what();
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
  EXPECT_EQ(pixel, (Pixel{0.25f, 0.5f, 0.75f}));
}

TEST(DisplayViews, RefuseBadArguments) {
  const float inf = std::numeric_limits<float>::infinity();
  expect_error(ErrorCode::InvalidArgument, {"exposure", "inf"}, view(DisplayView::Srgb, inf));
  expect_error(ErrorCode::InvalidArgument, {"view 7"}, view(static_cast<DisplayView>(7)));
  EXPECT_THROW(to_display({}, nullptr, 1, 1), Error);
}

// A configuration small enough to know every value of it.
class OcioView : public testing::Test {
 protected:
  void SetUp() override {
    unsetenv("OCIO");
    options_ = view(DisplayView::Ocio);
    options_.config = config_;
    write(
        "ocio_profile_version: 2\n"
        "roles: {default: lin, scene_linear: lin}\n"
        "displays:\n"
        "  First:\n"
        "    - !<View> {name: Half, colorspace: halved}\n"
        "    - !<View> {name: Raw, colorspace: lin}\n"
        "  Second:\n"
        "    - !<View> {name: Quarter, colorspace: quartered}\n"
        "colorspaces:\n"
        "  - !<ColorSpace> {name: lin}\n"
        "  - !<ColorSpace> {name: halved, from_scene_reference: !<MatrixTransform> "
        "{matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}}\n"
        "  - !<ColorSpace> {name: quartered, from_scene_reference: !<MatrixTransform> "
        "{matrix: [0.25, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 1]}}\n"
        "  - !<ColorSpace> {name: lost, from_scene_reference: !<FileTransform> {src: no-such-table.cube}}\n");
  }
  void write(const std::string& text) { std::ofstream(options_.config) << text; }
  // The same with a role that joins it to the standard spaces.
  std::string write_joined() {
    std::ifstream file(config_);
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::string roles = "roles: {";
    text.insert(text.find(roles) + roles.size(), "aces_interchange: lin, ");
    std::ofstream(joined_) << text;
    return joined_;
  }

  TempFolder folder_;
  const std::string config_ = folder_.file("config.ocio"), joined_ = folder_.file("joined.ocio");
  DisplayOptions options_;
};

TEST_F(OcioView, TakesTheDefaultsOfTheConfiguration) { EXPECT_FLOAT_EQ(grey(options_, 0.5f), 0.25f); }

TEST_F(OcioView, TakesTheNamesGiven) {
  options_.ocio_view = "Raw";
  EXPECT_FLOAT_EQ(grey(options_, 0.5f), 0.5f);
  options_.display = "Second";
  options_.ocio_view = "";
  EXPECT_FLOAT_EQ(grey(options_, 0.5f), 0.125f);
  options_.color_space = "halved";
  EXPECT_FLOAT_EQ(grey(options_, 0.5f), 0.25f);
}

TEST_F(OcioView, DoesNotReadTheEnvironment) {
  setenv("OCIO", options_.config.c_str(), 1);
  options_.config = "";
  expect_error(ErrorCode::InvalidArgument, {"OCIO", "not read"}, options_);
  unsetenv("OCIO");
}

// Where the context has the configuration, its rendering space is that of the pixels: here by its name, halved twice.
TEST_F(OcioView, TakesTheRenderingSpaceOfTheContext) {
  const ColorSpaces spaces(write_joined(), "lin");
  options_.spaces = &spaces;
  options_.config = "";
  EXPECT_FLOAT_EQ(grey(options_, 0.5f), 0.25f);
  const ColorSpaces halved(joined_, "halved");
  options_.spaces = &halved;
  options_.config = "";
  EXPECT_FLOAT_EQ(grey(options_, 0.25f), 0.25f);
  // A configuration of its own is reached by what the colours are.
  options_.config = joined_;
  EXPECT_NEAR(grey(options_, 0.25f), 0.25f, 1e-5f);
  // One without a join cannot be.
  options_.config = config_;
  expect_error(ErrorCode::InvalidArgument, {"aces_interchange"}, options_);
}

TEST(BuiltInViews, TakeTheRenderingSpaceOfTheContext) {
  const ColorSpaces spaces({}, "ACEScg");
  for (const DisplayView v : {DisplayView::Srgb, DisplayView::Aces}) {
    const Pixel pixel = {0.5f, 0.2f, 0.1f};
    Pixel converted = pixel;
    spaces.convert("lin_rec709", "", converted.data(), 1);
    EXPECT_GT(std::abs(converted[0] - pixel[0]), 0.05f);
    DisplayOptions options = view(v);
    const Pixel expected = display(options, pixel);
    options.spaces = &spaces;
    const Pixel shown = display(options, converted);
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(expected[c], shown[c], 1e-5f);
  }
}

TEST_F(OcioView, NamesWhatIsAbsentAndWhatThereIs) {
  DisplayOptions options = options_;
  options.display = "Third";
  expect_error(ErrorCode::InvalidArgument, {"display 'Third'", "'First', 'Second'"}, options);
  options = options_;
  options.ocio_view = "Quarter";
  expect_error(ErrorCode::InvalidArgument, {"'First'", "'Quarter'", "'Half', 'Raw'"}, options);
  options = options_;
  options.color_space = "log";
  expect_error(ErrorCode::InvalidArgument, {"color space 'log'", "'lin', 'halved'"}, options);
  options.color_space = "halfed";
  expect_error(ErrorCode::InvalidArgument, {"color space 'halfed': did you mean 'halved'?"}, options);
}

TEST_F(OcioView, TellsWhyAConfigurationCannotBeRead) {
  DisplayOptions options = options_;
  options.config = folder_.file("absent.ocio");
  expect_error(ErrorCode::Io, {"absent.ocio", "No such file"}, options);
  options.config = folder_.path().string();
  expect_error(ErrorCode::Io, {folder_.path().string(), "directory"}, options);
  write("ocio_profile_version: [[");
  expect_error(ErrorCode::Format, {"config.ocio"}, options_);
  write("");
  expect_error(ErrorCode::Format, {"config.ocio"}, options_);
}

TEST_F(OcioView, NamesATableThatIsMissing) {
  options_.color_space = "lost";
  expect_error(ErrorCode::Io, {"no-such-table.cube"}, options_);
}

// The configurations that others ship.
class PublicConfig : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const char* shared = getenv("BDPT_SHARED");
    path_ = std::filesystem::path(shared ? shared : BDPT_SHARED_DIR) / "scenes" / "ocio" / GetParam();
    if (!std::filesystem::exists(path_)) GTEST_SKIP() << path_ << " is not here";
  }
  std::filesystem::path path_;
};

TEST_P(PublicConfig, GivesMiddleGreyInRange) {
  DisplayOptions options = view(DisplayView::Ocio);
  options.config = path_.string();
  const float value = grey(options, 0.18f);
  EXPECT_GT(value, 0.1f);
  EXPECT_LT(value, 0.6f);
}

TEST_P(PublicConfig, NamesItsDisplays) {
  DisplayOptions options = view(DisplayView::Ocio);
  options.config = path_.string();
  options.display = "no such display";
  expect_error(ErrorCode::InvalidArgument, {"no such display", "sRGB"}, options);
}

INSTANTIATE_TEST_SUITE_P(, PublicConfig,
                         testing::Values("cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio",
                                         "studio-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio", "ocio-v2_demo.ocio"),
                         [](const auto& info) { return std::string(info.param).substr(0, 2); });

// The same transform, built here and read from the public configuration, whose pixels are ACEScg.
TEST(AcesView, AgreesWithThePublicConfiguration) {
  const char* shared = getenv("BDPT_SHARED");
  const std::filesystem::path path = std::filesystem::path(shared ? shared : BDPT_SHARED_DIR) / "scenes" / "ocio" /
                                     "cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  DisplayOptions options = view(DisplayView::Ocio);
  options.config = path.string();
  options.color_space = "Linear Rec.709 (sRGB)";
  options.display = "sRGB - Display";
  options.ocio_view = "ACES 1.0 - SDR Video";
  for (const Pixel& pixel : {Pixel{0.18f, 0.18f, 0.18f}, Pixel{0.8f, 0.1f, 0.05f}, Pixel{0.1f, 4, 0.2f},
                             Pixel{0.01f, 0.02f, 0.9f}, Pixel{20, 18, 15}}) {
    const Pixel ours = display(view(DisplayView::Aces), pixel), theirs = display(options, pixel);
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(ours[c], theirs[c], 2e-3f);
  }
}

}  // namespace bdpt::color_test
