// Radiance pictures, RGBE, plain or run-length encoded. Source: Ward, "Real Pixels", Graphics Gems II; the format's
// description in Radiance's own manual.
//
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "image.h"

namespace bdpt_tool::detail {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

class Hdr {
 public:
  Hdr(const std::string& path, std::string_view data, const Location& from) : path_(path), data_(data), from_(from) {}

  Image read() {
    read_header();
    // A run of 127 equal bytes takes 2.
    if (const char* fault = size_fault(image_.width, image_.height, 12, data_.size())) fail(fault);
    image_.pixels.resize(std::size_t{3} * image_.width * image_.height);
    std::vector<Rgbe> row(image_.width);
    for (std::uint32_t y = 0; y < image_.height; ++y) {
      read_row(row);
      store(row, from_bottom_ ? image_.height - 1 - y : y);
    }
    return std::move(image_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { fail_image(path_, from_, reason); }

  std::string_view line() {
    const std::size_t end = data_.find('\n', at_);
    if (end == std::string_view::npos) fail("its header does not end");
    const std::string_view text = data_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }

  std::uint32_t number(std::string_view& text) const {
    std::uint32_t value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc()) fail("its line of the size is damaged");
    text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()));
    return value;
  }

  void read_header() {
    for (std::string_view text = line(); !text.empty(); text = line()) {
      if (text.starts_with("FORMAT=") && text.substr(0, 22) != "FORMAT=32-bit_rle_rgbe") {
        fail("it is of the format '" + std::string(text.substr(7)) + "'; only 32-bit_rle_rgbe is read");
      }
      if (text.starts_with("EXPOSURE=")) {
        double exposure = 1;
        std::from_chars(text.data() + 9, text.data() + text.size(), exposure);
        if (exposure > 0 && std::isfinite(exposure)) gain_ /= static_cast<float>(exposure);
      }
    }
    std::string_view size = line();
    from_bottom_ = size.starts_with("+Y ");
    if (!from_bottom_ && !size.starts_with("-Y ")) fail("only pictures of rows are read, '-Y height +X width'");
    size.remove_prefix(3);
    image_.height = number(size);
    if (!size.starts_with(" +X ")) fail("only pictures with rows from left to right are read");
    size.remove_prefix(4);
    image_.width = number(size);
  }

  std::uint8_t byte() {
    if (at_ >= data_.size()) fail("it is cut off");
    return static_cast<std::uint8_t>(data_[at_++]);
  }

  // Rows of runs begin with 2, 2 and their width; in others a pixel 1, 1, 1, n repeats the one before n times.
  void read_row(std::vector<Rgbe>& row) {
    const std::size_t width = row.size();
    if (width >= 8 && width < 32768 && data_.size() - at_ >= 4 && data_[at_] == 2 && data_[at_ + 1] == 2 &&
        !(data_[at_ + 2] & 0x80)) {
      at_ += 2;
      if ((std::size_t{byte()} << 8 | byte()) != width) fail("a row has another width than the picture; it is damaged");
      for (std::size_t c = 0; c < 4; ++c) read_runs(row, c);
      return;
    }
    unsigned shift = 0;
    for (std::size_t x = 0; x < width;) {
      Rgbe pixel;
      for (std::uint8_t& part : pixel) part = byte();
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        row[x++] = pixel;
        shift = 0;
        continue;
      }
      const std::size_t count = shift < 32 ? std::size_t{pixel[3]} << shift : 0;
      if (x == 0 || count > width - x || shift >= 32) fail("a run goes past its row; it is damaged");
      for (std::size_t k = 0; k < count; ++k, ++x) row[x] = row[x - 1];
      shift += 8;
    }
  }

  void read_runs(std::vector<Rgbe>& row, std::size_t channel) {
    for (std::size_t x = 0; x < row.size();) {
      const unsigned head = byte();
      const std::size_t count = head > 128 ? head - 128 : head;
      if (count == 0 || count > row.size() - x) fail("a run goes past its row; it is damaged");
      std::uint8_t value = 0;
      for (std::size_t k = 0; k < count; ++k, ++x) {
        if (k == 0 || head <= 128) value = byte();
        row[x][channel] = value;
      }
    }
  }

  void store(const std::vector<Rgbe>& row, std::uint32_t y) {
    float* to = image_.pixels.data() + std::size_t{3} * image_.width * y;
    for (const Rgbe& pixel : row) {
      const float scale = pixel[3] == 0 ? 0 : gain_ * std::ldexp(1.0f, int{pixel[3]} - 136);
      for (std::size_t c = 0; c < 3; ++c) *to++ = pixel[3] == 0 ? 0 : (static_cast<float>(pixel[c]) + 0.5f) * scale;
    }
  }

  const std::string& path_;
  std::string_view data_;
  const Location& from_;
  std::size_t at_ = 0;
  bool from_bottom_ = false;
  float gain_ = 1;
  Image image_;
};

}  // namespace

Image read_hdr(const std::string& path, std::string_view data, const Location& from) {
  return Hdr(path, data, from).read();
}

}  // namespace bdpt_tool::detail
