// Images in memory and their readers. Row 0 is the top.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
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

// Whole numbers as the file has them: grey, RGB or RGBA.
template <class T>
struct CodedImage {
  std::uint32_t width = 0, height = 0, channels = 0;  // 1, 3 or 4 channels
  std::vector<T> pixels;
};
using ByteImage = CodedImage<std::uint8_t>;
using WordImage = CodedImage<std::uint16_t>;

using AnyImage = std::variant<ByteImage, WordImage, Image>;

std::uint32_t width_of(const AnyImage& image);
std::uint32_t height_of(const AnyImage& image);
bool has_alpha(const AnyImage& image);

// JPEG, PNG, Radiance HDR, PFM, OpenEXR or TGA, by what the file begins with; TGA, which has no such mark, by its name.
// Throws an Error for what is damaged, or so large that a file of its size cannot hold it.
AnyImage read_image(const std::string& path, const Location& from = {});
// The same for a file in memory, which errors call `name`; OpenEXR must be a file.
AnyImage decode_image(const std::string& name, std::string_view data, const Location& from = {});

// How the numbers of a coded image mean light. An exponent of 0 is the sRGB curve, 1 is linear, else a gamma.
float decode(float coded, float exponent);
float srgb_to_linear(float x);
// Three channels, without alpha. Images of floats are linear already, and stay as they are.
Image to_linear(const AnyImage& image, float exponent = 0);

// The layers of an OpenEXR file that have channels R, G and B; the main one has an empty name, and is linear Rec. 709,
// converted where the file names other chromaticities.
std::map<std::string, Image> read_exr(const std::string& path, const Location& from = {});
// Those of each part of a file, by name; the former reads the first part alone.
std::map<std::string, std::map<std::string, Image>> read_exr_parts(const std::string& path);

namespace detail {
ByteImage read_jpeg(const std::string& path, std::string_view data, const Location& from);
AnyImage read_png(const std::string& path, std::string_view data, const Location& from);
ByteImage read_tga(const std::string& path, std::string_view data, const Location& from);
Image read_hdr(const std::string& path, std::string_view data, const Location& from);
Image read_pfm(const std::string& path, std::string_view data, const Location& from);
[[noreturn]] void fail_image(const std::string& path, const Location& from, const std::string& reason);

// Why an image of this size must not be made from a file of so many bytes; nothing if it may. It is asked before memory
// is taken.
const char* size_fault(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_per_pixel, std::size_t file_size);
}  // namespace detail

}  // namespace bdpt_tool
