// RGB stand-ins for the measured spectra that the pbrt format knows by name.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "scene_description.h"

namespace bdpt_tool {

// "metal-Cu-eta", "metal-Au-k" and so on: Ag, Al, Au, Cu.
std::optional<Rgb> named_metal(const std::string& name);

// "glass-BK7" and so on: the index at 587.6 nm.
std::optional<float> named_glass(const std::string& name);

}  // namespace bdpt_tool
