// Reads scene files, of whatever format.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene_description.h"

namespace CLI {
class App;
}

namespace bdpt_tool {

struct ReadOptions {
  std::string scene;        // of a glTF file that has several: its name or its number; empty = the file's default
  std::string folder;       // which the file's paths must not leave; empty = the file's own
  std::string environment;  // a picture instead of the file's environments, or of the default one
};

// The options --scene, --folder and --environment.
void add_read_options(CLI::App& command, ReadOptions& options);

// pbrt-v4, glTF 2.0, OBJ or PLY, as the name ends. Throws an Error where the file is damaged or the picture would be
// wrong, and warns of all that is left out or only come near to.
SceneDescription read_scene(const std::string& path, Diagnostics& diagnostics, const ReadOptions& options = {});

}  // namespace bdpt_tool
