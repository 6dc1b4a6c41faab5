// Points in space to measure at: from a text file, or on a grid.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "handles.h"

namespace bdpt_tool {

// Numbers between commas, spaces or both. Throws std::invalid_argument with the text that is none, or not finite.
std::vector<double> parse_numbers(std::string_view text);

// A point a line: x y z, or x y z nx ny nz, alike in all lines. Empty lines, and what follows a #, are skipped, and so
// is a first line of names. An Error of kInput with the line.
std::vector<bdpt_point> read_points(const std::string& path);

// The centres of the cells of a box that is divided so, x the fastest.
std::vector<bdpt_point> grid_points(const std::array<std::uint32_t, 3>& cells, const std::array<double, 6>& box);

bool has_normal(const bdpt_point& point);

}  // namespace bdpt_tool
