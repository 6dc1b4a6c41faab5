// SPDX-License-Identifier: Apache-2.0
#include "built_in_scene.h"

#include <utility>

#include "scene_maker.h"

namespace bdpt_benchmark {

bdpt_tool::SceneDescription built_in_scene() {
  SceneMaker make;
  const int white = make.diffuse({0.73f, 0.73f, 0.73f});
  const int red = make.diffuse({0.63f, 0.06f, 0.05f});
  const int green = make.diffuse({0.14f, 0.45f, 0.09f});
  const int light = make.emitter({17, 12, 4});
  const int mirror = make.mirror();
  const int glass = make.glass();
  make.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, white);    // floor
  make.quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, white);    // ceiling
  make.quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, white);  // back
  make.quad({-1, 0, 1}, {-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, red);    // left
  make.quad({1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}, green);      // right
  make.quad({-0.25f, 1.98f, -0.25f}, {0.25f, 1.98f, -0.25f}, {0.25f, 1.98f, 0.25f}, {-0.25f, 1.98f, 0.25f}, light);
  make.sphere({-0.45f, 0.4f, -0.35f}, 0.4f, mirror);
  make.sphere({0.45f, 0.4f, 0.3f}, 0.4f, glass);
  make.camera({0, 1, 6.8f}, {0, 1, 0}, 19.5f);
  make.image(1024, 1024);
  return std::move(make).finish("the built-in Cornell box");
}

}  // namespace bdpt_benchmark
