// Mattes by name, after the Cryptomatte specification (Friedman and Jones, 2015, version 1.2): in each pixel the hashes
// of names and the parts of the pixel that they cover.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bdpt.h"

namespace bdpt_tool {

// MurmurHash3 (Appleby), its variant x86_32, seed 0.
std::uint32_t murmur3(std::string_view text);

// The hash of a name such that its bits are a normal float.
std::uint32_t matte_hash(std::string_view name);

struct Matte {
  static constexpr std::size_t kRanks = 6;
  std::vector<float> ranks;  // kRanks pairs of hash and part for each pixel, largest parts first
  double left_out = 0;       // part of all samples that no rank has
  std::map<std::string, std::string> attributes;
};

// Of `entries`, so many for each pixel; ids of one name count together. `layer` names the channels: layer00.R ...
Matte make_matte(const std::string& layer, const std::vector<bdpt_coverage>& entries, std::size_t per_pixel,
                 const std::map<std::uint64_t, std::string>& names);

}  // namespace bdpt_tool
