// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "image.h"

namespace bdpt_tool {
namespace {

template <class T>
Image linear_of(const CodedImage<T>& coded, float exponent) {
  constexpr std::size_t kValues = std::size_t{std::numeric_limits<T>::max()} + 1;
  std::vector<float> table(kValues);
  for (std::size_t i = 0; i < kValues; ++i) {
    table[i] = decode(static_cast<float>(i) / static_cast<float>(kValues - 1), exponent);
  }
  Image image(coded.width, coded.height);
  const std::size_t step = coded.channels, last = step == 1 ? 0 : 2;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = table[coded.pixels[i / 3 * step + std::min(i % 3, last)]];
  }
  return image;
}

const Image& linear_of(const Image& image, float) { return image; }

}  // namespace

float srgb_to_linear(float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); }

float decode(float coded, float exponent) {
  if (exponent == 0) return srgb_to_linear(coded);
  return exponent == 1 ? coded : std::pow(coded, exponent);
}

Image to_linear(const AnyImage& image, float exponent) {
  return std::visit([&](const auto& any) -> Image { return linear_of(any, exponent); }, image);
}

std::uint32_t width_of(const AnyImage& image) {
  return std::visit([](const auto& any) { return any.width; }, image);
}

std::uint32_t height_of(const AnyImage& image) {
  return std::visit([](const auto& any) { return any.height; }, image);
}

bool has_alpha(const AnyImage& image) {
  if (const auto* bytes = std::get_if<ByteImage>(&image)) return bytes->channels == 4;
  if (const auto* words = std::get_if<WordImage>(&image)) return words->channels == 4;
  return false;
}

}  // namespace bdpt_tool
