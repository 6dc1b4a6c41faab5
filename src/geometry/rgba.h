// Four channels, as textures and vertices have them.
#pragma once

#include "math/vec.h"

#include <array>

namespace bdpt {

using Rgba = std::array<float, 4>;
inline Rgb to_rgb(const Rgba& v) { return {v[0], v[1], v[2]}; }

}  // namespace bdpt
