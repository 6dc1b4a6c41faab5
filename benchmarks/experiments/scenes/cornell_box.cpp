// SPDX-License-Identifier: Apache-2.0
#include "scenes/scenes.h"

namespace bdpt_experiments {
namespace {

constexpr float kLampHeight = 1.9f, kLampHalf = 0.25f;

void add_lamp(SceneMaker& make, BoxLight light) {
  constexpr float y = kLampHeight, h = kLampHalf;
  const int lamp = make.emitter({17, 12, 4}), plate = make.diffuse({0.2f, 0.2f, 0.2f});
  if (light == BoxLight::Up)
    make.quad({-h, y, h}, {h, y, h}, {h, y, -h}, {-h, y, -h}, lamp);
  else
    make.quad({-h, y, -h}, {h, y, -h}, {h, y, h}, {-h, y, h}, lamp);
  if (light == BoxLight::Occluded) {
    constexpr float p = 1.6f * h, under = y - 0.1f;
    make.box({-p, under - 0.02f, -p}, {p, under, p}, plate);
  }
}

}  // namespace

SceneDescription cornell_box(BoxContents contents, BoxLight light) {
  SceneMaker make;
  const int white = make.diffuse({0.73f, 0.73f, 0.73f});
  const int red = make.diffuse({0.63f, 0.06f, 0.05f});
  const int green = make.diffuse({0.14f, 0.45f, 0.09f});
  make.mapped_quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, white);  // floor
  make.quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, white);    // ceiling
  make.quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, white);  // back
  make.quad({-1, 0, 1}, {-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, red);    // left
  make.quad({1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}, green);      // right
  add_lamp(make, light);
  switch (contents) {
    case BoxContents::Boxes:
      make.turned_box({-0.34f, 0.6f, -0.35f}, {0.3f, 0.6f, 0.3f}, 17, white);
      make.turned_box({0.36f, 0.3f, 0.35f}, {0.3f, 0.3f, 0.3f}, -17, white);
      break;
    case BoxContents::GlassSphere:
      make.sphere({0, 0.5f, 0}, 0.5f, make.glass());
      break;
    case BoxContents::MirrorAndGlass:
      make.sphere({-0.45f, 0.4f, -0.35f}, 0.4f, make.mirror());
      make.sphere({0.45f, 0.4f, 0.3f}, 0.4f, make.glass());
      break;
    case BoxContents::TwoDiffuse:
      make.sphere({-0.45f, 0.4f, -0.35f}, 0.4f, white);
      make.sphere({0.45f, 0.4f, 0.3f}, 0.4f, white);
      break;
  }
  make.camera({0, 1, 6.8f}, {0, 1, 0}, 19.5f);
  make.image(1, 1);
  return std::move(make).finish("Cornell box");
}

}  // namespace bdpt_experiments
