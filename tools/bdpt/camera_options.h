// The options by which the command line replaces the file's camera, where it stands.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bdpt.h"

namespace CLI {
class App;
}

namespace bdpt_tool {

// What is not given is empty: the scene file decides, or a default.
struct CameraOptions {
  std::optional<bdpt_camera_type> type;
  std::optional<float> field_of_view, field_height;
};

void add_camera_options(CLI::App& command, CameraOptions& options);

}  // namespace bdpt_tool
