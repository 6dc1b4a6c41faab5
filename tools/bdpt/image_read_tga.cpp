// Truevision TGA: colours and greys of 8 bits to a channel, plain or run-length encoded.
//
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "image.h"

namespace bdpt_tool::detail {
namespace {

constexpr std::size_t kHeaderSize = 18;
constexpr unsigned kColour = 2, kGrey = 3, kRunLength = 8;
constexpr unsigned kFromRight = 0x10, kFromTop = 0x20;

class Tga {
 public:
  Tga(const std::string& path, std::string_view data, const Location& from) : path_(path), data_(data), from_(from) {}

  ByteImage read() {
    if (data_.size() < kHeaderSize) fail("it is cut off");
    const unsigned kind = byte(2), bits = byte(16), flags = byte(17);
    const unsigned plain = kind & ~kRunLength;
    if (byte(1) != 0 || (plain != kColour && plain != kGrey)) fail("TGA with a palette is not read; save it as PNG");
    if ((plain == kGrey && bits != 8) || (plain == kColour && bits != 24 && bits != 32)) {
      fail("TGA of " + std::to_string(bits) + " bits is not read; save it as PNG");
    }
    if (flags & kFromRight) fail("TGA with columns from right to left is not read; save it as PNG");
    image_.width = byte(12) | byte(13) << 8;
    image_.height = byte(14) | byte(15) << 8;
    image_.channels = bits / 8;
    if (const char* fault = size_fault(image_.width, image_.height, image_.channels, data_.size())) fail(fault);
    image_.pixels.resize(std::size_t{image_.width} * image_.height * image_.channels);
    at_ = kHeaderSize + byte(0);
    kind& kRunLength ? read_runs() : read_plain();
    if (!(flags & kFromTop)) turn_over();
    return std::move(image_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { fail_image(path_, from_, reason); }
  unsigned byte(std::size_t at) const { return static_cast<unsigned char>(data_[at]); }

  // Blue comes first in the file.
  void read_pixel(std::uint8_t* to) {
    if (data_.size() < at_ + image_.channels) fail("it is cut off");
    std::copy_n(data_.data() + at_, image_.channels, to);
    at_ += image_.channels;
    if (image_.channels > 1) std::swap(to[0], to[2]);
  }

  void read_plain() {
    for (std::size_t i = 0; i < image_.pixels.size(); i += image_.channels) read_pixel(&image_.pixels[i]);
  }

  void read_runs() {
    for (std::size_t i = 0; i < image_.pixels.size();) {
      if (at_ >= data_.size()) fail("it is cut off");
      const unsigned head = byte(at_++);
      const std::size_t count = (head & 127) + 1;
      if (count * image_.channels > image_.pixels.size() - i) fail("a run goes past its end; it is damaged");
      std::array<std::uint8_t, 4> pixel = {};
      for (std::size_t k = 0; k < count; ++k, i += image_.channels) {
        if (k == 0 || !(head & 128)) read_pixel(pixel.data());
        std::copy_n(pixel.data(), image_.channels, &image_.pixels[i]);
      }
    }
  }

  void turn_over() {
    const std::size_t row = std::size_t{image_.width} * image_.channels;
    for (std::size_t top = 0, bottom = image_.height - 1; top < bottom; ++top, --bottom) {
      std::swap_ranges(image_.pixels.begin() + static_cast<std::ptrdiff_t>(top * row),
                       image_.pixels.begin() + static_cast<std::ptrdiff_t>((top + 1) * row),
                       image_.pixels.begin() + static_cast<std::ptrdiff_t>(bottom * row));
    }
  }

  const std::string& path_;
  std::string_view data_;
  const Location& from_;
  std::size_t at_ = 0;
  ByteImage image_;
};

}  // namespace

ByteImage read_tga(const std::string& path, std::string_view data, const Location& from) {
  return Tga(path, data, from).read();
}

}  // namespace bdpt_tool::detail
