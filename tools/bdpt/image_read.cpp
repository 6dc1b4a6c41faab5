// SPDX-License-Identifier: Apache-2.0
#include <string_view>

#include "file_data.h"
#include "image.h"

namespace bdpt_tool {

void detail::fail_image(const std::string& path, const Location& from, const std::string& reason) {
  throw Error(from, "cannot read the image '" + path + "': " + reason);
}

ByteImage decode_byte_image(const std::string& name, std::string_view data, const Location& from) {
  if (data.starts_with("\xFF\xD8\xFF")) return detail::read_jpeg(name, data, from);
  if (data.starts_with("\x89PNG")) return detail::read_png(name, data, from);
  detail::fail_image(name, from, "neither JPEG nor PNG; convert it to one of these");
}

ByteImage read_byte_image(const std::string& path, const Location& from) {
  return decode_byte_image(path, FileData(path, from).text(), from);
}

}  // namespace bdpt_tool
