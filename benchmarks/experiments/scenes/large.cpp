// Scenes that grow: lamps, triangles.
//
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "scenes/scenes.h"
#include "scenes/surfaces.h"

namespace bdpt_experiments {

SceneDescription lamp_hall(int count) {
  constexpr float kHalf = 10, kHeight = 4, kArea = 4;  // of all lamps together
  SceneMaker make;
  const int white = make.diffuse({0.7f, 0.7f, 0.7f}), red = make.diffuse({0.6f, 0.2f, 0.15f});
  const int lamp = make.emitter({30, 28, 24});
  make.box({-kHalf, 0, -kHalf}, {kHalf, kHeight, kHalf}, white, true);
  for (int i = 0; i < 5; ++i)
    make.turned_box({-6 + 3 * float(i), 0.8f, -4 + 1.5f * float(i % 3)}, {0.5f, 0.8f, 0.5f}, 20 * float(i), red);
  const int side = int(std::ceil(std::sqrt(double(count))));
  const float half = std::sqrt(kArea / float(count)) / 2, y = kHeight - 0.05f;
  for (int i = 0; i < count; ++i) {
    const float x = kHalf * 0.9f * (2 * (float(i % side) + 0.5f) / float(side) - 1);
    const float z = kHalf * 0.9f * (2 * (float(i / side) + 0.5f) / float(side) - 1);
    make.quad({x - half, y, z - half}, {x + half, y, z - half}, {x + half, y, z + half}, {x - half, y, z + half}, lamp);
  }
  make.camera({0, 1.8f, 9.5f}, {0, 1.2f, -3}, 45);
  make.image(4, 3);
  return std::move(make).finish("a hall of lamps");
}

SceneDescription triangle_field(std::uint64_t count) {
  SceneMaker make;
  const auto side = std::uint32_t(std::lround(std::sqrt(double(count) / 2)));
  bdpt_tool::TriangleMesh mesh;
  mesh.positions.reserve(std::size_t{3} * (side + 1) * (side + 1));
  for (std::uint32_t j = 0; j <= side; ++j)
    for (std::uint32_t i = 0; i <= side; ++i) {
      const float x = 20 * float(i) / float(side) - 10, z = 10 - 20 * float(j) / float(side);
      mesh.positions.insert(mesh.positions.end(),
                            {x, 0.4f * std::sin(2 * x) * std::cos(1.7f * z) + 0.02f * std::sin(40 * x + 31 * z), z});
    }
  mesh.indices.reserve(std::size_t{6} * side * side);
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i) {
      const std::uint32_t a = j * (side + 1) + i, b = a + 1, c = b + side + 1, d = a + side + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  make.mesh(std::move(mesh), make.diffuse({0.6f, 0.6f, 0.5f}));
  const int lamp = make.emitter({40, 38, 32});
  make.quad({-2, 6, -2}, {2, 6, -2}, {2, 6, 2}, {-2, 6, 2}, lamp);
  make.camera({0, 5, 13}, {0, 0, 0}, 40);
  make.image(4, 3);
  return std::move(make).finish("a waved field");
}

}  // namespace bdpt_experiments
