// The files that a scene may name.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "error.h"

namespace bdpt_tool {

// A scene from elsewhere must not read what it was not given: every file it names lies in one folder, by whatever
// links.
class SceneFolder {
 public:
  // `limit` is the folder; empty = that of the scene's file.
  explicit SceneFolder(const std::string& scene_path, const std::string& limit = {});

  // The path of a file that is named at `from`, relative to the scene's folder. Throws an Error if it lies outside.
  std::string path_of(const std::string& name, const Location& from) const;

 private:
  std::string folder_, limit_;
};

}  // namespace bdpt_tool
