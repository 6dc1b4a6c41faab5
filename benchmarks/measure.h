// Measures one scene with every integrator.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "error.h"
#include "options.h"
#include "results.h"
#include "scene_set.h"

namespace bdpt_benchmark {

// Prints what it is doing to stderr.
SceneResult measure_scene(const SceneFile& file, const Options& options, bdpt_tool::Diagnostics& diagnostics);

}  // namespace bdpt_benchmark
