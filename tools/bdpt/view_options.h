// The options --view and those of exposure, which several commands share.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "choice_option.h"
#include "film_output.h"

namespace bdpt_tool {

inline void add_view_options(CLI::App& command, ViewOptions& options) {
  static const std::map<std::string, bdpt_view> kViews = {{"srgb", BDPT_VIEW_SRGB}, {"aces", BDPT_VIEW_ACES}};
  add_choice(command, "--view", options.view, kViews, "Display transform of PNG files: srgb (default) or aces");
  command.add_option("--exposure", options.exposure, "Exposure of PNG files in stops (default 0)");
  command.add_option("--iso", options.iso, "Sensitivity, with --shutter and --f-number (default 100)")
      ->check(positive());
  command
      .add_option("--shutter", options.shutter,
                  "Exposure time in seconds: PNG files are exposed as a photograph, the scene's light being in lux and "
                  "candela; --exposure comes on top")
      ->check(positive());
  command.add_option("--f-number", options.f_number, "Of the exposure, as 8 for f/8")->check(positive());
  command.add_option("--ev100", options.ev100, "Exposure value at ISO 100, instead of those three");
}

}  // namespace bdpt_tool
