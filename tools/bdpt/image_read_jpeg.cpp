// SPDX-License-Identifier: Apache-2.0

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <string_view>

// It needs <cstdio> before it.
#include <jpeglib.h>

#include "image.h"

namespace bdpt_tool::detail {
namespace {

struct ErrorManager {
  jpeg_error_mgr base;
  std::jmp_buf jump;
  char text[JMSG_LENGTH_MAX];
};

void on_error(j_common_ptr info) {
  auto* errors = reinterpret_cast<ErrorManager*>(info->err);
  info->err->format_message(info, errors->text);
  std::longjmp(errors->jump, 1);
}

void on_message(j_common_ptr) {}

// Everything the C library may jump out of; no object with a destructor lives here. False = failed, text says why.
bool decode(jpeg_decompress_struct& info, ErrorManager& errors, std::string_view data, ByteImage& image) {
  if (setjmp(errors.jump)) return false;
  jpeg_create_decompress(&info);
  jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(data.data()), data.size());
  jpeg_read_header(&info, TRUE);
  if (info.jpeg_color_space != JCS_GRAYSCALE) info.out_color_space = JCS_RGB;
  if (const char* fault = size_fault(info.image_width, info.image_height, 3, data.size())) {
    std::strncpy(errors.text, fault, sizeof errors.text - 1);
    return false;
  }
  jpeg_start_decompress(&info);
  image.width = info.output_width;
  image.height = info.output_height;
  image.channels = static_cast<std::uint32_t>(info.output_components);
  const std::size_t stride = std::size_t{image.width} * image.channels;
  image.pixels.resize(stride * image.height);
  while (info.output_scanline < info.output_height) {
    JSAMPROW row = image.pixels.data() + stride * info.output_scanline;
    jpeg_read_scanlines(&info, &row, 1);
  }
  jpeg_finish_decompress(&info);
  return true;
}

}  // namespace

ByteImage read_jpeg(const std::string& path, std::string_view data, const Location& from) {
  ByteImage image;
  jpeg_decompress_struct info{};
  ErrorManager errors{};
  info.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = on_error;
  errors.base.output_message = on_message;
  const bool decoded = decode(info, errors, data, image);
  jpeg_destroy_decompress(&info);
  if (!decoded) fail_image(path, from, errors.text);
  if (errors.base.num_warnings > 0) fail_image(path, from, "the file is damaged or cut off");
  return image;
}

}  // namespace bdpt_tool::detail
