// A number for all that decides the picture: films of scenes that differ do not merge.
#pragma once

#include "scene/scene_desc.h"

namespace bdpt {

uint64_t hash_scene(const SceneDesc& desc);

}  // namespace bdpt
