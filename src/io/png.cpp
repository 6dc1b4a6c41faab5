#include "io/png.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <exception>
#include <new>
#include <vector>

#include "base/error.h"
#include "io/atomic_file.h"

namespace bdpt {
namespace {

struct PngSink {
  AtomicFile* file;
  std::exception_ptr error;  // of the file; no exception may cross libpng
  std::string* message;      // of libpng
};

void on_write(png_structp png, png_bytep data, size_t size) {
  PngSink* sink = static_cast<PngSink*>(png_get_io_ptr(png));
  bool failed = false;
  try {
    sink->file->write(data, size);
  } catch (...) {
    sink->error = std::current_exception();
    failed = true;
  }
  if (failed) png_error(png, "write");  // jumps, outside of the handler
}

void on_flush(png_structp) {}

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
  PngSink* sink = static_cast<PngSink*>(png_get_error_ptr(png));
  try {
    sink->message->assign(text);
  } catch (...) {
  }
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

// All that libpng may jump out of. Nothing with a destructor lives here, and nothing that changes after setjmp is
// read after the jump.
bool write_rows(png_structp png, png_infop info, PngSink* sink, const float* pixels, uint32_t width, uint32_t height,
                png_bytep row) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, sink, on_write, on_flush);
  png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const size_t row_size = size_t{3} * width;
  for (uint32_t y = 0; y < height; ++y) {
    const float* source = pixels + y * row_size;
    for (size_t i = 0; i < row_size; ++i)
      row[i] = static_cast<png_byte>(std::lround(std::clamp(source[i], 0.0f, 1.0f) * 255.0f));
    png_write_row(png, row);
  }
  png_write_end(png, info);
  return true;
}

struct PngWriter {
  png_structp png = nullptr;
  png_infop info = nullptr;
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

}  // namespace

void write_png(const std::string& path, const float* pixels, uint32_t width, uint32_t height) {
  if (width < 1 || height < 1 || width > PNG_USER_WIDTH_MAX || height > PNG_USER_HEIGHT_MAX)
    fail(ErrorCode::InvalidArgument, "an image of ", width, " x ", height, " pixels cannot be written as PNG");
  if (!pixels) fail(ErrorCode::InvalidArgument, "the image has no pixels");
  for (size_t i = 0, n = size_t{3} * width * height; i < n; ++i)
    if (std::isnan(pixels[i]))
      fail(ErrorCode::InvalidArgument, "pixel (", i / 3 % width, ", ", i / 3 / width, ") is not a number");

  AtomicFile file(path);
  std::string message;
  PngSink sink{&file, nullptr, &message};
  std::vector<png_byte> row(size_t{3} * width);
  PngWriter writer;
  writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, on_error, on_warning);
  if (!writer.png) throw std::bad_alloc();
  writer.info = png_create_info_struct(writer.png);
  if (!writer.info) throw std::bad_alloc();
  if (!write_rows(writer.png, writer.info, &sink, pixels, width, height, row.data())) {
    if (sink.error) std::rethrow_exception(sink.error);
    fail(ErrorCode::Io, "cannot write '", path, "': ", message);
  }
  file.commit();
}

}  // namespace bdpt
