// What files say of lights and media, in the picture: pbrt's scenes with known radiances.
//
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "pbrt/environment.h"
#include "tool_picture.h"

namespace bdpt_tool::tool_light_test {

using ToolLight = ToolPicture;

// Something that is different in all directions.
Rgb color_of(const Vec3& d) { return {float(0.5 + 0.4 * d[0]), float(0.5 + 0.4 * d[1]), float(0.5 + 0.4 * d[2])}; }

const Vec3 kDirections[] = {{0.6, 0.64, 0.48}, {-0.48, 0.6, 0.64}, {0.64, -0.48, -0.6}, {-0.6, -0.64, 0.48}};

TEST_F(ToolLight, EnvironmentsLieWherePbrtHasThem) {
  write("sky.exr", 128, [](double u, double v) { return color_of(direction_of({u, v})); });
  const std::string light = "LightSource \"infinite\" \"string filename\" \"sky.exr\"\n";
  for (const Vec3& d : kDirections) {
    expect_near(radiance(read(look_along(d), light)), color_of(d), 0.03f);
    expect_near(radiance(read(look_along(d), "Rotate 90 0 0 1\n" + light)), color_of({d[1], -d[0], d[2]}), 0.03f);
    expect_near(radiance(read(look_along(d), "Scale -1 1 1\n" + light)), color_of({-d[0], d[1], d[2]}), 0.03f);
  }
}

// In front of a camera at rest is the picture's middle.
TEST_F(ToolLight, APictureTakesThePlaceOfTheEnvironment) {
  write("world.exr", 16, [](double u, double) { return u > 0.5 ? Rgb{1, 2, 3} : Rgb{3, 2, 1}; });
  read("LookAt 0 0 0 1 0 -2 0 1 0\nCamera \"perspective\" \"float fov\" 0.5",
       "LightSource \"infinite\" \"rgb L\" [9 9 9]\n");
  ReadOptions options;
  options.environment = folder_.file("world.exr");
  expect_near(radiance(read_scene(folder_.file("scene.pbrt"), diagnostics_, options)), {1, 2, 3}, 1e-3f);
}

// In pbrt each window is a light of its own; here they are one environment, and light that comes in elsewhere counts,
// too.
TEST_F(ToolLight, PortalsOfOneEnvironmentAreItsWindows) {
  const std::string camera = "LookAt 0 0 0 0 0 1 0 1 0\nCamera \"perspective\" \"float fov\" 0.5";
  const auto sky = [](const std::string& light, const std::string& portal) {
    return "Translate 5 0 0\nLightSource \"infinite\" " + light + " \"point3 portal\" [" + portal + "]\n";
  };
  const std::string value = "\"rgb L\" [1 2 3]", left = "-1 0 2  -3 0 2  -3 2 2  -1 2 2",
                    right = "1 0 2  3 0 2  3 2 2  1 2 2";
  const SceneDescription scene = read(camera, sky(value, left) + sky(value, right));
  ASSERT_EQ(scene.lights.size(), 1u);
  ASSERT_EQ(scene.lights[0].portals.size(), 2u);
  EXPECT_EQ(scene.lights[0].portals[0].corner, (Rgb{-1, 0, 2}));
  EXPECT_EQ(scene.lights[0].portals[0].edge_u, (Rgb{-2, 0, 0}));
  EXPECT_EQ(scene.lights[0].portals[0].edge_v, (Rgb{0, 2, 0}));
  EXPECT_EQ(scene.lights[0].portals[1].corner, (Rgb{1, 0, 2}));
  expect_near(radiance(scene), {1, 2, 3}, 1e-3f);
  EXPECT_EQ(read(camera, sky(value, left) + sky("\"rgb L\" [1 1 1]", right)).lights.at(0).value, (Rgb{2, 3, 4}));

  write("sky.exr", 8, [](double u, double v) { return Rgb{float(u), float(v), 1}; });
  const std::string picture = "\"string filename\" \"sky.exr\"";
  EXPECT_EQ(read(camera, sky(picture, left) + sky(picture, right)).lights.size(), 1u);
  EXPECT_EQ(read(camera, sky(picture, left) + "Rotate 90 0 1 0\n" + sky(picture, right)).lights.size(), 2u);

  const auto error = [&](const std::string& portal) {
    try {
      SceneDescription description = read(camera, sky(value, portal));
      build_scene(make_context(1, diagnostics_).get(), description);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(error(left), "");
  EXPECT_NE(error("0 0 0 1 0 0 1 1 0").find("scene.pbrt:5: LightSource \"infinite\": 'portal' has 3 points"),
            std::string::npos)
      << error("0 0 0 1 0 0 1 1 0");
  EXPECT_NE(error("0 0 0 1 0 0 1 1 0.1 0 1 0").find("is no rectangle"), std::string::npos);
  EXPECT_NE(error("0 0 0 1 0 0 2 1 0 1 1 0").find("at an angle of 45 degrees"), std::string::npos)
      << error("0 0 0 1 0 0 2 1 0 1 1 0");
}

constexpr const char* kWall =
    "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
    "\"point3 P\" [-9 -9 2  9 -9 2  9 9 2  -9 9 2] \"point2 uv\" [0 0 1 0 1 1 0 1]\n";

TEST_F(ToolLight, DistantLightsGiveTheirIrradiance) {
  const SceneDescription scene =
      read("LookAt 0 0 0 0 0 1 0 1 0\nCamera \"perspective\" \"float fov\" 0.5",
           std::string("LightSource \"distant\" \"point3 from\" [0 3 0] \"point3 to\" [0 0 4] "
                       "\"rgb L\" [1 2 3] \"float scale\" 2\n") +
               kWall);
  const float cosine = 0.8f, factor = 0.5f / float(M_PI) * cosine;
  expect_near(radiance(scene), {2 * factor, 4 * factor, 6 * factor}, 1e-3f);
}

// Seen from where the light stands the wall shows its picture.
TEST_F(ToolLight, ProjectionsThrowTheirPictureAsACameraSeesIt) {
  const Rgb colors[4] = {{1, 0.1f, 0.1f}, {0.1f, 1, 0.1f}, {0.1f, 0.1f, 1}, {1, 1, 0.1f}};
  write("slide.exr", 32, [&](double u, double v) { return colors[(v > 0.5) * 2 + (u > 0.5)]; });
  for (const char* transform : {"", "Scale -1 1 1\n"}) {
    const Image image = render(
        read(std::string(transform) + "LookAt 0 0 0 0 0 1 0 1 0\nCamera \"perspective\" \"float fov\" 60",
             std::string(transform) +
                 "LightSource \"projection\" \"string filename\" \"slide.exr\" \"float fov\" 60 \"float scale\" 3\n" +
                 kWall),
        256);
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      const std::size_t x = quarter % 2 ? 10 : 5, y = quarter / 2 ? 10 : 5;
      const double px = (x + 0.5) / 8 - 1, py = (y + 0.5) / 8 - 1, t = std::tan(M_PI / 6);
      const double cosine = 1 / std::sqrt(1 + t * t * (px * px + py * py));
      const float factor = float(3 * 0.5 / M_PI * std::pow(cosine, 3) / 4);
      const float* pixel = &image.pixels[3 * (y * kSize + x)];
      const Rgb& c = colors[quarter];
      expect_near({pixel[0], pixel[1], pixel[2]}, {factor * c[0], factor * c[1], factor * c[2]}, 0.05f);
    }
  }
}

TEST_F(ToolLight, GoniometricLightsShineByTheirSquare) {
  const auto intensity = [](const Vec3& d) { return 0.5 + 0.3 * d[0] + 0.15 * d[1] + 0.1 * d[2]; };
  write("lamp.exr", 128, [&](double u, double v) {
    const Vec3 d = direction_of({u, v});  // its pole is y
    const float i = float(intensity({d[0], d[2], d[1]}));
    return Rgb{i, i, i};
  });
  const std::string world =
      "LightSource \"goniometric\" \"string filename\" \"lamp.exr\" \"rgb I\" [1 2 3]\n"
      "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\nShape \"sphere\" \"float radius\" 2\n";
  for (const Vec3& d : kDirections) {
    const float value = float(0.5 / M_PI / 4 * intensity(d)),
                mirrored = float(0.5 / M_PI / 4 * intensity({d[0], d[1], -d[2]}));
    expect_near(radiance(read(look_along(d), world)), {value, 2 * value, 3 * value}, 0.03f);
    expect_near(radiance(read(look_along(d), "Scale 1 1 -1\n" + world)), {mirrored, 2 * mirrored, 3 * mirrored}, 0.03f);
  }
}

TEST_F(ToolLight, AreaLightsShowTheirPicture) {
  write("screen.exr", 2, [](double u, double v) { return Rgb{float(u), float(v), 1}; });
  const SceneDescription scene =
      read("LookAt 0 0 0 0 0 1 0 1 0\nCamera \"perspective\" \"float fov\" 60",
           std::string("AreaLightSource \"diffuse\" \"string filename\" \"screen.exr\" \"bool twosided\" true \"float "
                       "scale\" 4\n") +
               kWall);
  const Image image = render(scene);
  const float* middle = &image.pixels[3 * (kSize / 2 * kSize + kSize / 2)];
  expect_near({middle[0], middle[1], middle[2]}, {2, 2, 4}, 0.2f);
  EXPECT_GT(image.pixels[3 * (kSize - 1)], 2);      // u grows to the right
  EXPECT_LT(image.pixels[3 * (kSize - 1) + 1], 2);  // v = 1 is the picture's top row
}

TEST_F(ToolLight, InterfacesHoldMediaThatAbsorb) {
  max_edges_ = 0;
  const std::string camera = "LookAt 0 0 -5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 0.5";
  const std::string medium =
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.1 .2 .4] \"rgb sigma_s\" [0 0 0] "
      "\"float scale\" 2\n";
  const std::string light = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n",
                    ball = "Shape \"sphere\" \"float radius\" 1.5\n";
  const SceneDescription filled =
      read(camera, light + medium + "MediumInterface \"fog\" \"\"\nMaterial \"interface\"\n" + ball);
  expect_near(radiance(filled), {std::exp(-.6f), std::exp(-1.2f), std::exp(-2.4f)}, 5e-3f);
  const SceneDescription empty = read(camera, light + medium + "Material \"interface\"\n" + ball);
  expect_near(radiance(empty), {1, 1, 1}, 1e-3f);
}

TEST_F(ToolLight, MediaThatAreNotNamedOrNotHomogeneousAreErrors) {
  const auto error = [&](const std::string& world) {
    try {
      read("Camera \"perspective\"", world);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(error("MediumInterface \"fog\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n").find("no medium 'fog'"),
            std::string::npos);
  EXPECT_NE(error("MakeNamedMedium \"fog\" \"string type\" \"cloud\"\n").find("use homogeneous"), std::string::npos);
  EXPECT_NE(error("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"float g\" 1\n").find("g must be"),
            std::string::npos);
}

// KHR_materials_volume: after the distance the colour is left.
TEST_F(ToolLight, VolumesAbsorbByTheirColour) {
  max_edges_ = 0;
  SceneDescription scene = read("LookAt 0 0 -5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 0.5",
                                "LightSource \"infinite\" \"rgb L\" [1 1 1]\nShape \"sphere\" \"float radius\" 1.5\n");
  MaterialDescription& material = scene.materials.at(0);
  material.type = BDPT_MATERIAL_PRINCIPLED;
  material.reflectance = {1, 1, 1};
  material.ior = 1;
  PrincipledDescription& p = material.principled;
  p.roughness.factor = 0;
  p.transmission.factor = p.thickness.factor = 1;
  p.attenuation_distance = 2;
  p.attenuation_color = {0.25f, 0.5f, 0.75f};
  const auto left = [](float color) { return std::pow(color, 1.5f); };
  expect_near(radiance(scene), {left(0.25f), left(0.5f), left(0.75f)}, 5e-3f);
}

}  // namespace bdpt_tool::tool_light_test
