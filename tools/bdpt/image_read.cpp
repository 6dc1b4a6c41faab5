// SPDX-License-Identifier: Apache-2.0
#include <string_view>

#include "file_data.h"
#include "image.h"

namespace bdpt_tool {

void detail::fail_image(const std::string& path, const Location& from, const std::string& reason) {
  throw Error(from, "cannot read the image '" + path + "': " + reason);
}

ByteImage read_byte_image(const std::string& path, const Location& from) {
  const FileData file(path, from);
  const std::string_view data = file.text();
  if (data.starts_with("\xFF\xD8\xFF")) return detail::read_jpeg(path, data, from);
  if (data.starts_with("\x89PNG")) return detail::read_png(path, data, from);
  detail::fail_image(path, from, "neither JPEG nor PNG; convert it to one of these");
}

}  // namespace bdpt_tool
