// What this program demands of the properties it reads.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfloat>
#include <cstddef>
#include <span>

namespace bdpt_tool::gltf {

enum class Kind { kObject, kArray, kText, kTexts, kBoolean, kInteger, kNumber, kNumbers, kIndex, kIndices };

struct Rule {
  const char* path;  // "nodes[].mesh": in each element of the array; "attributes.*": each member
  Kind kind;
  bool required = false;                  // if what it is a property of is there
  const char* of = "";                    // kIndex, kIndices: the array that is pointed into
  std::size_t count = 0;                  // kNumbers: how many; 0 = any
  double low = -FLT_MAX, high = FLT_MAX;  // kInteger, kNumber, kNumbers
};

// Of what says whether the rest can be understood, and of the rest.
extern const std::span<const Rule> kHeaderRules, kRules;

// The uses of textures, and what must be below each.
extern const std::span<const char* const> kTextureInfos;
extern const std::span<const Rule> kTextureInfoRules;

}  // namespace bdpt_tool::gltf
