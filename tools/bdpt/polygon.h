// Polygons into triangles.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace bdpt_tool {

// Cuts a polygon of three and more corners into triangles of its winding, by ears; it may be concave. `positions` are 3
// to a vertex, and corners point into them. Corners in a line, and such as cross each other, give triangles all the
// same, corners - 2 of them; the result is corners again.
void triangulate(const std::vector<float>& positions, const std::vector<std::uint32_t>& corners,
                 std::vector<std::uint32_t>& triangles);

}  // namespace bdpt_tool
