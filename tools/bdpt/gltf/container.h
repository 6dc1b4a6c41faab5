// The outside of a glTF file: JSON text, or a GLB of chunks.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace bdpt_tool::gltf {

struct Container {
  std::string_view json;
  bool is_glb = false;
  bool has_binary = false;  // a GLB with a chunk of binary data
};

// The same file with another JSON.
std::string with_json(std::string_view data, const Container& container, std::string json);

// Throws an Error if the data is a damaged GLB, or none though the file is named so.
Container open_container(const std::string& path, std::string_view data);

}  // namespace bdpt_tool::gltf
