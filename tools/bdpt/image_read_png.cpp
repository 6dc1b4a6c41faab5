// SPDX-License-Identifier: Apache-2.0
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <string_view>

#include "image.h"

namespace bdpt_tool::detail {
namespace {

constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 28;

struct Source {
  std::string_view rest;
  char text[128] = "damaged";
};

void on_error(png_structp png, png_const_charp text) {
  auto* source = static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source->text, text, sizeof source->text - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep bytes, png_size_t count) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (source->rest.size() < count) png_error(png, "the file is cut off");
  std::memcpy(bytes, source->rest.data(), count);
  source->rest.remove_prefix(count);
}

// The file's own values as 8-bit grey or RGB; no gamma is applied.
void set_conversions(png_structp png) {
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_strip_alpha(png);
}

// Everything the C library may jump out of; no object with a destructor lives here. False = failed.
bool decode(png_structp png, png_infop info, ByteImage& image) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_user_limits(png, 65536, 65536);
  png_read_info(png, info);
  if (std::uint64_t{png_get_image_width(png, info)} * png_get_image_height(png, info) > kMaxPixels) {
    png_error(png, "more than 2^28 pixels");
  }
  set_conversions(png);
  const int rounds = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  image.width = png_get_image_width(png, info);
  image.height = png_get_image_height(png, info);
  image.channels = png_get_channels(png, info);
  const std::size_t stride = png_get_rowbytes(png, info);
  image.pixels.resize(stride * image.height);
  for (int round = 0; round < rounds; ++round) {
    for (std::uint32_t y = 0; y < image.height; ++y) png_read_row(png, image.pixels.data() + stride * y, nullptr);
  }
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

ByteImage read_png(const std::string& path, const std::string_view& data, const Location& from) {
  Source source{data};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    throw Error(ExitCode::kFailure, "out of memory");
  }
  png_set_read_fn(png, &source, on_read);
  ByteImage image;
  const bool decoded = decode(png, info, image);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!decoded) fail_image(path, from, source.text);
  return image;
}

}  // namespace bdpt_tool::detail
