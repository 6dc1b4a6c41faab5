// SPDX-License-Identifier: Apache-2.0
#include "output_path.h"

#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "error.h"

namespace bdpt_tool {
namespace {

namespace fs = std::filesystem;

void require_writable(const std::string& option, const fs::path& folder) {
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ExitCode::kOutput,
                option + ": the folder '" + folder.string() + "' cannot be written to; choose another");
  }
}

}  // namespace

void require_writable_file(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw Error(ExitCode::kOutput, option + ": there is no folder '" + folder.string() + "'; make it first");
  }
  require_writable(option, folder);
  if (fs::is_directory(path, ignored)) {
    throw Error(ExitCode::kOutput, option + ": '" + path + "' is a folder; give a file name");
  }
}

void require_writable_folder(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  std::error_code error;
  fs::create_directories(path, error);
  if (!fs::is_directory(path, error)) {
    throw Error(ExitCode::kOutput, option + ": cannot make the folder '" + path + "'; choose another");
  }
  require_writable(option, path);
}

void require_extension(const std::string& option, const std::string& path, const std::string& extension) {
  if (path.empty() || fs::path(path).extension() == extension) return;
  throw Error(ExitCode::kUsage, option + ": '" + path + "' must end in " + extension);
}

}  // namespace bdpt_tool
