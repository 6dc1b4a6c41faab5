// Images in memory and their readers. Row 0 is the top.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"

namespace bdpt_tool {

// Three floats to a pixel, linear.
struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<float> pixels;

  Image() = default;
  Image(std::uint32_t w, std::uint32_t h) : width(w), height(h), pixels(std::size_t{3} * w * h) {}
};

// Eight bits to a channel, as the file has them.
struct ByteImage {
  std::uint32_t width = 0, height = 0, channels = 0;  // 1 or 3 channels
  std::vector<std::uint8_t> pixels;
};

// JPEG or PNG, by what the file begins with. Alpha is dropped, 16 bits are rounded to 8.
ByteImage read_byte_image(const std::string& path, const Location& from = {});
// The same for a file in memory, which errors call `name`.
ByteImage decode_byte_image(const std::string& name, std::string_view data, const Location& from = {});

float srgb_to_linear(float x);
// Three channels, out of the sRGB curve.
Image to_linear(const ByteImage& bytes);

// The layers of an OpenEXR file that have channels R, G and B; the main one has an empty name, and is linear Rec. 709,
// converted where the file names other chromaticities.
std::map<std::string, Image> read_exr(const std::string& path, const Location& from = {});
// Those of each part of a file, by name; the former reads the first part alone.
std::map<std::string, std::map<std::string, Image>> read_exr_parts(const std::string& path);

namespace detail {
ByteImage read_jpeg(const std::string& path, const std::string_view& data, const Location& from);
ByteImage read_png(const std::string& path, const std::string_view& data, const Location& from);
[[noreturn]] void fail_image(const std::string& path, const Location& from, const std::string& reason);
}  // namespace detail

}  // namespace bdpt_tool
