// The papers' scenes of which only words and numbers are known, and those of the shared folder.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene_maker.h"
#include "setting.h"

namespace bdpt_experiments {

using bdpt_benchmark::Point;
using bdpt_benchmark::Rgb;
using bdpt_benchmark::SceneMaker;
using bdpt_tool::SceneDescription;

// The Cornell box, 2 x 2 x 2 over the origin, open to the camera.
enum class BoxContents { Boxes, GlassSphere, MirrorAndGlass, TwoDiffuse };
enum class BoxLight { Down, Up, Occluded };  // occluded: a plate hangs under the lamp
SceneDescription cornell_box(BoxContents contents, BoxLight light);

// A room lit by a lamp that shines on a round patch of the ceiling alone. The lamp's flux stays the same.
SceneDescription shrinking_patch(float patch_radius);

// Eleven houses one upon another, three closed rooms with a lamp in each; the view is into one of them.
SceneDescription stacked_houses();

// A small bathroom: tiles, a large mirror, a glossy basin and tub, two lamps in shades over the mirror.
SceneDescription bathroom();

// Rooms of which the floor is baked: under a wide lamp; with a glass sphere under a lamp of a hundredth of the ceiling;
// under a lamp that shines up out of a box, through a gap below the ceiling.
enum class BakedRoom { Plain, GlassSphere, Gap };
SceneDescription baked_room(BakedRoom room);

// Brown's scenes: spheres on a floor under a small spherical lamp; meshes on a floor under a small square one.
SceneDescription brown_spheres();
SceneDescription brown_meshes();

// A hall under `count` lamps of the same power together.
SceneDescription lamp_hall(int count);

// A waved floor of about `count` triangles under a lamp.
SceneDescription triangle_field(std::uint64_t count);

// Ten emitters in closed boxes far from the view, as strong as the scene's own.
void add_unreachable_emitters(SceneDescription& scene);

// On which every plan is measured. make() throws SceneMissing where the scene is not there.
struct NamedScene {
  std::string name;
  std::function<SceneDescription()> make;
};
std::vector<NamedScene> scenes_of_the_table(const Setting& setting);

}  // namespace bdpt_experiments
