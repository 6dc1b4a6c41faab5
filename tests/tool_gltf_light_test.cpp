// Lights and cameras of glTF, and what stands in where there is none.
//
// SPDX-License-Identifier: Apache-2.0
#include "gltf_fixture.h"

namespace bdpt_tool::tool_gltf_light_test {

class ToolGltfLight : public ToolGltf {
 protected:
  SceneDescription read_light(const std::string& light, const std::string& node = "") {
    const std::string mesh_text = mesh_of(triangle());
    return read_nodes(
        "{\"mesh\":0,\"children\":[1]},{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}" + node + "}",
        mesh_text + ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{" + light + "}]}}");
  }
};

TEST_F(ToolGltfLight, CandelaAreWattsPerSteradian) {
  const SceneDescription scene =
      read_light("\"type\":\"point\",\"color\":[1,0.5,0.25],\"intensity\":40,\"range\":3", ",\"translation\":[1,2,3]");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, BDPT_LIGHT_POINT);
  EXPECT_EQ(scene.lights[0].value, (Rgb{40, 20, 10}));
  EXPECT_EQ(scene.lights[0].position, (Rgb{1, 2, 3}));
  EXPECT_EQ(notes_with("the range of a light"), 1u);
}

TEST_F(ToolGltfLight, SpotsShineAlongMinusZBetweenTheirAngles) {
  const SceneDescription scene = read_light(
      "\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.3490658503988659,\"outerConeAngle\":0.5235987755982988}",
      ",\"rotation\":[0,1,0,0]");
  const LightDescription& spot = scene.lights.at(0);
  EXPECT_EQ(spot.type, BDPT_LIGHT_SPOT);
  expect_near({spot.direction[0], spot.direction[1], spot.direction[2]}, Vec3{0, 0, 1});
  EXPECT_NEAR(spot.cone_angle, 30, 1e-4);
  EXPECT_NEAR(spot.cone_falloff, 10, 1e-4);
}

TEST_F(ToolGltfLight, LuxAreWattsPerSquareMetreAlongMinusZ) {
  const LightDescription sun =
      read_light("\"type\":\"directional\",\"name\":\"sun\",\"intensity\":3", ",\"rotation\":[0,1,0,0]").lights.at(0);
  EXPECT_EQ(sun.type, BDPT_LIGHT_DIRECTIONAL);
  EXPECT_EQ(sun.value, (Rgb{3, 3, 3}));
  EXPECT_EQ(sun.label, "sun");
  expect_near({sun.direction[0], sun.direction[1], sun.direction[2]}, Vec3{0, 0, 1});
}

TEST_F(ToolGltfLight, WithoutALightThereIsAWhiteEnvironment) {
  const SceneDescription dark = read_material("\"pbrMetallicRoughness\":{\"metallicFactor\":0}");
  ASSERT_EQ(dark.lights.size(), 1u);
  EXPECT_EQ(dark.lights[0].type, BDPT_LIGHT_ENVIRONMENT);
  EXPECT_EQ(dark.lights[0].value, (Rgb{1, 1, 1}));
  EXPECT_EQ(notes_with("there is no light; an environment of radiance 1 is used"), 1u);
  buffer_ = GltfBuffer();
  EXPECT_TRUE(read_material("\"emissiveFactor\":[1,1,1]").lights.empty());
  EXPECT_EQ(read_light("\"type\":\"point\"").lights.size(), 1u);
}

TEST_F(ToolGltfLight, UnknownLightsAreAnError) {
  EXPECT_THROW(read_light("\"type\":\"area\""), Error);
  EXPECT_THROW(read_light("\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.5,\"outerConeAngle\":0.4}"), Error);
}

TEST_F(ToolGltf, ThePerspectiveCameraKeepsItsVerticalAngleForEveryShapeOfImage) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene =
      read_nodes("{\"mesh\":0,\"children\":[1]},{\"camera\":0,\"translation\":[1,2,3],\"scale\":[2,3,4]}",
                 mesh_text +
                     ",\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1.0471975511965976,"
                     "\"znear\":0.1,\"aspectRatio\":2}}]");
  EXPECT_EQ(scene.film.width, 1280u);
  EXPECT_EQ(scene.film.height, 640u);
  for (const std::uint32_t width : {50u, 100u, 300u}) {
    EXPECT_NEAR(camera_desc(scene, width, 100, diagnostics_).field_of_view, 60, 1e-4);
  }
  expect_near(transformed(scene.camera.transform, {0, 0, -1}, 1), {1, 2, 2});
  expect_near(transformed(scene.camera.transform, {1, 0, 0}, 0), {1, 0, 0});
  EXPECT_EQ(notes_with("no camera"), 0u) << notes();
}

TEST_F(ToolGltf, OrthographicCamerasAreOnesOfTheirHeight) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene =
      read_nodes("{\"mesh\":0,\"camera\":0,\"scale\":[7,7,7]}",
                 mesh_text +
                     ",\"cameras\":[{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":3,\"ymag\":1.5,"
                     "\"znear\":0,\"zfar\":1}}]");
  EXPECT_EQ(notes_with("camera"), 0u) << notes();
  EXPECT_EQ(scene.film.height, 640u);
  const bdpt_camera_desc camera = camera_desc(scene, 200, 100, diagnostics_);
  EXPECT_EQ(camera.type, BDPT_CAMERA_ORTHOGRAPHIC);
  EXPECT_FLOAT_EQ(camera.field_height, 3);
  EXPECT_EQ(camera.field_of_view, 0);
}

TEST_F(ToolGltf, WithoutACameraAllIsInThePicture) {
  const std::string mesh_text = mesh_of(triangle());
  const SceneDescription scene = read_nodes(
      "{\"children\":[1,2]},{\"mesh\":0,\"translation\":[-30,4,5]},{\"mesh\":0,\"scale\":[1,50,1]}", mesh_text);
  for (const std::uint32_t width : {50u, 200u}) {
    const bdpt_camera_desc camera = camera_desc(scene, width, 100, diagnostics_);
    Transform to_world;
    for (int i = 0; i < 12; ++i) to_world.m[i / 4][i % 4] = camera.transform[i];
    EXPECT_NEAR(to_world.determinant(), 1, 1e-5);  // not mirrored
    const double tangent = std::tan(camera.field_of_view * M_PI / 360);
    for (const InstanceDescription& instance : scene.instances) {
      for (std::size_t v = 0; v < 9; v += 3) {
        const Vec3 p = to_world.inverse().point(
            transformed(instance.transform, {kCorners[v], kCorners[v + 1], kCorners[v + 2]}, 1));
        EXPECT_LT(p[2], 0);
        EXPECT_LT(std::abs(p[1]), -p[2] * tangent);
        EXPECT_LT(std::abs(p[0]), -p[2] * tangent * width / 100);
      }
    }
  }
}

}  // namespace bdpt_tool::tool_gltf_light_test
