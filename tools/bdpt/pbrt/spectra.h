// Spectra in RGB: measured ones that the pbrt format knows by name, samples, and black bodies.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene_description.h"

namespace bdpt_tool {

// "metal-Cu-eta", "metal-Au-k" and so on: Ag, Al, Au, Cu.
std::optional<Rgb> named_metal(const std::string& name);

// "glass-BK7" and so on: the index at 587.6 nm.
std::optional<float> named_glass(const std::string& name);

// "stdillum-D65" is white; "stdillum-A" is the black body of 2856 K.
std::optional<Rgb> named_illuminant(const std::string& name);

// Pairs of a wavelength in nanometres, ascending, and a value; constant before the first and after the last.
using Samples = std::vector<double>;
bool are_samples(const Samples& samples);

// What a surface reflects of D65, or a mean by the same weights; no channel below 0.
Rgb reflected(const Samples& samples);
// The colour of light, of luminance 1; channels that the primaries cannot show are 0.
Rgb emitted(const Samples& samples);
Rgb black_body(double kelvin);

}  // namespace bdpt_tool
