// Conversions between colour spaces: published matrices, round trips, configurations, and errors that help.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "color/color_spaces.h"
#include "temp_folder.h"

namespace bdpt::color_spaces_test {

using Color = std::array<float, 3>;

const char* const kStandard[] = {"Linear Rec.709 (sRGB)", "sRGB - Texture", "ACEScg", "ACES2065-1",
                                 "Linear Rec.2020",       "Linear P3-D65"};
const Color kColors[] = {{0, 0, 0},           {1, 1, 1},       {0.18f, 0.18f, 0.18f},
                         {0.8f, 0.1f, 0.05f}, {0.1f, 4, 0.2f}, {-0.1f, 0.02f, 0.9f}};

Color convert(const ColorSpaces& spaces, const std::string& from, const std::string& to, Color color) {
  spaces.convert(from, to, color.data(), 1);
  return color;
}

void expect_near(const Color& expected, const Color& actual, float tolerance, const std::string& what = {}) {
  for (size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(expected[c], actual[c], tolerance * std::max(1.0f, std::abs(expected[c]))) << what << " channel " << c;
}

// Expects an error whose text holds every one of parts.
template <class Body>
void expect_error(ErrorCode code, const std::vector<std::string>& parts, const Body& body) {
  try {
    body();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(code), static_cast<int>(error.code())) << error.what();
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

// Rows of a matrix on columns, as they are printed.
void expect_matrix(const ColorMatrix& actual, const double (&printed)[3][3], double tolerance) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(printed[i][j], actual[j][i], tolerance) << i << ' ' << j;
}

TEST(Primaries, GiveThePublishedMatricesToXyz) {
  // IEC 61966-2-1:1999, and BT.2087-0 for Rec. 2020, to the digits they have.
  expect_matrix(to_xyz(kRec709), {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}, 1e-4);
  expect_matrix(to_xyz(kRec2020), {{0.6370, 0.1446, 0.1689}, {0.2627, 0.6780, 0.0593}, {0.0000, 0.0281, 1.0610}}, 1e-4);
  // AMPAS S-2014-004, TRA_1 (AP1) and SMPTE ST 2065-1 (AP0).
  expect_matrix(to_xyz(kAp1),
                {{0.6624541811, 0.1340042065, 0.1561876870},
                 {0.2722287168, 0.6740817658, 0.0536895174},
                 {-0.0055746495, 0.0040607335, 1.0103391003}},
                1e-6);
  expect_matrix(to_xyz(kAp0),
                {{0.9525523959, 0.0000000000, 0.0000936786},
                 {0.3439664498, 0.7281660966, -0.0721325464},
                 {0.0000000000, 0.0000000000, 1.0088251844}},
                1e-6);
}

TEST(Primaries, AdaptByBradford) {
  // ACEScg and ACES2065-1 to linear Rec. 709, D60 to D65, as OpenColorIO's builtin transforms and the ACES CTL have it.
  expect_matrix(conversion(kAp1, kRec709),
                {{1.70505099, -0.62179212, -0.08325887},
                 {-0.13025642, 1.14080474, -0.01054832},
                 {-0.02400336, -0.12896898, 1.15297233}},
                2e-6);
  expect_matrix(conversion(kAp0, kRec709),
                {{2.52168618, -1.13413099, -0.38755519},
                 {-0.27647991, 1.37271909, -0.09623917},
                 {-0.01537806, -0.15297534, 1.16835340}},
                2e-6);
  // AP0 to AP1 have one white: AMPAS S-2014-004.
  expect_matrix(conversion(kAp0, kAp1),
                {{1.4514393161, -0.2365107469, -0.2149285693},
                 {-0.0765537734, 1.1762296998, -0.0996759264},
                 {0.0083161484, -0.0060324498, 0.9977163014}},
                1e-6);
  // BT.2087-0: Rec. 709 to Rec. 2020.
  expect_matrix(conversion(kRec709, kRec2020),
                {{0.6274, 0.3293, 0.0433}, {0.0691, 0.9195, 0.0114}, {0.0164, 0.0880, 0.8956}}, 1e-4);
}

// In ASWF's openexr-images, Chromaticities/XYZ.exr is Rec709.exr times this, and not adapted.
TEST(Primaries, OfXyzAreSeenAtD65) {
  const Primaries xyz{{1, 0}, {0, 1}, {0, 0}, {1 / 3.0f, 1 / 3.0f}};
  EXPECT_TRUE(conversion(kRec709, xyz).equalWithAbsError(to_xyz(kRec709), 1e-6));
  EXPECT_TRUE(conversion(kAp1, xyz).equalWithAbsError(conversion(kAp1, kRec709) * to_xyz(kRec709), 1e-6));
}

TEST(Primaries, ComeBackFromTheirMatrix) {
  for (const Primaries& p : {kRec709, kRec2020, kP3D65, kAp0, kAp1}) {
    const Primaries back = primaries_of(to_xyz(p));
    for (size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(p.red[i], back.red[i], 1e-6f);
      EXPECT_NEAR(p.green[i], back.green[i], 1e-6f);
      EXPECT_NEAR(p.blue[i], back.blue[i], 1e-6f);
      EXPECT_NEAR(p.white[i], back.white[i], 1e-6f);
    }
  }
}

TEST(Primaries, ThatMakeNoColoursAreRefused) {
  const auto refused = [](const Primaries& p, const char* part) {
    expect_error(ErrorCode::InvalidArgument, {part}, [&] { to_xyz(p); });
  };
  Primaries p = kRec709;
  p.blue = p.red;
  refused(p, "on a line");
  p = kRec709;
  p.white = {0.7f, 0.3f};
  refused(p, "outside");
  p.white = {0.3f, 0};
  refused(p, "no luminance");
  p.white = {0.3f, std::numeric_limits<float>::quiet_NaN()};
  refused(p, "not finite");
}

// The curve makes 34 of 4, and its inverse is up to 13 steep: a few roundings of 34 are 1e-4.
TEST(StandardSpaces, ConvertThereAndBack) {
  const ColorSpaces spaces;
  for (const char* from : kStandard)
    for (const char* to : kStandard)
      for (const Color& color : kColors) {
        const std::string what = std::string(from) + " -> " + to;
        expect_near(color, convert(spaces, to, from, convert(spaces, from, to, color)), 1e-4f, what);
      }
}

TEST(StandardSpaces, KeepWhiteAndGrey) {
  const ColorSpaces spaces;
  for (const char* from : kStandard)
    for (const char* to : kStandard) {
      expect_near({1, 1, 1}, convert(spaces, from, to, {1, 1, 1}), 2e-6f, std::string(from) + " -> " + to);
      const Color grey = convert(spaces, from, to, {0.3f, 0.3f, 0.3f});
      EXPECT_NEAR(grey[0], grey[1], 1e-6f);
      EXPECT_NEAR(grey[2], grey[1], 1e-6f);
    }
}

TEST(StandardSpaces, DecodeTheSrgbCurve) {
  const ColorSpaces spaces;
  // IEC 61966-2-1: 0.5 is 0.21404 in light, and the two parts meet at 0.04045.
  expect_near({0.214041f, 0.003035f, 1}, convert(spaces, "srgb_texture", "lin_rec709", {0.5f, 0.039215f, 1}), 1e-6f);
  expect_near({-0.5f / 12.92f, 0, 0}, convert(spaces, "sRGB", "", {-0.5f, 0, 0}), 1e-6f);
}

TEST(StandardSpaces, TakeNamesInAnyCaseAndLeaveEqualSpacesToTheBit) {
  const ColorSpaces spaces;
  for (const char* name : {"LINEAR REC.709 (SRGB)", "lin_srgb", "lin_rec709", "raw", ""}) {
    EXPECT_EQ(kColors[3], convert(spaces, name, "", kColors[3])) << name;
    EXPECT_TRUE(spaces.is_identity(name, "")) << name;
  }
  EXPECT_FALSE(spaces.is_identity("sRGB", ""));
  EXPECT_FALSE(spaces.is_identity("acescg", ""));
  EXPECT_EQ(convert(spaces, "ACEScg", "", kColors[3]), convert(spaces, "lin_ap1", "", kColors[3]));
}

TEST(StandardSpaces, AValueThatIsNotFiniteSpoilsItsColourAlone) {
  const ColorSpaces spaces({}, "ACEScg");
  const float inf = std::numeric_limits<float>::infinity();
  std::vector<float> rgb = {0.5f, 0.5f, 0.5f, inf, std::nanf(""), 1, 0.5f, 0.5f, 0.5f};
  spaces.convert("sRGB", "", rgb.data(), 3);
  for (const size_t i : {0, 1, 2, 6, 7, 8}) EXPECT_NEAR(0.214041f, rgb[i], 1e-6f);
}

TEST(StandardSpaces, CanBeTheRenderingSpace) {
  const ColorSpaces spaces({}, "acescg");
  EXPECT_EQ("acescg", spaces.rendering_space());
  EXPECT_EQ(kAp1, spaces.primaries());
  EXPECT_EQ(convert(spaces, "sRGB", "ACEScg", kColors[3]), convert(spaces, "sRGB", "", kColors[3]));
  EXPECT_EQ(kRec709, ColorSpaces().primaries());
}

TEST(ColorSpaces, AnUnknownNameBringsCloseOnes) {
  const ColorSpaces spaces;
  const auto unknown = [&](const char* name, const char* part) {
    expect_error(ErrorCode::InvalidArgument, {std::string("'") + name + "'", part},
                 [&] { spaces.convert(name, "", nullptr, 0); });
  };
  unknown("ACESgc", "did you mean 'ACEScg'");
  unknown("linear rec709", "did you mean 'Linear Rec.709 (sRGB)'");
  unknown("lin rec 2020", "'Linear Rec.2020'");
  unknown("Linear", "did you mean 'Linear P3-D65', 'Linear Rec.2020' or 'Linear Rec.709 (sRGB)'?");
  unknown("no such thing", "there are 'Linear Rec.709 (sRGB)', 'sRGB - Texture'");
  expect_error(ErrorCode::InvalidArgument, {"ACEScgg", "did you mean 'ACEScg'"}, [] { ColorSpaces({}, "ACEScgg"); });
}

TEST(ColorSpaces, TheRenderingSpaceIsLinear) {
  expect_error(ErrorCode::InvalidArgument, {"'sRGB'", "not linear"}, [] { ColorSpaces({}, "sRGB"); });
  expect_error(ErrorCode::InvalidArgument, {"'Raw'", "linear"}, [] { ColorSpaces({}, "Raw"); });
}

TEST(ColorSpaces, ConvertOnManyThreadsAlike) {
  const ColorSpaces spaces({}, "ACEScg");
  std::vector<Color> results(16);
  std::vector<std::thread> threads;
  for (size_t i = 0; i < results.size(); ++i)
    threads.emplace_back([&, i] {
      for (int k = 0; k < 200; ++k)
        for (const char* name : kStandard) results[i] = convert(spaces, name, i % 2 ? "" : "ACEScg", kColors[3]);
    });
  for (std::thread& thread : threads) thread.join();
  for (const Color& result : results) EXPECT_EQ(convert(spaces, kStandard[5], "", kColors[3]), result);
}

// A configuration of a user's, small enough to know every value of it.
class UserConfig : public testing::Test {
 protected:
  static std::string matrix(const char* numbers) {
    return std::string("!<MatrixTransform> {matrix: [") + numbers + "]}";
  }
  void SetUp() override { write("aces_interchange: ap0, "); }
  void write(const std::string& roles) {
    std::ofstream(path_)
        << "ocio_profile_version: 2\n"
           "roles: {"
        << roles
        << "default: ap0, scene_linear: swapped}\n"
           "displays:\n"
           "  Screen:\n"
           "    - !<View> {name: Raw, colorspace: ap0}\n"
           "colorspaces:\n"
           "  - !<ColorSpace> {name: ap0}\n"
           "  - !<ColorSpace> {name: swapped, aliases: [turned], from_scene_reference: "
        << matrix("0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1")
        << "}\n"
           "  - !<ColorSpace> {name: twice, to_scene_reference: "
        << matrix("2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1")
        << "}\n"
           "  - !<ColorSpace> {name: ap1, to_scene_reference: "
        << matrix(
               "0.6954522414, 0.1406786965, 0.1638690622, 0, 0.0447945634, 0.8596711185, 0.0955343182, 0, "
               "-0.0055258826, 0.0040252103, 1.0015006723, 0, 0, 0, 0, 1")
        << "}\n"
           "  - !<ColorSpace> {name: curved, to_scene_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1]}}\n"
           "  - !<ColorSpace> {name: flat, to_scene_reference: "
        << matrix("1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1")
        << "}\n"
           "  - !<ColorSpace> {name: normals, isdata: true}\n"
           "  - !<ColorSpace> {name: lost, from_scene_reference: !<FileTransform> {src: no-such-table.cube}}\n"
           "  - !<ColorSpace> {name: ACEScg, to_scene_reference: "
        << matrix("4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1") << "}\n";
  }

  TempFolder folder_;
  const std::string path_ = folder_.file("user.ocio");
};

TEST_F(UserConfig, IsReachedFromTheStandardSpaces) {
  const ColorSpaces spaces(path_);
  expect_near({0.2f, 0.3f, 0.1f}, convert(spaces, "ACES2065-1", "swapped", {0.1f, 0.2f, 0.3f}), 1e-6f);
  expect_near({0.2f, 0.3f, 0.1f}, convert(spaces, "ACES2065-1", "turned", {0.1f, 0.2f, 0.3f}), 1e-6f);
  expect_near({0.2f, 0.4f, 0.6f}, convert(spaces, "twice", "ap0", {0.1f, 0.2f, 0.3f}), 1e-6f);
  const Color expected = convert(ColorSpaces(), "sRGB", "lin_ap0", kColors[3]);
  expect_near({expected[1], expected[2], expected[0]}, convert(spaces, "sRGB", "scene_linear", kColors[3]), 1e-6f);
  for (const char* name : {"swapped", "twice", "ap1", "ACEScg"})
    for (const Color& color : kColors)
      expect_near(color, convert(spaces, name, "", convert(spaces, "", name, color)), 1e-5f, name);
}

TEST_F(UserConfig, ComesBeforeTheStandardSpaces) {
  const ColorSpaces spaces(path_);
  expect_near({0.4f, 0.8f, 1.2f}, convert(spaces, "ACEScg", "ap0", {0.1f, 0.2f, 0.3f}), 1e-6f);
  EXPECT_EQ(kRec709, spaces.primaries());  // the default is no name
}

TEST_F(UserConfig, RendersInItsLinearSpaces) {
  EXPECT_EQ(kAp1, ColorSpaces(path_, "ap1").primaries());  // by its matrix
  EXPECT_EQ(kAp0, ColorSpaces(path_, "ap0").primaries());
  const ColorSpaces spaces(path_, "swapped");
  for (const Color& color : kColors) {
    Color by_primaries = color;
    convert_primaries(kRec709, spaces.primaries(), by_primaries.data(), 1);
    expect_near(convert(spaces, "lin_rec709", "", color), by_primaries, 1e-5f);
  }
  EXPECT_NEAR(0.3127f, spaces.primaries().white[0], 1e-5f);
  EXPECT_NEAR(0.3290f, spaces.primaries().white[1], 1e-5f);
}

TEST_F(UserConfig, TellsWhyASpaceCannotBeRenderedIn) {
  const auto refused = [&](const char* name, const char* part) {
    expect_error(ErrorCode::InvalidArgument, {std::string("'") + name + "'", part}, [&] { ColorSpaces(path_, name); });
  };
  refused("curved", "not linear");
  refused("normals", "data");
  refused("flat", "");
  refused("swaped", "did you mean 'swapped'");
  expect_error(ErrorCode::Io, {"no-such-table.cube"}, [&] { ColorSpaces(path_, "lost"); });
}

TEST_F(UserConfig, TellsWhyAConversionIsNotPossible) {
  const ColorSpaces spaces(path_);
  EXPECT_EQ(kColors[3], convert(spaces, "normals", "", kColors[3]));
  expect_error(ErrorCode::InvalidArgument, {"'flat'"}, [&] { spaces.convert("ap0", "flat", nullptr, 0); });
  expect_error(ErrorCode::Io, {"no-such-table.cube"}, [&] { spaces.convert("lost", "", nullptr, 0); });
  expect_error(ErrorCode::InvalidArgument, {"'swapp'", "user.ocio", "did you mean 'swapped'"},
               [&] { spaces.convert("swapp", "", nullptr, 0); });
  // A failure is not remembered as a conversion.
  expect_error(ErrorCode::Io, {"no-such-table.cube"}, [&] { spaces.convert("lost", "", nullptr, 0); });
}

TEST_F(UserConfig, WithoutAJoinKeepsToItself) {
  write("");
  const ColorSpaces spaces(path_);
  expect_near({0.4f, 0.6f, 0.2f}, convert(spaces, "twice", "swapped", {0.1f, 0.2f, 0.3f}), 1e-6f);
  // The one standard name that it has joins it: its ACEScg, which is four times ap0.
  expect_near({0.4f, 0.4f, 0.4f}, convert(spaces, "lin_rec709", "ap0", {0.1f, 0.1f, 0.1f}), 1e-6f);
  std::ofstream(path_)
      << "ocio_profile_version: 2\nroles: {default: lin}\ndisplays: {S: [!<View> {name: V, colorspace: "
         "lin}]}\ncolorspaces: [!<ColorSpace> {name: lin}]\n";
  const ColorSpaces alone(path_);
  expect_error(ErrorCode::InvalidArgument, {"user.ocio", "aces_interchange"},
               [&] { alone.convert("sRGB", "lin", nullptr, 0); });
  expect_error(ErrorCode::InvalidArgument, {"aces_interchange"}, [&] { ColorSpaces(path_, "lin"); });
  EXPECT_NO_THROW(alone.convert("sRGB", "ACEScg", nullptr, 0));
}

TEST(ColorSpaces, TellWhyAConfigurationCannotBeRead) {
  const TempFolder folder;
  expect_error(ErrorCode::Io, {"absent.ocio", "No such file"}, [&] { ColorSpaces(folder.file("absent.ocio")); });
  expect_error(ErrorCode::Io, {"directory"}, [&] { ColorSpaces(folder.path().string()); });
  std::ofstream(folder.file("bad.ocio")) << "ocio_profile_version: [[";
  expect_error(ErrorCode::Format, {"bad.ocio"}, [&] { ColorSpaces(folder.file("bad.ocio")); });
}

// The configurations that others ship.
std::string public_config(const char* name) {
  const char* shared = std::getenv("BDPT_SHARED");
  return (std::filesystem::path(shared ? shared : BDPT_SHARED_DIR) / "scenes" / "ocio" / name).string();
}

class AcesConfig : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    path_ = public_config(GetParam());
    if (!std::filesystem::exists(path_)) GTEST_SKIP() << path_ << " is not here";
  }
  std::string path_;
};

// Its own conversions, which go through ACES2065-1 with the matrices it brings, are those of the standard spaces; but
// its sRGB curve has 12.9232 for 12.92, which is 2.5e-4 more.
TEST_P(AcesConfig, AgreesWithTheStandardSpaces) {
  const ColorSpaces theirs(path_), ours;
  for (const char* from : kStandard)
    for (const char* to : kStandard)
      for (const Color& color : kColors)
        expect_near(convert(ours, from, to, color), convert(theirs, from, to, color), 4e-4f,
                    std::string(from) + " -> " + to);
}

TEST_P(AcesConfig, HasTheStandardPrimaries) {
  EXPECT_EQ(kAp1, ColorSpaces(path_, "ACEScg").primaries());
  EXPECT_EQ(kAp1, ColorSpaces(path_, "scene_linear").primaries());
  EXPECT_EQ(kAp0, ColorSpaces(path_, "aces_interchange").primaries());
  EXPECT_EQ(kRec2020, ColorSpaces(path_, "Linear Rec.2020").primaries());
  EXPECT_EQ(kRec709, ColorSpaces(path_, "Linear Rec.709 (sRGB)").primaries());
  EXPECT_EQ(kP3D65, ColorSpaces(path_, "lin_p3d65").primaries());
}

TEST_P(AcesConfig, RefusesWhatIsNotLinear) {
  expect_error(ErrorCode::InvalidArgument, {"'ACEScct'", "not linear"}, [&] { ColorSpaces(path_, "ACEScct"); });
  expect_error(ErrorCode::InvalidArgument, {"'sRGB - Texture'", "not linear"},
               [&] { ColorSpaces(path_, "sRGB - Texture"); });
  expect_error(ErrorCode::InvalidArgument, {"'Raw'", "data"}, [&] { ColorSpaces(path_, "Raw"); });
  expect_error(ErrorCode::InvalidArgument, {"'ACESct'", "did you mean", "'ACEScct'"},
               [&] { ColorSpaces(path_).convert("ACESct", "", nullptr, 0); });
}

// A space of the configuration's alone has primaries that lead to it as its own transform does.
TEST(StudioConfig, RendersInTheSpaceOfACamera) {
  const std::string path = public_config("studio-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  for (const char* name : {"Linear ARRI Wide Gamut 3", "Linear S-Gamut3", "Linear V-Gamut"}) {
    const ColorSpaces spaces(path, name);
    EXPECT_NEAR(0.3127f, spaces.primaries().white[0], 1e-4f) << name;
    for (const Color& color : kColors) {
      Color by_primaries = color;
      convert_primaries(kAp1, spaces.primaries(), by_primaries.data(), 1);
      expect_near(convert(spaces, "ACEScg", "", color), by_primaries, 2e-4f, name);
    }
  }
}

TEST(DemoConfig, RendersInItsSceneLinear) {
  const std::string path = public_config("ocio-v2_demo.ocio");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const ColorSpaces spaces(path, "scene_linear");
  expect_near({0.5f, 0.5f, 0.5f}, convert(spaces, "lin_rec709", "", {0.5f, 0.5f, 0.5f}), 1e-4f);
}

INSTANTIATE_TEST_SUITE_P(, AcesConfig,
                         testing::Values("cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio",
                                         "studio-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio"),
                         [](const auto& info) { return std::string(info.param).substr(0, 2); });

}  // namespace bdpt::color_spaces_test
