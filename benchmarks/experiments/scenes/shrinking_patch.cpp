// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "scenes/scenes.h"

namespace bdpt_experiments {

SceneDescription shrinking_patch(float patch_radius) {
  SceneMaker make;
  const int white = make.diffuse({0.75f, 0.75f, 0.75f});
  const int blue = make.diffuse({0.25f, 0.35f, 0.6f});
  const int ochre = make.diffuse({0.7f, 0.5f, 0.2f});
  make.box({-2, 0, -2}, {2, 2.4f, 3}, white, true);
  make.turned_box({-0.8f, 0.4f, -0.6f}, {0.4f, 0.4f, 0.4f}, 20, blue);
  make.sphere({0.7f, 0.45f, -0.4f}, 0.45f, ochre);
  // The lamp stands on a pole and looks up; the cone's flux is 2 pi I (1 - cos a).
  const float height = 1.2f, angle = std::atan(patch_radius / (2.4f - height));
  const float intensity = 40 / (2 * std::numbers::pi_v<float> * (1 - std::cos(angle)));
  make.turned_box({0, height / 2 - 0.02f, -1.2f}, {0.03f, height / 2 - 0.02f, 0.03f}, 45, ochre);
  make.spot({0, height, -1.2f}, {0, 1, 0}, {intensity, intensity * 0.9f, intensity * 0.7f},
            angle * 180 / std::numbers::pi_v<float>);
  make.camera({0, 1.2f, 2.9f}, {0, 1.1f, 0}, 50);
  make.image(4, 3);
  return std::move(make).finish("a room lit through a patch of its ceiling");
}

}  // namespace bdpt_experiments
