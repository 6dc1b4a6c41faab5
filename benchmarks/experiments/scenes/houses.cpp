// Scenes whose lamps mostly light other rooms than the one in view.
//
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "scenes/scenes.h"

namespace bdpt_experiments {
namespace {

constexpr float kWidth = 3.2f, kHeight = 2.4f, kDepth = 3.6f;

// A closed room with a lamp under its ceiling and something on its floor; x, y, z its low corner.
void add_room(SceneMaker& make, float x, float y, float z, int walls, int lamp) {
  make.box({x, y, z}, {x + kWidth, y + kHeight, z + kDepth}, walls, true);
  const float cx = x + kWidth / 2, cz = z + kDepth / 2, top = y + kHeight - 0.25f, half = 0.25f;
  make.quad({cx - half, top, cz - half}, {cx + half, top, cz - half}, {cx + half, top, cz + half},
            {cx - half, top, cz + half}, lamp);
}

}  // namespace

SceneDescription stacked_houses() {
  constexpr int kHouses = 11, kRooms = 3;
  SceneMaker make;
  const int white = make.diffuse({0.7f, 0.68f, 0.64f}), wood = make.diffuse({0.5f, 0.3f, 0.15f});
  const int blue = make.diffuse({0.2f, 0.3f, 0.6f}), lamp = make.emitter({12, 11, 9});
  const int brass = make.metal({0.44f, 0.53f, 1.09f}, {3.7f, 2.77f, 1.83f}, 0.25f);
  for (int house = 0; house < kHouses; ++house)
    for (int room = 0; room < kRooms; ++room) add_room(make, 4 * float(room), 3 * float(house), 0, white, lamp);
  // The room in view: the middle one of the middle house. Its floor is at y, its back wall at z = 0.
  const float x = 4, y = 3 * 5;
  make.box({x + 0.3f, y, 0.2f}, {x + 1.4f, y + 0.75f, 0.9f}, wood);         // a chest
  make.box({x + 1.8f, y + 0.6f, 0.6f}, {x + 3.0f, y + 0.66f, 1.5f}, wood);  // a table
  for (const float leg_x : {1.85f, 2.9f})
    for (const float leg_z : {0.65f, 1.4f})
      make.box({x + leg_x, y, leg_z}, {x + leg_x + 0.06f, y + 0.6f, leg_z + 0.06f}, wood);
  make.sphere({x + 2.4f, y + 0.86f, 1.05f}, 0.2f, brass);
  make.sphere({x + 0.8f, y + 0.95f, 0.55f}, 0.2f, blue);
  make.sphere({x + 1.4f, y + 0.3f, 1.9f}, 0.3f, blue);
  make.box({x + 0.5f, y + 1.3f, 0.001f}, {x + 1.5f, y + 1.9f, 0.03f}, blue);  // a picture on the wall
  make.camera({x + 1.6f, y + 1.4f, 3.5f}, {x + 1.6f, y + 1.05f, 0}, 50);
  make.image(4, 3);
  return std::move(make).finish("stacked houses");
}

SceneDescription bathroom() {
  SceneMaker make;
  const int tiles = make.diffuse({0.75f, 0.78f, 0.8f}), floor = make.diffuse({0.25f, 0.35f, 0.4f});
  const int ceramic = make.diffuse({0.85f, 0.85f, 0.82f}), mirror = make.mirror(0.92f), glass = make.glass();
  const int steel = make.metal({2.9f, 2.9f, 2.6f}, {3.1f, 3.0f, 2.8f}, 0.15f);
  const int wood = make.diffuse({0.45f, 0.28f, 0.15f}), lamp = make.emitter({55, 50, 40});
  const int shade = make.diffuse({0.8f, 0.75f, 0.6f});
  make.box({-1.5f, 0, 0}, {1.5f, 2.5f, 3.2f}, tiles, true);
  make.box({-1.5f, 0, 0}, {1.5f, 0.01f, 3.2f}, floor);
  make.box({-1.0f, 1.1f, 0.001f}, {0.6f, 1.9f, 0.02f}, mirror);
  make.box({-1.1f, 0.7f, 0.001f}, {0.7f, 0.8f, 0.55f}, wood);     // the board under the mirror
  make.box({-0.6f, 0.8f, 0.1f}, {0.2f, 0.95f, 0.5f}, ceramic);    // the basin
  make.box({-0.22f, 0.95f, 0.06f}, {-0.18f, 1.1f, 0.1f}, steel);  // the tap
  make.box({-0.22f, 1.06f, 0.1f}, {-0.18f, 1.1f, 0.28f}, steel);
  make.box({0.75f, 0.01f, 0.4f}, {1.5f, 0.55f, 2.2f}, ceramic);  // the tub
  make.sphere({0.4f, 0.9f, 0.35f}, 0.1f, glass);
  make.sphere({-0.85f, 0.9f, 0.35f}, 0.1f, steel);
  // Two lamps over the mirror, each behind a shade that is open above and below.
  for (const float x : {-0.7f, 0.3f}) {
    make.box({x - 0.14f, 2.0f, 0.16f}, {x + 0.14f, 2.2f, 0.17f}, shade);
    make.box({x - 0.14f, 2.0f, 0.0f}, {x - 0.13f, 2.2f, 0.16f}, shade);
    make.box({x + 0.13f, 2.0f, 0.0f}, {x + 0.14f, 2.2f, 0.16f}, shade);
    make.sphere({x, 2.1f, 0.08f}, 0.05f, lamp);
  }
  make.camera({0.1f, 1.45f, 3.1f}, {-0.05f, 1.15f, 0}, 52);
  make.image(4, 3);
  return std::move(make).finish("bathroom");
}

void add_unreachable_emitters(SceneDescription& scene) {
  constexpr int kCopies = 10;
  constexpr float kApart = 400, kHalf = 100;
  std::vector<bdpt_tool::InstanceDescription> emitters;
  for (const auto& instance : scene.instances)
    if (scene.materials[static_cast<std::size_t>(instance.material)].emits()) emitters.push_back(instance);
  bdpt_tool::MaterialDescription wall;
  wall.type = BDPT_MATERIAL_DIFFUSE;
  scene.materials.push_back(wall);
  SceneMaker box;
  box.box({-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}, 0, true);
  scene.shapes.push_back(std::move(box).finish("").shapes.front());
  for (int copy = 1; copy <= kCopies; ++copy) {
    const float offset = kApart * float(copy);
    for (auto emitter : emitters) {
      emitter.transform[3] += offset;
      scene.instances.push_back(emitter);
    }
    bdpt_tool::InstanceDescription room;
    room.shape = static_cast<int>(scene.shapes.size()) - 1;
    room.material = static_cast<int>(scene.materials.size()) - 1;
    room.transform = {1, 0, 0, offset, 0, 1, 0, 0, 0, 0, 1, 0};
    scene.instances.push_back(room);
  }
}

}  // namespace bdpt_experiments
