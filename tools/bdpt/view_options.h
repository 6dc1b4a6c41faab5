// The options --view and --exposure, which several commands share.
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
}

}  // namespace bdpt_tool
