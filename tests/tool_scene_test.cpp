// The scene reader of the program: what pbrt-v4 text comes to, and that errors name file and line.
//
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scene_upload.h"
#include "temp_folder.h"
#include "transform.h"

namespace bdpt_tool::tool_scene_test {

const char kTriangle[] = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";

class ToolScene : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_.file(name)) << text; }

  SceneDescription read(const std::string& text) {
    write("scene.pbrt", text);
    return read_scene(folder_.file("scene.pbrt"), diagnostics_);
  }
  SceneDescription read_world(const std::string& text) { return read("Camera \"perspective\"\nWorldBegin\n" + text); }

  // The message without the folder.
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kInput);
      std::string message = error.what();
      const std::string prefix = folder_.path().string() + "/";
      if (message.starts_with(prefix)) message.erase(0, prefix.size());
      return message;
    }
    return "no error";
  }
  std::string world_error_of(const std::string& text) {
    return error_of("Camera \"perspective\"\nWorldBegin\n" + text);
  }

  void expect_prefix(const std::string& text, const std::string& prefix) {
    EXPECT_TRUE(text.starts_with(prefix)) << text;
  }

  bdpt::TempFolder folder_;
  Diagnostics diagnostics_{false};
};

Vec3 transformed(const std::array<float, 12>& m, const Vec3& p, double w) {
  Vec3 result;
  for (int i = 0; i < 3; ++i)
    result[i] = m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3] * w;
  return result;
}

void expect_near(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5) << i;
}

TEST_F(ToolScene, TransformListsColumnsAndReplaces) {
  const SceneDescription scene =
      read_world(std::string("Scale 9 9 9\nTransform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1]\n") + kTriangle);
  expect_near(transformed(scene.instances[0].transform, {1, 2, 3}, 1), {6, 8, 10});
}

TEST_F(ToolScene, TransformsApplyFromTheLastToTheFirst) {
  const SceneDescription scene = read_world(std::string("Translate 1 0 0\nRotate 90 0 0 1\nScale 2 2 2\n") + kTriangle);
  expect_near(transformed(scene.instances[0].transform, {1, 0, 0}, 1), {1, 2, 0});
}

TEST_F(ToolScene, AttributeBlocksRestoreEverythingTransformBlocksTheTransform) {
  const SceneDescription scene =
      read_world(std::string("AttributeBegin\nTranslate 1 0 0\nMaterial \"conductor\"\nAttributeEnd\nTransformBegin\n"
                             "Translate 2 0 0\nMaterial \"dielectric\"\nTransformEnd\n") +
                 kTriangle);
  EXPECT_EQ(scene.instances[0].transform[3], 0);
  EXPECT_EQ(scene.materials[0].type, BDPT_MATERIAL_DIELECTRIC);
}

TEST_F(ToolScene, InstancesAreNamedAfterTheirShapes) {
  EXPECT_EQ(read_world(kTriangle).instances[0].label, "trianglemesh at scene.pbrt:3");
}

TEST_F(ToolScene, LookAtPutsTheTargetInFrontOfTheCameraWithoutMirroring) {
  const SceneDescription scene =
      read("LookAt 1 2 3  1 2 8  0 1 0\nCamera \"perspective\"\nWorldBegin\n" + std::string(kTriangle));
  const auto& m = scene.camera.transform;
  expect_near(transformed(m, {0, 0, 0}, 1), {1, 2, 3});
  expect_near(transformed(m, {0, 0, -1}, 0), {0, 0, 1});  // the library's camera looks along -z
  expect_near(transformed(m, {1, 0, 0}, 0), {1, 0, 0});   // pbrt: right is up x forward
  expect_near(transformed(m, {0, 1, 0}, 0), {0, 1, 0});
}

TEST_F(ToolScene, FieldOfViewIsThatOfTheShorterAxis) {
  const SceneDescription scene = read("Camera \"perspective\" \"float fov\" 60\nWorldBegin\n" + std::string(kTriangle));
  EXPECT_NEAR(camera_desc(scene, 200, 100, diagnostics_).field_of_view, 60, 1e-4);
  const double tangent = 2 * std::tan(30 * M_PI / 180);
  EXPECT_NEAR(camera_desc(scene, 100, 200, diagnostics_).field_of_view, 2 * std::atan(tangent) * 180 / M_PI, 1e-4);
}

TEST_F(ToolScene, ScreenWindowMovesTheFrame) {
  const SceneDescription scene =
      read("Camera \"perspective\" \"float screenwindow\" [0 1 -1 0]\nWorldBegin\n" + std::string(kTriangle));
  const bdpt_camera_desc camera = camera_desc(scene, 100, 100, diagnostics_);
  EXPECT_FLOAT_EQ(camera.shift[0], 0.5f);
  EXPECT_FLOAT_EQ(camera.shift[1], -0.5f);
  EXPECT_NEAR(camera.field_of_view, 2 * std::atan(0.5) * 180 / M_PI, 1e-4);
  EXPECT_THROW(camera_desc(scene, 200, 100, diagnostics_), Error);
}

TEST_F(ToolScene, LensIsMeasuredInCameraUnits) {
  const SceneDescription scene =
      read("Scale 2 2 2\nCamera \"perspective\" \"float lensradius\" 1 \"float focaldistance\" 6\nWorldBegin\n" +
           std::string(kTriangle));
  EXPECT_FLOAT_EQ(scene.camera.lens_radius, 0.5f);
  EXPECT_FLOAT_EQ(scene.camera.focus_distance, 3);
}

TEST_F(ToolScene, OrthographicCamerasShowTheirScreenWindow) {
  const SceneDescription scene = read(
      "Scale 2 2 2\nCamera \"orthographic\" \"float screenwindow\" [-1 3 -2 2]\nWorldBegin\n" + std::string(kTriangle));
  const bdpt_camera_desc camera = camera_desc(scene, 100, 100, diagnostics_);
  EXPECT_EQ(camera.type, BDPT_CAMERA_ORTHOGRAPHIC);
  EXPECT_FLOAT_EQ(camera.field_height, 2);
  EXPECT_FLOAT_EQ(camera.shift[0], 0.25f);
  EXPECT_EQ(camera.field_of_view, 0);
  const SceneDescription plain = read("Camera \"orthographic\"\nWorldBegin\n" + std::string(kTriangle));
  EXPECT_FLOAT_EQ(camera_desc(plain, 300, 100, diagnostics_).field_height, 2);
}

// The format's left edge looks to the right, a quarter further on is ahead.
TEST_F(ToolScene, SphericalCamerasArePanoramasWithTheirFrontAQuarterIn) {
  const SceneDescription scene =
      read("LookAt 0 0 0  0 0 1  0 1 0\nCamera \"spherical\" \"string mapping\" \"equirectangular\"\nWorldBegin\n" +
           std::string(kTriangle));
  const bdpt_camera_desc camera = camera_desc(scene, 200, 100, diagnostics_);
  EXPECT_EQ(camera.type, BDPT_CAMERA_EQUIRECTANGULAR);
  // Ours: -z in the middle, its x axis three quarters in. Theirs: phi = 2 pi u, (cos, 0, sin).
  expect_near(transformed(scene.camera.transform, {0, 0, -1}, 0), {-1, 0, 0});  // u = 1/2
  expect_near(transformed(scene.camera.transform, {1, 0, 0}, 0), {0, 0, -1});   // u = 3/4
  expect_near(transformed(scene.camera.transform, {-1, 0, 0}, 0), {0, 0, 1});   // u = 1/4
  expect_near(transformed(scene.camera.transform, {0, 1, 0}, 0), {0, 1, 0});
  EXPECT_THROW(read("Camera \"spherical\"\nWorldBegin\n" + std::string(kTriangle)), Error);
}

TEST_F(ToolScene, RealisticCamerasAreTracedLenses) {
  std::ofstream(folder_.file("lens.dat"))
      << "# a singlet with a stop\n25.85 6 1.517 24\n0 2 1 24 # flat\n\n0 45 0 20\n";
  const auto camera_of = [&](const std::string& parameters) {
    return "Scale 2 2 2\nFilm \"rgb\" \"integer xresolution\" 400 \"integer yresolution\" 300 \"float diagonal\" 50\n"
           "Camera \"realistic\" " +
           parameters + "\nWorldBegin\n" + kTriangle;
  };
  const SceneDescription scene =
      read(camera_of("\"string lensfile\" \"lens.dat\" \"float aperturediameter\" 10 \"float focusdistance\" 2"));
  const bdpt_camera_desc camera = camera_desc(scene, 400, 300, diagnostics_);
  EXPECT_EQ(camera.type, BDPT_CAMERA_LENS);
  ASSERT_EQ(camera.lens_surface_count, 3u);
  EXPECT_FLOAT_EQ(camera.lens_surfaces[0].radius, 25.85f);
  EXPECT_FLOAT_EQ(camera.lens_surfaces[2].aperture, 10);
  EXPECT_FLOAT_EQ(camera.lens_unit, 0.0005f);
  EXPECT_NEAR(camera.film_height, 30, 1e-4);
  EXPECT_NEAR(camera.focus_distance, (2 - 0.053) / 2, 1e-6);
  expect_near(transformed(scene.camera.transform, {0, 0, 0}, 1), {0, 0, 0.0265f});  // the film is at the origin
  for (const char* bad : {"", "\"string lensfile\" \"../lens.dat\"", "\"string lensfile\" \"none.dat\"",
                          "\"string lensfile\" \"lens.dat\" \"float focusdistance\" 0.01"}) {
    EXPECT_THROW(read(camera_of(bad)), Error) << bad;
  }
  for (const char* text : {"", "1 2 3\n", "1 2 x 4\n", "1 2 nan 4\n"}) {
    std::ofstream(folder_.file("lens.dat")) << text;
    EXPECT_THROW(read(camera_of("\"string lensfile\" \"lens.dat\"")), Error) << text;
  }
}

TEST_F(ToolScene, TheCommandLineReplacesTheCamera) {
  const SceneDescription scene =
      read("Camera \"perspective\" \"float lensradius\" 1\nWorldBegin\n" + std::string(kTriangle));
  CameraOptions options;
  options.type = BDPT_CAMERA_ORTHOGRAPHIC;
  options.field_height = 5.0f;
  const bdpt_camera_desc camera = camera_desc(scene, 200, 100, diagnostics_, options);
  EXPECT_EQ(camera.type, BDPT_CAMERA_ORTHOGRAPHIC);
  EXPECT_EQ(camera.field_height, 5);
  EXPECT_EQ(camera.field_of_view, 0);
  EXPECT_EQ(camera.lens_radius, 0);
}

TEST_F(ToolScene, CropWindowRoundsUpAsPbrt) {
  const SceneDescription scene = read(
      "Film \"rgb\" \"integer xresolution\" 10 \"integer yresolution\" 10 \"float cropwindow\" [.11 .5 0 1]\n"
      "Camera \"perspective\"\nWorldBegin\n" +
      std::string(kTriangle));
  const bdpt_camera_desc camera = camera_desc(scene, 10, 10, diagnostics_);
  EXPECT_EQ(camera.crop[0], 2u);
  EXPECT_EQ(camera.crop[2], 5u);
  EXPECT_EQ(camera.crop[3], 10u);
}

TEST_F(ToolScene, PathsMayHaveOneEdgeMoreThanMaxdepth) {
  EXPECT_EQ(
      read("Integrator \"path\" \"integer maxdepth\" 7\nCamera \"perspective\"\nWorldBegin\n" + std::string(kTriangle))
          .max_edges,
      8u);
  EXPECT_EQ(read_world(kTriangle).max_edges, 6u);
}

TEST_F(ToolScene, RoughnessIsRemappedBySquareRootUnlessToldNot) {
  const SceneDescription scene = read_world(
      std::string("Material \"conductor\" \"float roughness\" .25\n") + kTriangle +
      "Material \"conductor\" \"float roughness\" .25 \"bool remaproughness\" false\n" + kTriangle +
      "Material \"conductor\" \"float uroughness\" .25 \"float vroughness\" 0 \"bool remaproughness\" [false]\n" +
      kTriangle + "Material \"dielectric\" \"float roughness\" .0001 \"bool remaproughness\" false\n" + kTriangle);
  EXPECT_FLOAT_EQ(scene.materials[0].roughness[0], 0.5f);
  EXPECT_FLOAT_EQ(scene.materials[1].roughness[1], 0.25f);
  EXPECT_FLOAT_EQ(scene.materials[2].roughness[1], 1e-4f);  // one axis cannot be smooth alone
  EXPECT_EQ(scene.materials[3].roughness[0], 0);            // smooth to pbrt
}

TEST_F(ToolScene, ConductorsComeByIndexByNameOrByReflectance) {
  const SceneDescription scene = read_world(
      std::string("Material \"conductor\" \"rgb eta\" [1 2 3] \"rgb k\" [4 5 6]\n") + kTriangle +
      "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\"\n" + kTriangle +
      "Material \"conductor\" \"rgb reflectance\" [.5 .5 .5]\n" + kTriangle + "Material \"conductor\"\n" + kTriangle);
  EXPECT_EQ(scene.materials[0].k, (Rgb{4, 5, 6}));
  EXPECT_NEAR(scene.materials[1].eta[2], 1.4425f, 1e-3f);
  const float k = scene.materials[2].k[0];  // R = k² / (4 + k²) for eta = 1
  EXPECT_NEAR(k * k / (4 + k * k), 0.5f, 1e-5f);
  EXPECT_NEAR(scene.materials[3].eta[0], 0.2004f, 1e-3f);
}

TEST_F(ToolScene, MaterialsMayBeNamedBeforeTheyAreMade) {
  const SceneDescription scene =
      read_world(std::string("NamedMaterial \"a\"\n") + kTriangle +
                 "MakeNamedMaterial \"a\" \"string type\" \"dielectric\" \"float eta\" 1.3\n");
  EXPECT_FLOAT_EQ(scene.materials[0].ior, 1.3f);
}

TEST_F(ToolScene, UnknownMaterialsAreAnErrorOnlyWhereTheyAreUsed) {
  const std::string make = "MakeNamedMaterial \"a\" \"string type\" \"hair\"\n";
  EXPECT_EQ(read_world(make + kTriangle).materials.size(), 1u);
  expect_prefix(world_error_of(make + "NamedMaterial \"a\"\n" + kTriangle),
                "scene.pbrt:3: MakeNamedMaterial \"a\": the material type 'hair'");
  expect_prefix(world_error_of("NamedMaterial \"b\"\n" + std::string(kTriangle)),
                "scene.pbrt:4: there is no material 'b'");
}

TEST_F(ToolScene, AreaLightsGiveTheirScaledRadianceToTheShapesInTheirBlock) {
  const SceneDescription scene = read_world(
      std::string(
          "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" 2 \"bool twosided\" true\n") +
      kTriangle + "AttributeEnd\n" + kTriangle);
  EXPECT_EQ(scene.materials[0].emission, (Rgb{2, 4, 6}));
  EXPECT_TRUE(scene.materials[0].emission_two_sided);
  EXPECT_FALSE(scene.materials[1].emits());
}

TEST_F(ToolScene, SpotsStandInWorldSpace) {
  const SceneDescription scene = read_world(
      "Translate 0 0 1\nScale 2 2 2\nLightSource \"spot\" \"point3 from\" [0 1 0] \"point3 to\" [0 0 0] "
      "\"rgb I\" [1 1 1] \"float coneangle\" 20\n");
  expect_near({scene.lights[0].position[0], scene.lights[0].position[1], scene.lights[0].position[2]}, {0, 2, 1});
  expect_near({scene.lights[0].direction[0], scene.lights[0].direction[1], scene.lights[0].direction[2]}, {0, -1, 0});
  EXPECT_FLOAT_EQ(scene.lights[0].cone_angle, 20);
  EXPECT_FLOAT_EQ(scene.lights[0].cone_falloff, 5);
}

TEST_F(ToolScene, InfiniteLightsAddUpToOne) {
  const SceneDescription scene = read_world(
      "LightSource \"infinite\" \"rgb L\" [1 1 1]\nLightSource \"point\"\nLightSource \"infinite\" \"rgb L\" [1 2 "
      "3]\n");
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].value, (Rgb{2, 3, 4}));
}

TEST_F(ToolScene, ReverseOrientationTurnsWindingOrNormals) {
  const SceneDescription scene =
      read_world(std::string("ReverseOrientation\n") + kTriangle +
                 "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 1 0 0 1 0 0 1]\n");
  EXPECT_EQ(std::get<TriangleMesh>(scene.shapes[0].geometry).indices, (std::vector<std::uint32_t>{0, 2, 1}));
  EXPECT_EQ(std::get<TriangleMesh>(scene.shapes[1].geometry).indices, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(std::get<TriangleMesh>(scene.shapes[1].geometry).normals[2], -1);
}

TEST_F(ToolScene, ATurnedGlassSphereHasTheInverseIndex) {
  const SceneDescription scene =
      read_world("Material \"dielectric\" \"float eta\" 2\nShape \"sphere\"\nReverseOrientation\nShape \"sphere\"\n");
  EXPECT_FLOAT_EQ(scene.materials[0].ior, 2);
  EXPECT_FLOAT_EQ(scene.materials[1].ior, 0.5f);
}

TEST_F(ToolScene, AMeshFileUsedTwiceIsReadOnce) {
  write("m.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2\n");
  const SceneDescription scene = read_world(
      "Shape \"plymesh\" \"string filename\" \"m.ply\"\nTranslate 1 0 0\nShape \"plymesh\" \"string filename\" "
      "[\"./m.ply\"]\n");
  EXPECT_EQ(scene.shapes.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 2u);
}

TEST_F(ToolScene, ObjectsAreInstancedUnderBothTransforms) {
  const SceneDescription scene =
      read_world(std::string("ObjectBegin \"o\"\nTranslate 1 0 0\n") + kTriangle +
                 "ObjectEnd\nScale 2 2 2\nObjectInstance \"o\"\nTranslate 0 0 1\nObjectInstance \"o\"\n");
  ASSERT_EQ(scene.instances.size(), 2u);
  expect_near(transformed(scene.instances[0].transform, {0, 0, 0}, 1), {2, 0, 0});
  expect_near(transformed(scene.instances[1].transform, {0, 0, 0}, 1), {2, 0, 2});
}

TEST_F(ToolScene, IncludesKeepTheirStateImportsDoNot) {
  write("part.pbrt", "Translate 1 0 0\n");
  EXPECT_EQ(read_world("Include \"part.pbrt\"\n" + std::string(kTriangle)).instances[0].transform[3], 1);
  EXPECT_EQ(read_world("Import \"part.pbrt\"\n" + std::string(kTriangle)).instances[0].transform[3], 0);
}

TEST_F(ToolScene, ErrorsInIncludedFilesNameThem) {
  write("part.pbrt", "\n\nNonsense\n");
  expect_prefix(world_error_of("Include \"part.pbrt\"\n"), "part.pbrt:3: unknown directive 'Nonsense'");
}

TEST_F(ToolScene, AFileThatIncludesItselfIsAnError) {
  EXPECT_NE(world_error_of("Include \"scene.pbrt\"\n").find("WorldBegin"), std::string::npos);
  write("loop.pbrt", "Include \"loop.pbrt\"\n");
  EXPECT_NE(world_error_of("Include \"loop.pbrt\"\n").find("include each other"), std::string::npos);
}

TEST_F(ToolScene, FilesThatIncludeTwoEachAreAnErrorInTime) {
  std::string last = "Translate 0 0 0\n";
  for (int i = 0; i < 30; ++i) {
    const std::string name = std::to_string(i) + ".pbrt";
    write(name, last);
    last = "Include \"" + name + "\"\nInclude \"" + name + "\"\n";
  }
  EXPECT_NE(world_error_of(last).find("more than 10000 files are included"), std::string::npos);
}

TEST_F(ToolScene, UnbalancedBlocksAreAnErrorWithTheirLine) {
  expect_prefix(world_error_of("AttributeEnd\n"), "scene.pbrt:3: AttributeEnd without AttributeBegin");
  expect_prefix(world_error_of("\nAttributeBegin\n" + std::string(kTriangle)),
                "scene.pbrt:4: AttributeBegin is never closed");
  expect_prefix(world_error_of("AttributeBegin\nTransformEnd\n"),
                "scene.pbrt:4: TransformEnd closes the AttributeBegin of line 3");
}

TEST_F(ToolScene, BrokenSyntaxIsAnErrorWithItsLine) {
  expect_prefix(world_error_of("Shape \"sphere\n"), "scene.pbrt:3: this string does not end");
  expect_prefix(world_error_of("Shape \"sphere\" \"float radius\" [1\n"), "scene.pbrt:3: the values of 'radius'");
  expect_prefix(world_error_of("Shape \"sphere\" \"radius\" 1\n"),
                "scene.pbrt:3: Shape \"sphere\": expected a parameter");
  expect_prefix(world_error_of("Shape \"sphere\" \"float radius\" one\n"),
                "scene.pbrt:3: expected a number, found 'one'");
  expect_prefix(world_error_of("Translate 1 2\n"), "scene.pbrt:3: Translate: expected a number");
  expect_prefix(world_error_of("]\n"), "scene.pbrt:3: unknown directive");
  expect_prefix(error_of("Translate 1 2 3\n"), "scene.pbrt:1: there is no WorldBegin");
}

TEST_F(ToolScene, WrongValuesAreAnErrorWithTheirLine) {
  expect_prefix(world_error_of("Shape \"sphere\"\n\"float radius\" [1 2]\n"),
                "scene.pbrt:4: Shape \"sphere\": 'radius' has 2 values");
  expect_prefix(world_error_of("Shape \"sphere\" \"integer radius\" 1\n"),
                "scene.pbrt:3: Shape \"sphere\": 'radius' is of type integer");
  expect_prefix(world_error_of("Shape \"sphere\" \"float radius\" nan\n"),
                "scene.pbrt:3: Shape \"sphere\": 'radius' has a value that is not finite");
  expect_prefix(world_error_of("Shape \"sphere\" \"float zmin\" 0\n"),
                "scene.pbrt:3: Shape \"sphere\": only whole spheres");
  expect_prefix(world_error_of("Scale 1 2 1\nShape \"sphere\"\n"), "scene.pbrt:4: this transform makes an ellipsoid");
  expect_prefix(world_error_of("Scale 0 1 1\n"), "scene.pbrt:3: Scale");
  expect_prefix(world_error_of("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 3]\n"),
                "scene.pbrt:3: Shape \"trianglemesh\": vertex 3 does not exist");
  expect_prefix(world_error_of("Shape \"cylinder\"\n"),
                "scene.pbrt:3: Shape \"cylinder\": the shape 'cylinder' is not known");
  expect_prefix(world_error_of("LightSource \"projection\"\n"), "scene.pbrt:3: LightSource \"projection\"");
  expect_prefix(world_error_of("AreaLightSource \"diffuse\" \"float power\" 1\n"),
                "scene.pbrt:3: AreaLightSource \"diffuse\": 'power'");
  expect_prefix(world_error_of("LightSource \"point\" \"blackbody I\" 6\n"),
                "scene.pbrt:3: LightSource \"point\": 'I' must be from 500 to 1000000 kelvin");
}

TEST_F(ToolScene, MissingFilesAreAnErrorAtTheirMention) {
  expect_prefix(world_error_of("Shape \"plymesh\"\n  \"string filename\" \"no.ply\"\n"), "scene.pbrt:4: cannot read");
  expect_prefix(world_error_of("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"no.png\"\n"
                               "Material \"diffuse\" \"texture reflectance\" \"t\"\n" +
                               std::string(kTriangle)),
                "scene.pbrt:3: cannot read");
}

TEST_F(ToolScene, UnknownParametersAreAWarningWithTheirLine) {
  read_world("Shape \"sphere\"\n  \"float colour\" 1\n");
  ASSERT_EQ(diagnostics_.count(), 1u);
  EXPECT_NE(diagnostics_.texts().begin()->find("scene.pbrt:4: Shape \"sphere\": parameter 'colour' is not known"),
            std::string::npos);
}

TEST_F(ToolScene, CommentsAndBareValuesAndByteOrderMarksAreRead) {
  const SceneDescription scene = read(
      "\xEF\xBB\xBF# first\nCamera \"perspective\" # \"float fov\" 10\n\"float fov\"[20]\nWorldBegin "
      "Shape\"sphere\"\"float radius\"2");
  EXPECT_FLOAT_EQ(scene.camera.fov_short_axis, 20);
  EXPECT_FLOAT_EQ(std::get<SphereShape>(scene.shapes[0].geometry).radius, 2);
}

TEST_F(ToolScene, ConstantAndScaledTexturesComeToTheirValue) {
  const SceneDescription scene = read_world(
      "Texture \"a\" \"spectrum\" \"constant\" \"rgb value\" [.5 .25 1]\n"
      "Texture \"b\" \"spectrum\" \"scale\" \"texture tex\" \"a\" \"float scale\" .5\n"
      "Material \"diffuse\" \"texture reflectance\" \"b\"\n" +
      std::string(kTriangle));
  EXPECT_EQ(scene.materials[0].reflectance, (Rgb{.25f, .125f, .5f}));
  EXPECT_NE(world_error_of("Texture \"a\" \"spectrum\" \"scale\" \"texture tex\" \"a\"\n"
                           "Material \"diffuse\" \"texture reflectance\" \"a\"\n" +
                           std::string(kTriangle))
                .find("more than 16 deep"),
            std::string::npos);
}

TEST_F(ToolScene, EveryTruncationOfASceneIsAnErrorOrAScene) {
  const std::string text =
      "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" [30]\nWorldBegin\nAttributeBegin\n"
      "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nShape \"sphere\" \"float radius\" [2]\nAttributeEnd\n";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    try {
      read(text.substr(0, size));
    } catch (const Error&) {
    }
  }
}

TEST_F(ToolScene, CoatsTransmissionAndThinGlassAreReadWhole) {
  const SceneDescription scene = read_world(
      std::string(
          "Material \"coateddiffuse\" \"rgb reflectance\" [.1 .2 .3] \"float uroughness\" .25 \"float vroughness\" .25 "
          "\"float thickness\" .5 \"float eta\" 1.25 \"float g\" .5 \"rgb albedo\" [.1 .1 .1]\n") +
      kTriangle +
      "Material \"coatedconductor\" \"float interface.roughness\" .25 \"float conductor.roughness\" .0625 "
      "\"spectrum conductor.eta\" \"metal-Au-eta\" \"spectrum conductor.k\" \"metal-Au-k\"\n" +
      kTriangle +
      "Material \"diffusetransmission\" \"rgb reflectance\" [.5 .5 .5] \"rgb transmittance\" [.25 .5 .25] \"float "
      "scale\" .5\n" +
      kTriangle + "Material \"thindielectric\" \"float eta\" 1.75\n" + kTriangle + "Material \"interface\"\n" +
      kTriangle);
  const MaterialDescription& plastic = scene.materials[0];
  EXPECT_EQ(plastic.type, BDPT_MATERIAL_COATED_DIFFUSE);
  EXPECT_EQ(plastic.reflectance, (Rgb{.1f, .2f, .3f}));
  EXPECT_EQ(plastic.coat.roughness, (std::array<float, 2>{.5f, .5f}));
  EXPECT_EQ(plastic.coat.thickness, .5f);
  EXPECT_EQ(plastic.coat.ior, 1.25f);
  EXPECT_EQ(plastic.coat.g, .5f);
  EXPECT_EQ(scene.materials[1].type, BDPT_MATERIAL_COATED_CONDUCTOR);
  EXPECT_EQ(scene.materials[1].coat.roughness[0], .5f);
  EXPECT_EQ(scene.materials[1].roughness[0], .25f);
  EXPECT_NEAR(scene.materials[1].eta[2], 1.4425f, 1e-3f);
  EXPECT_EQ(scene.materials[2].type, BDPT_MATERIAL_DIFFUSE_TRANSMISSION);
  EXPECT_EQ(scene.materials[2].transmittance.factor, (Rgb{.125f, .25f, .125f}));
  EXPECT_EQ(scene.materials[3].type, kMaterialThinDielectric);
  EXPECT_EQ(scene.materials[3].ior, 1.75f);
  EXPECT_EQ(scene.materials[4].type, BDPT_MATERIAL_INTERFACE);
}

TEST_F(ToolScene, MixesNameTwoMaterials) {
  const std::string parts =
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"rgb reflectance\" [1 0 0]\n"
      "MakeNamedMaterial \"b\" \"string type\" \"conductor\"\n";
  const SceneDescription scene =
      read_world(parts + "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" .25\n" + kTriangle);
  const MaterialDescription& mix = scene.materials[static_cast<std::size_t>(scene.instances[0].material)];
  EXPECT_EQ(mix.type, BDPT_MATERIAL_MIX);
  EXPECT_EQ(mix.mix_amount.factor, .25f);
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(mix.mixed[0])].type, BDPT_MATERIAL_DIFFUSE);
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(mix.mixed[1])].type, BDPT_MATERIAL_CONDUCTOR);
  EXPECT_NE(world_error_of("MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [\"m\" \"m\"]\n"
                           "NamedMaterial \"m\"\n" +
                           std::string(kTriangle))
                .find("more than 16 deep"),
            std::string::npos);
}

TEST_F(ToolScene, SpectraAndBlackBodiesBecomeRgb) {
  const SceneDescription scene = read_world(
      std::string("Material \"diffuse\" \"spectrum reflectance\" [300 .25 800 .25]\n") + kTriangle +
      "Material \"diffuse\" \"spectrum reflectance\" [580 0 600 1]\n" + kTriangle +
      "LightSource \"point\" \"blackbody I\" 6504\nLightSource \"point\" \"blackbody I\" 2700 \"float scale\" 3\n");
  for (const float x : scene.materials[0].reflectance) EXPECT_NEAR(x, .25f, 1e-5f);
  const Rgb& red = scene.materials[1].reflectance;
  EXPECT_GT(red[0], .6f);
  EXPECT_LT(red[2], .02f);
  for (const float x : scene.lights[0].value) EXPECT_NEAR(x, 1, .06f);  // white, nearly
  const Rgb& warm = scene.lights[1].value;
  EXPECT_NEAR(.2126f * warm[0] + .7152f * warm[1] + .0722f * warm[2], 3, 1e-4f);
  EXPECT_GT(warm[0], 2 * warm[1] - warm[2]);
  EXPECT_GT(warm[1], 2 * warm[2]);
  expect_prefix(world_error_of("LightSource \"point\" \"spectrum I\" [600 1 500 1]\n"),
                "scene.pbrt:3: LightSource \"point\": 'I' must be pairs of wavelength and value");
}

TEST_F(ToolScene, DistantLightsComeFromFromToTo) {
  const SceneDescription scene = read_world(
      "LightSource \"distant\" \"point3 from\" [0 2 0] \"point3 to\" [0 0 0] \"rgb L\" [1 2 3] \"float scale\" 2\n");
  EXPECT_EQ(scene.lights[0].type, BDPT_LIGHT_DIRECTIONAL);
  EXPECT_EQ(scene.lights[0].direction, (Rgb{0, -1, 0}));
  EXPECT_EQ(scene.lights[0].value, (Rgb{2, 4, 6}));
}

TEST_F(ToolScene, PicturesOfInfiniteLightsBecomeTextures) {
  const float pixels[] = {1, 2, 3};
  write("sky.pfm", "PF\n1 1\n-1\n" + std::string(reinterpret_cast<const char*>(pixels), sizeof pixels));
  const SceneDescription scene =
      read_world("LightSource \"infinite\" \"string filename\" \"sky.pfm\" \"float scale\" 2\nShape \"sphere\"\n");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].value, (Rgb{2, 2, 2}));
  const Image& image = std::get<Image>(scene.textures.at(static_cast<std::size_t>(scene.lights[0].texture)).image);
  EXPECT_EQ(image.width, 2 * image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_EQ(image.pixels[i], pixels[i % 3]);
}

TEST_F(ToolScene, TexturesAreMappedWrappedAndChequered) {
  const SceneDescription scene = read_world(
      std::string(
          "Texture \"c\" \"spectrum\" \"checkerboard\" \"float uscale\" 4 \"float vscale\" 6 \"float udelta\" 1 "
          "\"rgb tex1\" [1 0 0] \"rgb tex2\" [0 0 1]\nMaterial \"diffuse\" \"texture reflectance\" \"c\"\n") +
      kTriangle);
  const TextureUse& use = scene.materials[0].reflectance_texture;
  EXPECT_EQ(use.transform, (std::array<float, 6>{2, 0, .5f, 0, 3, 0}));  // the image is two squares wide
  const TextureDescription& texture = scene.textures.at(static_cast<std::size_t>(use.texture));
  EXPECT_TRUE(texture.nearest);
  const Image& image = std::get<Image>(texture.image);
  const std::size_t last_row = std::size_t{3} * image.width * (image.height - 1);  // v = 0
  EXPECT_EQ(image.pixels[last_row], 1);                                            // the square at the origin
  EXPECT_EQ(image.pixels[last_row + 3 * (image.width - 1)], 0);
  EXPECT_EQ(image.pixels[0], 0);
}

TEST_F(ToolScene, AlphaOfAShapeIsItsMaterials) {
  const SceneDescription scene = read_world(
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"float alpha\" .25\n" + std::string(kTriangle));
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.instances[0].material)].alpha.factor, .25f);
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.instances[0].material)].alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.instances[1].material)].alpha_mode, AlphaMode::kOpaque);
}

TEST_F(ToolScene, SharedScenesAreReadWithoutWarnings) {
  const std::filesystem::path folder = std::filesystem::path(BDPT_SHARED_DIR) / "scenes/bitterli";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the shared scenes are not here";
  const std::pair<const char*, std::size_t> scenes[] = {{"veach-bidir", 14}, {"cornell-box", 8}, {"water-caustic", 10}};
  for (const auto& [name, instances] : scenes) {
    const SceneDescription scene = read_scene((folder / name / "scene-v4.pbrt").string(), diagnostics_);
    EXPECT_EQ(scene.instances.size(), instances) << name;
  }
  const SceneDescription ajar =
      read_scene((folder / "veach-ajar/scene-v4-present-textures.pbrt").string(), diagnostics_);
  EXPECT_EQ(ajar.shapes.size(), 18u);  // 17 mesh files and the light
  EXPECT_EQ(ajar.instances.size(), 22u);
  EXPECT_EQ(ajar.textures.size(), 3u);
  for (const std::string& text : diagnostics_.texts()) EXPECT_NE(text.find("bilinearly"), std::string::npos) << text;
}

}  // namespace bdpt_tool::tool_scene_test
