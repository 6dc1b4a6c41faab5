// A scene in several rendering spaces, and pictures whose files name their chromaticities.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "film_output.h"
#include "image.h"
#include "scene_upload.h"
#include "temp_folder.h"

namespace bdpt_tool::tool_color_test {

// A room of faint colours: no channel is further than a tenth from the grey of its kind. Paths of three edges at most
// play no roulette, so that a seed draws the same paths whatever the colours.
constexpr const char* kScene = R"(
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
LookAt 0 0 4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
LightSource "point" "rgb I" [ 11 10 9 ] "point3 from" [ 0.5 1.5 2 ]
Texture "checks" "spectrum" "imagemap" "string filename" "checks.png"
Material "diffuse" "texture reflectance" "checks"
Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
  "point3 P" [ -1.5 -1.5 -1  1.5 -1.5 -1  1.5 1.5 -1  -1.5 1.5 -1 ] "point2 uv" [ 0 0 1 0 1 1 0 1 ]
Material "diffuse" "rgb reflectance" [ 0.55 0.5 0.45 ]
Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
  "point3 P" [ -1.5 -1 -1  -1.5 -1 1  1.5 -1 1  1.5 -1 -1 ]
)";

class ToolColor : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_.file("scene.pbrt")) << kScene;
    // Faint colours, through the curve.
    const float linear[12] = {0.55f, 0.5f, 0.45f, 0.27f, 0.3f, 0.33f, 0.3f, 0.33f, 0.27f, 0.5f, 0.5f, 0.5f};
    Image image(2, 2);
    image.pixels.assign(linear, linear + 12);
    write_png(folder_.file("checks.png"), image, {});
  }

  // The picture in linear Rec. 709, and through the view.
  struct Picture {
    Image linear, shown;
  };
  Picture render(const ColorOptions& color, const std::function<void(SceneDescription&)>& change = {}) {
    Diagnostics diagnostics(false);
    const Context context = make_context(2, diagnostics, color);
    SceneDescription description = read_scene(folder_.file("scene.pbrt"), diagnostics);
    if (change) change(description);
    const bdpt_camera_desc camera = camera_desc(description, 16, 16, diagnostics);
    const Sensor sensor = make<Sensor>("camera", bdpt_camera_create, context.get(), &camera);
    const Scene scene = build_scene(context.get(), description);
    const auto film_desc = sized<bdpt_film_desc>();
    const Film film = make<Film>("film", bdpt_film_create, sensor.get(), &film_desc);
    auto desc = sized<bdpt_render_desc>();
    desc.max_edges = 3;
    const Render render = make<Render>("render", bdpt_render_create, scene.get(), sensor.get(), film.get(), &desc);
    auto advance = sized<bdpt_advance_desc>();
    advance.passes = 16;
    check(bdpt_render_advance(render.get(), &advance, nullptr), "advance");
    const std::string file = folder_.file("picture.exr");
    write_film_exr(file, film.get(), false, context.get());
    Picture picture{read_exr(file).at(""), read_layer(film.get(), BDPT_LAYER_COLOR, false)};
    auto display = sized<bdpt_display_desc>();
    display.view = BDPT_VIEW_ACES;
    display.context = context.get();
    check(bdpt_image_display(&display, picture.shown.pixels.data(), 16, 16), "display");
    return picture;
  }

  bdpt::TempFolder folder_;
};

// The largest difference, of the largest value of a.
double difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  double largest = 0, top = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    largest = std::max(largest, std::abs(double{a.pixels[i]} - b.pixels[i]));
    top = std::max(top, double{a.pixels[i]});
  }
  return largest / top;
}

// A product of colours g(1 + a) and h(1 + b) is gh(1 + a + b + ab). What is linear in the deviations a and b from grey
// is the same in all spaces with one white, so that spaces differ by products of two deviations. With a tenth each and
// three factors (the light and two reflectances) these are three times 0.01 at most. Colours that are not converted are
// wrong by the deviations themselves.
constexpr double kSecondOrder = 0.03;

TEST_F(ToolColor, FaintColoursLookAlikeInAllRenderingSpaces) {
  const Picture reference = render({});
  for (const char* space : {"ACEScg", "lin_rec2020", "lin_p3d65", "ACES2065-1"}) {
    const Picture other = render({"", space});
    const double linear = difference(reference.linear, other.linear), shown = difference(reference.shown, other.shown);
    EXPECT_LT(linear, kSecondOrder) << space;
    EXPECT_GT(linear, 1e-6) << space << " is not used at all";
    EXPECT_LT(shown, kSecondOrder) << space;
  }
}

// One factor alone is exact: a light seen at once.
TEST_F(ToolColor, WhatShinesByItselfIsTheSameInAllSpaces) {
  std::ofstream(folder_.file("scene.pbrt")) << R"(Film "rgb" "integer xresolution" 16 "integer yresolution" 16
            Camera "perspective" "float fov" 40
            WorldBegin
            LightSource "infinite" "rgb L" [ 0.9 0.3 0.1 ])";
  const Picture reference = render({});
  for (const char* space : {"ACEScg", "lin_rec2020", "ACES2065-1"}) {
    const Picture other = render({"", space});
    EXPECT_LT(difference(reference.linear, other.linear), 1e-5) << space;
    EXPECT_LT(difference(reference.shown, other.shown), 1e-4) << space;
  }
}

TEST_F(ToolColor, AMetalKeepsItsColour) {
  const auto gold = [](SceneDescription& description) {
    for (MaterialDescription& material : description.materials) {
      material = {};
      material.type = BDPT_MATERIAL_CONDUCTOR;
      material.eta = {0.183f, 0.421f, 1.373f};
      material.k = {3.424f, 2.346f, 1.770f};
      material.roughness = {0.5f, 0.5f};
    }
    description.lights[0].value = {10, 10, 10};
  };
  const Picture reference = render({}, gold), other = render({"", "ACEScg"}, gold);
  // Up to what Fresnel's curves do away from normal incidence, and to the products of two reflections.
  EXPECT_LT(difference(reference.linear, other.linear), 0.05);
}

TEST_F(ToolColor, TexturesOutsideOfTheRenderingSpaceAreToldOf) {
  Diagnostics diagnostics(false);
  const Context context = make_context(1, diagnostics);
  const Builder builder = make<Builder>("builder", bdpt_builder_create, context.get());
  const float green[3] = {0, 1, 0};
  auto desc = sized<bdpt_texture_desc>();
  desc.label = "leaf";
  desc.channels = 3;
  desc.pixels = green;
  desc.width = desc.height = 1;
  desc.texel = BDPT_TEXEL_FLOAT;
  desc.color_space = "ACEScg";
  bdpt_texture_id id{};
  ASSERT_EQ(BDPT_OK, bdpt_texture_add(builder.get(), &desc, &id));
  ASSERT_EQ(1u, diagnostics.count());
  EXPECT_NE(std::string::npos, diagnostics.texts().begin()->find("\"leaf\": 2 values lie outside"));
  desc.color_space = "ACESgc";
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_texture_add(builder.get(), &desc, &id));
  EXPECT_NE(std::string::npos, std::string(bdpt_last_error()).find("did you mean 'ACEScg'"));
  desc.color_space = "ACEScg";
  desc.encoding = BDPT_ENCODING_LINEAR;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_texture_add(builder.get(), &desc, &id));
}

TEST_F(ToolColor, ExrFilesAreReadInTheirOwnChromaticities) {
  Diagnostics diagnostics(false);
  Image image(2, 1);
  image.pixels = {0.5f, 0.2f, 0.1f, 1, 1, 1};
  for (const char* space : {"ACEScg", "ACES2065-1", "lin_p3d65"}) {
    const Context context = make_context(1, diagnostics, {"", space});
    Image converted = image;
    ASSERT_EQ(BDPT_OK, bdpt_color_convert(context.get(), "lin_rec709", nullptr, converted.pixels.data(), 2));
    EXPECT_GT(difference(image, converted), 0.01);
    write_exr(folder_.file("a.exr"), converted, context.get());
    EXPECT_LT(difference(image, read_exr(folder_.file("a.exr")).at("")), 1e-5) << space;
  }
}

// From ASWF's openexr-images: the same picture twice.
TEST_F(ToolColor, TheSharedPictureOfXyzIsThatOfRec709) {
  const char* shared = std::getenv("BDPT_SHARED");
  const std::filesystem::path folder =
      std::filesystem::path(shared ? shared : BDPT_SHARED_DIR) / "scenes" / "openexr" / "Chromaticities";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  const Image a = read_exr(folder / "Rec709.exr").at(""), b = read_exr(folder / "XYZ.exr").at("");
  // Half floats have 11 bits; the matrix from XYZ has entries up to 3.2, and rows whose sizes add up to 5.3.
  EXPECT_LT(difference(a, b), 5.3 / 2048);
}

}  // namespace bdpt_tool::tool_color_test
