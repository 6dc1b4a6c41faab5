// KHR_lights_punctual.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "error.h"
#include "gltf/document.h"
#include "notes.h"
#include "transform.h"

namespace bdpt_tool::gltf {

// Candela become W/sr and lux W/m², one to one. `place` names the light in errors and notes.
LightDescription placed_light(const Light& from, const Transform& to_world, const Location& where,
                              const std::string& place, Notes& notes);

}  // namespace bdpt_tool::gltf
