// Which techniques (s,t) a render may use, from a text on the command line.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace bdpt_tool {

// Bit t of element s; 31 stands for 31 and more, as in bdpt_render_desc.
using TechniqueMask = std::array<std::uint32_t, 32>;

// The syntax, as --help prints it.
extern const char kTechniqueMaskHelp[];

// Throws an Error for what is not in the syntax, and for a mask that allows nothing.
TechniqueMask parse_technique_mask(std::string_view text);

bool allows(const TechniqueMask& mask, std::uint32_t s, std::uint32_t t);

}  // namespace bdpt_tool
