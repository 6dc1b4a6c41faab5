// SPDX-License-Identifier: Apache-2.0
#include "pbrt/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "parallel.h"

namespace bdpt_tool {
namespace {

constexpr std::uint32_t kSamples = 4;  // of a texel, each way

// pbrt's z is up. Where x and y are turned round into one another, an image by pbrt's longitude lies mirrored;
// columns() sees to that.
constexpr Transform kToPbrt = {{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}};

// Directions on the equirectangular picture: -z in its middle, +x to the right, +y at its top.
Vec3 equirectangular(double u, double v) {
  const double longitude = 2 * std::numbers::pi * (u - 0.5), latitude = std::numbers::pi * (0.5 - v);
  return {std::sin(longitude) * std::cos(latitude), std::sin(latitude), -std::cos(longitude) * std::cos(latitude)};
}

struct Longitude {
  double part;  // of the way from the axis x to the axis y of its quarter, [0,1]
  double x_sign, y_sign;
};

Longitude longitude_of(const Vec3& direction) {
  const double x = std::abs(direction[0]), y = std::abs(direction[1]), greater = std::max(x, y);
  const double part = greater == 0 ? 0 : std::atan(std::min(x, y) / greater) * 2 / std::numbers::pi;
  return {x < y ? 1 - part : part, std::copysign(1, direction[0]), std::copysign(1, direction[1])};
}

std::array<double, 2> square_of(const Longitude& longitude, double z) {
  const double r = std::sqrt(std::max(0.0, 1 - std::abs(z)));
  double v = longitude.part * r, u = r - v;
  if (z < 0) {
    std::swap(u, v);
    u = 1 - u;
    v = 1 - v;
  }
  return {(u * longitude.x_sign + 1) / 2, (v * longitude.y_sign + 1) / 2};
}

const float* texel(const Image& image, const std::array<double, 2>& at) {
  const auto place = [](double x, std::uint32_t size) {
    return static_cast<std::size_t>(std::clamp(x * size, 0.0, size - 1.0));
  };
  return &image.pixels[3 * (place(at[1], image.height) * image.width + place(at[0], image.width))];
}

// What samples of an equirectangular picture share: a column of them their longitude, a row their latitude.
std::vector<Longitude> longitudes(std::uint32_t width, bool mirrored) {
  std::vector<Longitude> all;
  for (std::uint32_t i = 0; i < kSamples * width; ++i) {
    Vec3 d = equirectangular((i + 0.5) / (kSamples * width), 0.5);
    if (mirrored) d[0] = -d[0];
    all.push_back(longitude_of(kToPbrt.vector(d)));
  }
  return all;
}

std::vector<double> heights(std::uint32_t height) {
  std::vector<double> all;
  for (std::uint32_t i = 0; i < kSamples * height; ++i)
    all.push_back(std::cos(std::numbers::pi * (i + 0.5) / (kSamples * height)));
  return all;
}

// Each texel the mean of the square's texels at its samples.
Image from_square(const Image& square, bool mirrored) {
  Image image(2 * square.width, square.width);
  const std::vector<Longitude> columns = longitudes(image.width, mirrored);
  const std::vector<double> rows = heights(image.height);
  parallel_for(image.height, [&](std::size_t y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      std::array<double, 3> sum = {};
      for (std::uint32_t i = 0; i < kSamples * kSamples; ++i) {
        const Longitude& column = columns[kSamples * x + i % kSamples];
        const float* from = texel(square, square_of(column, rows[kSamples * y + i / kSamples]));
        for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<double>(from[c]);
      }
      float* to = &image.pixels[3 * (y * image.width + x)];
      for (std::size_t c = 0; c < 3; ++c) to[c] = static_cast<float>(sum[c] / (kSamples * kSamples));
    }
  });
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

std::array<double, 2> square_of(const Vec3& direction) { return square_of(longitude_of(direction), direction[2]); }

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
