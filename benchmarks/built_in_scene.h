// A scene that needs no file: a Cornell box with a mirror sphere and a glass sphere.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene_description.h"

namespace bdpt_benchmark {

bdpt_tool::SceneDescription built_in_scene();

}  // namespace bdpt_benchmark
