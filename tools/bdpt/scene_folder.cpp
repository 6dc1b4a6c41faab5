// SPDX-License-Identifier: Apache-2.0
#include "scene_folder.h"

#include <algorithm>
#include <filesystem>

namespace bdpt_tool {
namespace fs = std::filesystem;

SceneFolder::SceneFolder(const std::string& scene_path, const std::string& limit)
    : folder_(fs::path(scene_path).parent_path().string()), limit_(limit.empty() ? folder_ : limit) {
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(limit_.empty() ? "." : limit_, ignored);
  if (!whole.empty()) limit_ = whole.string();
}

std::string SceneFolder::path_of(const std::string& name, const Location& from) const {
  if (name.empty() || name.find('\0') != std::string::npos) throw Error(from, "the name of a file is empty or damaged");
  const fs::path path = fs::path(folder_) / name;
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(path, error);
  if (error) throw Error(from, "cannot read '" + path.string() + "': " + error.message() + "; check the file name");
  const fs::path limit(limit_);
  if (std::mismatch(limit.begin(), limit.end(), whole.begin(), whole.end()).first != limit.end()) {
    throw Error(from, "'" + name + "' lies outside of the scene's folder, '" + limit_ +
                          "'; move it there, or name a folder that holds both by --folder");
  }
  return path.string();
}

}  // namespace bdpt_tool
