// IES files: what a luminaire sends into each direction, after IESNA LM-63 (1986 to 2002), photometry of type C.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace bdpt_tool {

// As bdpt_photometry takes it.
struct Luminaire {
  std::vector<float> vertical_angles;    // from straight down
  std::vector<float> horizontal_angles;  // 0 alone, or from 0 to 90, 180 or 360
  std::vector<float> candela;            // all vertical angles of the first horizontal one, then of the next
};

// Throws Error with the line of what cannot be read. name: for messages.
Luminaire parse_ies(const std::string& text, const std::string& name);
Luminaire read_ies(const std::string& path);

}  // namespace bdpt_tool
