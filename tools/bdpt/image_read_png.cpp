// SPDX-License-Identifier: Apache-2.0
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <string_view>

#include "image.h"

namespace bdpt_tool::detail {
namespace {

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

// The file's own values as grey, RGB or RGBA; no gamma is applied.
void set_conversions(png_structp png) {
  png_set_expand(png);
  if (std::endian::native == std::endian::little) png_set_swap(png);
}

// Everything the C library may jump out of; no object with a destructor lives here. False = failed.
bool read_size(png_structp png, png_infop info, std::size_t file_size) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_user_limits(png, 65536, 65536);
  png_read_info(png, info);
  // As the file has them: palettes and single bits grow when they are read.
  const std::size_t bits = std::size_t{png_get_channels(png, info)} * png_get_bit_depth(png, info);
  const std::uint64_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
  if (const char* fault = size_fault(width, height, 1, file_size * 8 / bits + 1)) png_error(png, fault);
  set_conversions(png);
  if (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY_ALPHA ||
      (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY && png_get_valid(png, info, PNG_INFO_tRNS))) {
    png_set_gray_to_rgb(png);
  }
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  return true;
}

bool read_rows(png_structp png, int rounds, std::size_t stride, std::uint32_t height, png_bytep pixels) {
  if (setjmp(png_jmpbuf(png))) return false;
  for (int round = 0; round < rounds; ++round) {
    for (std::uint32_t y = 0; y < height; ++y) png_read_row(png, pixels + stride * y, nullptr);
  }
  png_read_end(png, nullptr);
  return true;
}

template <class T>
bool decode(png_structp png, png_infop info, CodedImage<T>& image) {
  image.width = png_get_image_width(png, info);
  image.height = png_get_image_height(png, info);
  image.channels = png_get_channels(png, info);
  image.pixels.resize(std::size_t{image.width} * image.height * image.channels);
  const int rounds = png_get_interlace_type(png, info) == PNG_INTERLACE_NONE ? 1 : PNG_INTERLACE_ADAM7_PASSES;
  return read_rows(png, rounds, png_get_rowbytes(png, info), image.height,
                   reinterpret_cast<png_bytep>(image.pixels.data()));
}

}  // namespace

AnyImage read_png(const std::string& path, std::string_view data, const Location& from) {
  Source source{data};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    throw Error(ExitCode::kFailure, "out of memory");
  }
  png_set_read_fn(png, &source, on_read);
  ByteImage bytes;
  WordImage words;
  bool decoded = read_size(png, info, data.size());
  const bool wide = decoded && png_get_bit_depth(png, info) == 16;
  if (decoded) decoded = wide ? decode(png, info, words) : decode(png, info, bytes);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!decoded) fail_image(path, from, source.text);
  if (wide) return words;
  return bytes;
}

}  // namespace bdpt_tool::detail
