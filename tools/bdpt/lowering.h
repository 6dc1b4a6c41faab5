// What the library cannot render yet, and what it gets instead. All of that is here: what the library learns goes from
// here to scene_upload.cpp.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "notes.h"
#include "scene_description.h"

namespace bdpt_tool {

// A material of the library's types and fields alone: of `principled` it has a texture of roughness and nothing else.
// `notes` hears of each thing that is lost.
MaterialDescription lowered(const SceneDescription& scene, const MaterialDescription& material, Notes& notes);

// Whether the library has this light; if not, `notes` hears of it. An environment's texture becomes its mean.
bool lower(const SceneDescription& scene, LightDescription& light, Notes& notes);

// Warns of what will be lost of the materials and lights of a scene.
void tell_what_is_lost(const SceneDescription& scene, Diagnostics& diagnostics);

}  // namespace bdpt_tool
