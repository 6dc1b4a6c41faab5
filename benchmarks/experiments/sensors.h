// A sensor on a surface: the library has cameras alone, but takes any that keeps to its interface (sensor/sensor.h).
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "stage.h"

namespace bdpt_experiments {

// Replaces the stage's camera by a lightmap of the floor [-1, 1] x [-1, 1] at y = 0. A texel measures its mean
// radiosity over pi: the radiance of a diffuse white floor. Light subpaths can hit it (t = 0).
void measure_floor(Stage& stage, std::uint32_t texels);

}  // namespace bdpt_experiments
