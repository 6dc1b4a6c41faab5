// What the library cannot render, and what it gets instead. All of that is here: what the library learns goes from here
// to scene_upload.cpp.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "notes.h"
#include "scene_description.h"

namespace bdpt_tool {

// A material of the library's types and within its bounds. `notes` hears of each thing that is lost.
MaterialDescription lowered(const SceneDescription& scene, const MaterialDescription& material, Notes& notes);

// One of the two materials of a mix, whose surface is the mix's own.
MaterialDescription lowered_part(const SceneDescription& scene, int material, Notes& notes);

// Warns of what will be lost of the materials of a scene.
void tell_what_is_lost(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace bdpt_tool
