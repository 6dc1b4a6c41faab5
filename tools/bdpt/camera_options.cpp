// SPDX-License-Identifier: Apache-2.0
#include "camera_options.h"

#include "choice_option.h"

namespace bdpt_tool {

void add_camera_options(CLI::App& command, CameraOptions& options) {
  static const std::map<std::string, bdpt_camera_type> kTypes = {
      {"perspective", BDPT_CAMERA_PERSPECTIVE},         {"orthographic", BDPT_CAMERA_ORTHOGRAPHIC},
      {"equidistant", BDPT_CAMERA_EQUIDISTANT},         {"equisolid", BDPT_CAMERA_EQUISOLID},
      {"equirectangular", BDPT_CAMERA_EQUIRECTANGULAR}, {"cube", BDPT_CAMERA_CUBE},
  };
  add_choice(command, "--camera", options.type, kTypes,
             "Another camera at the place of the file's: perspective, orthographic, equidistant or equisolid "
             "(fisheyes), equirectangular, cube (width = 6 height, or height = 6 width)");
  command
      .add_option("--field-of-view", options.field_of_view,
                  "Degrees: vertical in perspective (default: the file's, or 45), across the circle of a fisheye (180)")
      ->check(positive());
  command.add_option("--field-height", options.field_height, "Height of an orthographic picture in world units")
      ->check(positive());
}

}  // namespace bdpt_tool
