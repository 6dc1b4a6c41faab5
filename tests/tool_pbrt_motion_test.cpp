// pbrt's transforms that change with time: where things and cameras are when the shutter opens and closes.
//
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "pbrt/motion.h"
#include "tool_picture.h"

namespace bdpt_tool::tool_pbrt_motion_test {

const char kTriangle[] = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";
const char kCamera[] = "Camera \"perspective\"";

using Rows = std::array<float, 12>;

std::array<float, 3> place(const Rows& m) { return {m[3], m[7], m[11]}; }

class ToolPbrtMotion : public ToolPicture {
 protected:
  SceneDescription read_world(const std::string& world) { return read(kCamera, world); }
  const InstanceDescription& first(const SceneDescription& scene) { return scene.instances.at(0); }
};

TEST_F(ToolPbrtMotion, ActiveTransformsChangeTheirEndAlone) {
  const SceneDescription scene =
      read_world(std::string("Translate 1 0 0\nAttributeBegin\nActiveTransform EndTime\nTranslate 0 2 0\n") +
                 "ActiveTransform StartTime\nTranslate 0 0 3\nActiveTransform All\nScale 2 2 2\n" + kTriangle +
                 "ActiveTransform EndTime\nAttributeEnd\nTranslate 4 0 0\n" + kTriangle);
  EXPECT_EQ(place(first(scene).transform), (std::array<float, 3>{1, 0, 3}));
  ASSERT_TRUE(first(scene).end_transform);
  EXPECT_EQ(place(*first(scene).end_transform), (std::array<float, 3>{1, 2, 0}));
  EXPECT_EQ((*first(scene).end_transform)[0], 2);
  EXPECT_FALSE(scene.instances.at(1).end_transform);  // All again after the block
  EXPECT_EQ(place(scene.instances.at(1).transform), (std::array<float, 3>{5, 0, 0}));
  EXPECT_EQ(diagnostics_.count(), 0u);
}

TEST_F(ToolPbrtMotion, NamedSystemsAndObjectsMove) {
  const SceneDescription scene =
      read_world(std::string("ObjectBegin \"o\"\nActiveTransform EndTime\nTranslate 0 1 0\n") + kTriangle +
                 "ObjectEnd\nActiveTransform EndTime\nTranslate 1 0 0\nCoordinateSystem \"s\"\nActiveTransform All\n"
                 "Identity\nCoordSysTransform \"s\"\nObjectInstance \"o\"\n");
  EXPECT_EQ(place(first(scene).transform), (std::array<float, 3>{0, 0, 0}));
  EXPECT_EQ(place(first(scene).end_transform.value()), (std::array<float, 3>{1, 1, 0}));
}

TEST_F(ToolPbrtMotion, WhatCountsIsThePartWhileTheShutterIsOpen) {
  const std::string moving = std::string("ActiveTransform EndTime\nTranslate 8 0 0\n") + kTriangle;
  const auto camera = [](const std::string& shutter) {
    return "TransformTimes 0 4\nCamera \"perspective\" " + shutter;
  };
  SceneDescription scene = read(camera("\"float shutteropen\" 1 \"float shutterclose\" 2"), moving);
  EXPECT_EQ(place(first(scene).transform)[0], 2);
  EXPECT_EQ(place(first(scene).end_transform.value())[0], 4);
  scene = read(camera("\"float shutteropen\" 3 \"float shutterclose\" 3"), moving);
  EXPECT_EQ(place(first(scene).transform)[0], 6);
  EXPECT_FALSE(first(scene).end_transform);
  scene = read(camera("\"float shutteropen\" 5 \"float shutterclose\" 6"), moving);
  EXPECT_EQ(place(first(scene).transform)[0], 8);
  EXPECT_FALSE(first(scene).end_transform);
  EXPECT_EQ(diagnostics_.count(), 0u);
  scene = read(camera("\"float shutteropen\" 2 \"float shutterclose\" 6"), moving);
  EXPECT_EQ(place(first(scene).end_transform.value())[0], 8);
  EXPECT_EQ(notes_with("scene.pbrt:6: moves during a part of the exposure alone"), 1u);
  read(camera("\"float shutteropen\" 2 \"float shutterclose\" 1"), moving);
  EXPECT_EQ(notes_with("the shutter closes before it opens"), 1u);
}

// Half of the time is half of the angle, of which a straight line between the matrices is no rotation.
TEST_F(ToolPbrtMotion, CamerasTurnEvenly) {
  const SceneDescription scene = read(
      "TransformTimes 0 2\nActiveTransform EndTime\nRotate 80 0 1 0\nCamera \"perspective\" \"float shutterclose\" 1",
      kTriangle);
  const Rows& end = scene.camera.end_transform.value();
  const double half = 40 * std::numbers::pi / 180;
  EXPECT_NEAR(end[0], std::cos(half), 1e-6);
  EXPECT_NEAR(std::abs(end[2]), std::sin(half), 1e-6);
  EXPECT_NEAR(end[5], 1, 1e-6);
  EXPECT_EQ(scene.camera.transform[0], 1);
  EXPECT_FALSE(read(std::string("Rotate 80 0 1 0\n") + kCamera, kTriangle).camera.end_transform);
}

TEST_F(ToolPbrtMotion, WhatCannotMoveSoIsToldOf) {
  const std::string move = "ActiveTransform EndTime\nTranslate 1 0 0\n";
  SceneDescription scene = read_world(move + "AreaLightSource \"diffuse\"\n" + kTriangle);
  EXPECT_FALSE(first(scene).end_transform);
  EXPECT_EQ(notes_with("scene.pbrt:6: what emits does not move here; it stays where it starts"), 1u);
  scene = read_world(move + "LightSource \"point\"\n" + kTriangle);
  EXPECT_EQ(scene.lights.at(0).position, (Rgb{0, 0, 0}));
  EXPECT_EQ(notes_with("scene.pbrt:5: LightSource \"point\": lights do not move"), 1u);
  read_world(std::string("ActiveTransform EndTime\nRotate 4 0 0 1\n") + kTriangle);
  EXPECT_EQ(notes_with("smaller"), 0u);
  read_world(std::string("ActiveTransform EndTime\nRotate 60 0 0 1\n") + kTriangle);
  EXPECT_EQ(notes_with("scene.pbrt:5: turns so far that it gets 13.397460 % smaller"), 1u);  // 1 - cos 30 degrees
}

TEST_F(ToolPbrtMotion, ASphereThatTurnsStaysASphere) {
  const SceneDescription scene =
      read_world("ActiveTransform EndTime\nTranslate 1 0 0\nRotate 120 0 0 1\nScale 2 2 2\nShape \"sphere\"\n");
  const Rows& end = first(scene).end_transform.value();
  EXPECT_EQ(place(end)[0], 1);
  EXPECT_FLOAT_EQ(end[0], 2);
  EXPECT_FLOAT_EQ(end[1], 0);
  EXPECT_EQ(notes_with("smaller"), 0u);
}

TEST_F(ToolPbrtMotion, WrongTimesAreAnErrorWithTheirLine) {
  const auto error = [&](const std::string& head) {
    try {
      read(head, kTriangle);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(error("TransformTimes 1 1\n").find("scene.pbrt:1: TransformTimes: the second must be the later one"),
            std::string::npos);
  EXPECT_NE(error("Camera \"perspective\"\nTransformTimes 0 1").find(":2: TransformTimes must come before Camera"),
            std::string::npos);
  EXPECT_NE(error("ActiveTransform Both\n").find(":1: ActiveTransform: give StartTime, EndTime or All"),
            std::string::npos);
}

// A black wall covers the view after a quarter of the time; a camera that moves the other way sees the same.
TEST_F(ToolPbrtMotion, ThePictureIsTheMeanOverTheTime) {
  const std::string sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
  const std::string wall =
      "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
      "\"point3 P\" [-5 -9 2  -1 -9 2  -1 9 2  -5 9 2]\n";
  const std::string view = "Camera \"perspective\" \"float fov\" 0.5";
  const float still = radiance(read(view, sky + wall))[0];
  EXPECT_EQ(still, 1);
  const float moved =
      radiance(read(view, sky + "ActiveTransform EndTime\nTranslate 4 0 0\nActiveTransform All\n" + wall))[0];
  EXPECT_NEAR(moved, 0.25f, 0.04f);
  const float panned = radiance(read("ActiveTransform EndTime\nTranslate 4 0 0\n" + view, sky + wall))[0];
  EXPECT_NEAR(panned, 0.25f, 0.04f);
}

}  // namespace bdpt_tool::tool_pbrt_motion_test
