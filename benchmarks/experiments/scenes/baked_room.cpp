// SPDX-License-Identifier: Apache-2.0
#include "scenes/scenes.h"

namespace bdpt_experiments {

SceneDescription baked_room(BakedRoom room) {
  SceneMaker make;
  const int grey = make.diffuse({0.6f, 0.6f, 0.6f});
  const auto level = [&](float half, float y, bool up, int material) {
    const float z = up ? half : -half;
    make.quad({-half, y, z}, {half, y, z}, {half, y, -z}, {-half, y, -z}, material);
  };
  make.mapped_quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, grey);
  level(1, 1, false, grey);
  make.quad({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, grey);
  make.quad({1, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, grey);
  make.quad({-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, grey);
  make.quad({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, grey);
  switch (room) {
    case BakedRoom::Plain:
      level(0.4f, 0.99f, false, make.emitter({4, 4, 4}));
      break;
    case BakedRoom::GlassSphere:
      level(0.1f, 0.99f, false, make.emitter({60, 60, 60}));
      make.sphere({0, -0.3f, 0}, 0.4f, make.glass());
      break;
    case BakedRoom::Gap: {
      constexpr float h = 0.5f, low = 0.7f, high = 0.97f;
      level(0.3f, 0.8f, true, make.emitter({20, 20, 20}));
      level(h, low, false, grey);
      make.quad({-h, low, h}, {h, low, h}, {h, high, h}, {-h, high, h}, grey);
      make.quad({h, low, -h}, {-h, low, -h}, {-h, high, -h}, {h, high, -h}, grey);
      make.quad({h, low, h}, {h, low, -h}, {h, high, -h}, {h, high, h}, grey);
      make.quad({-h, low, -h}, {-h, low, h}, {-h, high, h}, {-h, high, -h}, grey);
      break;
    }
  }
  return std::move(make).finish("a room whose floor is baked");
}

}  // namespace bdpt_experiments
