// How many texels charts keep between them.
#pragma once

#include "lightmap/claims.h"

#include <optional>

namespace bdpt {

// The least number of free texels between two charts, counted along rows, columns or diagonals, whichever way is
// shortest: 0 where they touch or share a texel. None if no two charts are as near as `reach`.
std::optional<uint32_t> smallest_padding(const Claims& claims, const Atlas& atlas, uint32_t reach);

}  // namespace bdpt
