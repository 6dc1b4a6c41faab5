// SPDX-License-Identifier: Apache-2.0
#include "pbrt/light_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pbrt/environment.h"

namespace bdpt_tool {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr int kStep = 2;  // degrees

float grey(const Image& image, const std::array<double, 2>& at) {
  const auto place = [](double x, std::uint32_t size) {
    return static_cast<std::size_t>(std::clamp(x * size, 0.0, size - 1.0));
  };
  const float* p = &image.pixels[3 * (place(at[1], image.height) * image.width + place(at[0], image.width))];
  return (p[0] + p[1] + p[2]) / 3;
}

}  // namespace

ThrownPicture throw_picture(const Image& image, float fov, const Transform& to_world) {
  // In the middle of a square as wide as its diagonal; texels are halved where only one side has an odd number.
  const std::uint32_t parts = image.width % 2 == image.height % 2 ? 1 : 2;
  const std::uint32_t width = parts * image.width, height = parts * image.height;
  auto size = static_cast<std::uint32_t>(std::ceil(std::hypot(width, height)));
  size += (size - width) % 2;
  const std::uint32_t left = (size - width) / 2, top = (size - height) / 2;
  const bool mirrored = to_world.determinant() > 0;
  ThrownPicture thrown;
  thrown.image = Image(size, size);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t column = (mirrored ? width - 1 - x : x) / parts;
      const float* from = &image.pixels[3 * (std::size_t{y / parts} * image.width + column)];
      std::copy_n(from, 3, &thrown.image.pixels[3 * (std::size_t{y + top} * size + x + left)]);
    }
  }
  if (fov > 0 && fov < 180) {
    const double tangent = std::tan(fov * kRadians / 2) * size / std::min(width, height);
    thrown.cone_angle = static_cast<float>(std::atan(tangent) / kRadians);
  }
  return thrown;
}

Luminaire luminaire_of(const Image& square, const Transform& to_world) {
  // The library's angles turn from up to the left; where z is on the left of x, looking along y, is a matter of
  // mirrors.
  const double sense = to_world.determinant() > 0 ? 1 : -1;
  Luminaire luminaire;
  for (int v = 0; v <= 180; v += kStep) luminaire.vertical_angles.push_back(static_cast<float>(v));
  for (int h = 0; h <= 360; h += kStep) {
    luminaire.horizontal_angles.push_back(static_cast<float>(h));
    for (int v = 0; v <= 180; v += kStep) {
      const double theta = v * kRadians, phi = sense * (h % 360) * kRadians;
      // The pole is the square's z.
      luminaire.candela.push_back(
          grey(square, square_of({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)})));
    }
  }
  return luminaire;
}

}  // namespace bdpt_tool
