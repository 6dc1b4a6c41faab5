// SPDX-License-Identifier: Apache-2.0
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

namespace bdpt_experiments {

SceneDescription brown_spheres() {
  SceneMaker make;
  const int grey = make.diffuse({0.6f, 0.6f, 0.6f}), red = make.diffuse({0.65f, 0.15f, 0.1f});
  const int blue = make.diffuse({0.15f, 0.25f, 0.65f}), mirror = make.mirror(), glass = make.glass();
  make.quad({-12, 0, 12}, {12, 0, 12}, {12, 0, -12}, {-12, 0, -12}, grey);
  const int row[2][4] = {{red, mirror, glass, blue}, {glass, blue, mirror, glass}};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i)
      make.sphere({-2.4f + 1.6f * float(i) + 0.5f * float(j), 0.6f, -0.8f + 1.7f * float(j)}, 0.6f, row[j][i]);
  make.sphere({-0.4f, 4, -0.6f}, 0.12f, make.emitter({900, 850, 750}));
  make.camera({0, 4.2f, 8.5f}, {0.1f, 0.4f, 0}, 37);
  make.image(4, 3);
  return std::move(make).finish("spheres on a floor");
}

SceneDescription brown_meshes() {
  SceneMaker make;
  const int floor = make.diffuse({0.6f, 0.55f, 0.5f});
  const int phong = make.metal({0.14f, 0.38f, 1.44f}, {3.98f, 2.40f, 1.60f}, 0.2f);
  make.quad({-12, 0, 12}, {12, 0, 12}, {12, 0, -12}, {-12, 0, -12}, floor);
  make.mesh(torus({-2.3f, 0.42f, 0}, 0.85f, 0.4f), phong);
  make.mesh(bumpy_ball({0, 0.95f, -1.2f}, 0.9f), make.mirror());
  make.mesh(knot({2.2f, 0.72f, 0.3f}, 1.1f, 0.27f), make.glass());
  const int lamp = make.emitter({700, 650, 550});
  make.quad({0.85f, 4, -0.15f}, {1.15f, 4, -0.15f}, {1.15f, 4, 0.15f}, {0.85f, 4, 0.15f}, lamp);
  make.camera({0, 4.0f, 8.0f}, {0.1f, 0.4f, 0}, 37);
  make.image(4, 3);
  return std::move(make).finish("meshes on a floor");
}

}  // namespace bdpt_experiments
