// SPDX-License-Identifier: Apache-2.0
#include "pbrt/environment.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace bdpt_tool {
namespace {

constexpr int kSamples = 4;  // of a texel, each way

// pbrt's z is up. Where x and y are turned round into one another, an image by pbrt's longitude lies mirrored;
// columns() sees to that.
constexpr Transform kToPbrt = {{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}};

// Directions on the equirectangular picture: -z in its middle, +x to the right, +y at its top.
Vec3 equirectangular(double u, double v) {
  const double longitude = 2 * std::numbers::pi * (u - 0.5), latitude = std::numbers::pi * (0.5 - v);
  return {std::sin(longitude) * std::cos(latitude), std::sin(latitude), -std::cos(longitude) * std::cos(latitude)};
}

const float* texel(const Image& image, const std::array<double, 2>& at) {
  const auto place = [](double x, std::uint32_t size) {
    return static_cast<std::size_t>(std::clamp(x * size, 0.0, size - 1.0));
  };
  return &image.pixels[3 * (place(at[1], image.height) * image.width + place(at[0], image.width))];
}

// Each texel the mean of the square's texels at its samples.
Image from_square(const Image& square, bool mirrored) {
  Image image(2 * square.width, square.width);
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      std::array<double, 3> sum = {};
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const double u = (x + (i % kSamples + 0.5) / kSamples) / image.width;
        const double v = (y + (i / kSamples + 0.5) / kSamples) / image.height;
        Vec3 d = equirectangular(u, v);
        if (mirrored) d[0] = -d[0];
        const float* from = texel(square, square_of(kToPbrt.vector(d)));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<double>(from[c]);
      }
      float* to = &image.pixels[3 * (std::size_t{y} * image.width + x)];
      for (std::size_t c = 0; c < 3; ++c) to[c] = static_cast<float>(sum[c] / (kSamples * kSamples));
    }
  }
  return image;
}

// pbrt's longitude runs the other way round.
Image from_rows(const Image& rows, bool mirrored) {
  Image image = rows;
  if (mirrored) return image;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const std::size_t row = std::size_t{y} * image.width;
      std::copy_n(&rows.pixels[3 * (row + image.width - 1 - x)], 3, &image.pixels[3 * (row + x)]);
    }
  }
  return image;
}

}  // namespace

std::array<double, 2> square_of(const Vec3& direction) {
  const double x = std::abs(direction[0]), y = std::abs(direction[1]), z = std::abs(direction[2]);
  const double r = std::sqrt(std::max(0.0, 1 - z));
  const double greater = std::max(x, y);
  double phi = greater == 0 ? 0 : std::atan(std::min(x, y) / greater) * 2 / std::numbers::pi;
  if (x < y) phi = 1 - phi;
  double v = phi * r, u = r - v;
  if (direction[2] < 0) {
    std::swap(u, v);
    u = 1 - u;
    v = 1 - v;
  }
  return {(std::copysign(u, direction[0]) + 1) / 2, (std::copysign(v, direction[1]) + 1) / 2};
}

Vec3 direction_of(const std::array<double, 2>& square) {
  const double u = 2 * square[0] - 1, v = 2 * square[1] - 1;
  const double distance = 1 - (std::abs(u) + std::abs(v)), r = 1 - std::abs(distance);
  const double phi = (r == 0 ? 1 : (std::abs(v) - std::abs(u)) / r + 1) * std::numbers::pi / 4;
  const double sine = r * std::sqrt(2 - r * r);
  return {std::copysign(std::cos(phi), u) * sine, std::copysign(std::sin(phi), v) * sine,
          std::copysign(1 - r * r, distance)};
}

PlacedPicture place_picture(const Image& image, const Transform& to_world) {
  const bool mirrored = to_world.determinant() < 0;
  Transform rotation = to_world * kToPbrt;
  if (mirrored) rotation = rotation * scaling(-1, 1, 1);
  const double scale = std::cbrt(std::abs(to_world.determinant()));
  for (auto& row : rotation.m) {
    for (std::size_t i = 0; i < 3; ++i) row[i] /= scale;
    row[3] = 0;
  }
  PlacedPicture placed;
  placed.image = image.width == image.height ? from_square(image, mirrored) : from_rows(image, mirrored);
  placed.to_world = rotation.rows();
  return placed;
}

}  // namespace bdpt_tool
