// Which instances of a scene are baked, and in which atlas.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "handles.h"
#include "scene_description.h"

namespace bdpt_tool {

// The instances that share texture coordinates: the parts of one node of a scene file.
struct Atlas {
  std::string name;                    // no two have one name
  std::string file_name;               // the same, as a part of the name of a file
  std::vector<std::size_t> instances;  // of the description
};

// One for each node whose meshes have the set of texture coordinates (0 or 1); of these, those named, or all. Throws an
// Error of kUsage for a name that is none, and of kInput where nothing can be baked.
std::vector<Atlas> atlases_of(const SceneDescription& description, int uv_set, const std::vector<std::string>& names);

// What the library takes for them; the description's instances know their ids.
std::vector<bdpt_lightmap_instance> lightmap_instances(const SceneDescription& description,
                                                       const std::vector<Atlas>& atlases, int uv_set);

}  // namespace bdpt_tool
