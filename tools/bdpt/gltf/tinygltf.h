// tinygltf without its file access and its image readers; gltf/document*.cpp alone know it.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

namespace bdpt_tool {
struct MaterialDescription;
}

namespace bdpt_tool::gltf {

inline const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

// document_material.cpp
MaterialDescription read_material(const tinygltf::Material& from);

}  // namespace bdpt_tool::gltf
