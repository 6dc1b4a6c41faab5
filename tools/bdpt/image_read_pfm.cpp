// Portable float maps: rows from the bottom up, of either byte order.
//
// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "image.h"

namespace bdpt_tool::detail {

Image read_pfm(const std::string& path, std::string_view data, const Location& from) {
  const bool colour = data[1] == 'F';
  std::size_t at = 3;
  double header[3];  // width, height, and a scale whose sign tells the byte order
  for (double& value : header) {
    while (at < data.size() && (data[at] == ' ' || data[at] == '\n')) ++at;
    const auto result = std::from_chars(data.data() + at, data.data() + data.size(), value);
    if (result.ec != std::errc()) fail_image(path, from, "its header is damaged");
    at = static_cast<std::size_t>(result.ptr - data.data());
  }
  ++at;  // one character ends the header
  const bool sizes = header[0] >= 1 && header[0] <= 65536 && header[0] == std::floor(header[0]) && header[1] >= 1 &&
                     header[1] <= 65536 && header[1] == std::floor(header[1]);
  if (!sizes || header[2] == 0 || !std::isfinite(header[2])) {
    fail_image(path, from, "its header is damaged: the size must be 1 to 65536, the scale not 0");
  }
  Image image;
  image.width = static_cast<std::uint32_t>(header[0]);
  image.height = static_cast<std::uint32_t>(header[1]);
  const std::size_t channels = colour ? 3 : 1, row = channels * image.width;
  if (at > data.size() || (data.size() - at) / sizeof(float) / row < image.height) {
    fail_image(path, from, "it is cut off");
  }
  image.pixels.resize(std::size_t{3} * image.width * image.height);
  const bool swap = (header[2] < 0) != (std::endian::native == std::endian::little);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::size_t y = image.height - 1 - i / 3 / image.width, x = i / 3 % image.width;
    std::uint32_t word;
    std::memcpy(&word, data.data() + at + sizeof(float) * (y * row + x * channels + (colour ? i % 3 : 0)), sizeof word);
    if (swap) word = word >> 24 | (word >> 8 & 0xff00) | (word << 8 & 0xff0000) | word << 24;
    image.pixels[i] = std::bit_cast<float>(word);
  }
  return image;
}

}  // namespace bdpt_tool::detail
