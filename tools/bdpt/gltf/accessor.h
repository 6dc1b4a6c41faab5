// The numbers of an accessor.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "error.h"
#include "gltf/document.h"

namespace bdpt_tool::gltf {

// As floats, integers scaled to [0,1] or [-1,1] where they are normalised. Throws an Error that begins with `what` if
// there are other than `components` to an element, or one is not finite.
std::vector<float> read_floats(const Accessor& accessor, int components, const Location& where,
                               const std::string& what);

// Throws an Error if they are no unsigned integers.
std::vector<std::uint32_t> read_indices(const Accessor& accessor, const Location& where, const std::string& what);

}  // namespace bdpt_tool::gltf
