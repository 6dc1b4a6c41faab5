// The options that say how pictures are shown, and in which colours they are made; several commands share them.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "choice_option.h"
#include "film_output.h"

namespace bdpt_tool {

// The exposure of PNG files.
inline void add_exposure_options(CLI::App& command, ViewOptions& options) {
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

inline void add_view_options(CLI::App& command, ViewOptions& options) {
  static const std::map<std::string, bdpt_view> kViews = {{"srgb", BDPT_VIEW_SRGB}, {"aces", BDPT_VIEW_ACES}};
  add_choice(command, "--view", options.view, kViews, "Display transform of PNG files: srgb (default) or aces");
  add_exposure_options(command, options);
}

// With the views of a configuration, and its spaces.
inline void add_color_options(CLI::App& command, ColorOptions& color, ViewOptions& view) {
  command.add_option("--config", color.config, "An OpenColorIO configuration; the variable OCIO is not read")
      ->type_name("FILE");
  command
      .add_option("--working-space", color.working_space,
                  "The linear space of the computation and of OpenEXR files (default: linear Rec. 709): acescg, "
                  "lin_rec2020, lin_p3d65, lin_ap0, or one of --config. A film is in the space that it was rendered in")
      ->type_name("NAME");
  command
      .add_option_function<std::string>(
          "--view",
          [&view](const std::string& name) {
            view.is_named = true;
            view.view = name == "srgb" ? BDPT_VIEW_SRGB : name == "aces" ? BDPT_VIEW_ACES : BDPT_VIEW_OCIO;
            if (view.view == BDPT_VIEW_OCIO) view.ocio_view = name;
          },
          "Display transform of PNG files: srgb (default), aces, or a view of --config")
      ->type_name("NAME");
  command.add_option("--display", view.display, "A display of --config, shown by --view, or by its own default view")
      ->type_name("NAME");
  add_exposure_options(command, view);
}

// What the options say together, once they are all read.
inline void check_color_options(const ColorOptions& color, ViewOptions& view) {
  if (!view.display.empty() && !view.is_named) view.view = BDPT_VIEW_OCIO;
  if (view.view == BDPT_VIEW_OCIO && color.config.empty()) {
    if (!view.display.empty()) throw Error(ExitCode::kUsage, "--display needs --config, whose display it names");
    throw Error(ExitCode::kUsage, "--view: '" + view.ocio_view +
                                      "' is not known; choose one of: aces, srgb, or give the --config that has it");
  }
  if (view.view != BDPT_VIEW_OCIO && !view.display.empty()) {
    throw Error(ExitCode::kUsage, "--display goes with a --view of the configuration; srgb and aces are none");
  }
}

}  // namespace bdpt_tool
