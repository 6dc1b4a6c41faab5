// SPDX-License-Identifier: Apache-2.0
#include <string_view>

#include "file_data.h"
#include "image.h"

namespace bdpt_tool {
namespace {

constexpr std::uint64_t kMaxSide = 65536, kMaxPixels = std::uint64_t{1} << 28;
// Deflate, the densest of the codes that the formats have in common, makes at most 1032 bytes of one.
constexpr std::uint64_t kMaxRatio = 1100, kSmall = 1 << 16;

bool is_exr(std::string_view data) { return data.starts_with("\x76\x2F\x31\x01"); }

}  // namespace

void detail::fail_image(const std::string& path, const Location& from, const std::string& reason) {
  throw Error(from, "cannot read the image '" + path + "': " + reason);
}

const char* detail::size_fault(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_per_pixel,
                               std::size_t file_size) {
  if (width == 0 || height == 0) return "it has no pixels";
  if (width > kMaxSide || height > kMaxSide) return "larger than 65536 pixels";
  if (width * height > kMaxPixels) return "more than 2^28 pixels";
  if (width * height * bytes_per_pixel > kMaxRatio * file_size + kSmall) {
    return "its header tells of more pixels than the file can hold; it is damaged or cut off";
  }
  return nullptr;
}

AnyImage decode_image(const std::string& name, std::string_view data, const Location& from) {
  if (data.starts_with("\xFF\xD8\xFF")) return detail::read_jpeg(name, data, from);
  if (data.starts_with("\x89PNG")) return detail::read_png(name, data, from);
  if (data.starts_with("#?")) return detail::read_hdr(name, data, from);
  if (data.starts_with("PF\n") || data.starts_with("Pf\n")) return detail::read_pfm(name, data, from);
  if (name.ends_with(".tga") || name.ends_with(".TGA")) return detail::read_tga(name, data, from);
  if (data.starts_with("\xABKTX")) detail::fail_image(name, from, "KTX is not read here; convert it to PNG or JPEG");
  detail::fail_image(name, from, "neither JPEG, PNG, HDR, PFM, OpenEXR nor TGA; convert it to one of these");
}

AnyImage read_image(const std::string& path, const Location& from) {
  const FileData file(path, from);
  if (!is_exr(file.text())) return decode_image(path, file.text(), from);
  auto layers = read_exr(path, from);
  if (!layers.contains("")) detail::fail_image(path, from, "no channels R, G and B");
  return std::move(layers.at(""));
}

}  // namespace bdpt_tool
