// SPDX-License-Identifier: Apache-2.0
#include "whole_file.h"

#include <unistd.h>

#include <filesystem>

#include "error.h"

namespace bdpt_tool {

void write_whole_file(const std::string& path, const std::function<void(std::ofstream&)>& write) {
  const std::string temporary = path + "." + std::to_string(getpid()) + ".part";
  const auto remove = [&] {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
  };
  try {
    std::ofstream out(temporary, std::ios::binary);
    write(out);
    out.close();
    if (!out) throw std::runtime_error("the disk may be full, or the folder closed to writing");
    std::filesystem::rename(temporary, path);
  } catch (const Error&) {
    remove();
    throw;
  } catch (const std::exception& error) {
    remove();
    throw Error(ExitCode::kOutput, "cannot write '" + path + "': " + error.what());
  }
}

}  // namespace bdpt_tool
