// Checks the JSON of a glTF file before anything is made of it: types, ranges, and that every index points at
// something.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gltf/container.h"
#include "scene_folder.h"

namespace bdpt_tool::gltf {

struct ExternalBuffer {
  std::string path;
  std::size_t length = 0;
};

// Throws an Error that names the property, such as nodes[3].mesh, and says what it must be. Returns the buffers in
// files of their own, in the order of the document.
std::vector<ExternalBuffer> check_document(const std::string& path, const SceneFolder& folder,
                                           const Container& container);

// What a relative URI means.
std::string percent_decoded(const std::string& uri);

}  // namespace bdpt_tool::gltf
