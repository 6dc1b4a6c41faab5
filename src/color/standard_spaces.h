// The colour spaces that need no configuration, by the names of the ACES configurations and their aliases.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "color/primaries.h"

namespace bdpt {

enum class Curve {
  Linear,
  Srgb,  // IEC 61966-2-1; below 0 its straight part goes on
  Data,  // no colours: never converted
};

struct StandardSpace {
  std::array<const char*, 5> names;  // the first is its own, the rest stand for it or are NULL
  Primaries primaries;
  Curve curve = Curve::Linear;
  const char* name() const { return names[0]; }
};

std::span<const StandardSpace> standard_spaces();
inline constexpr const char* kLinearRec709 = "Linear Rec.709 (sRGB)";
inline constexpr const char* kSrgbTexture = "sRGB - Texture";
inline constexpr const char* kAces2065 = "ACES2065-1";

// In any case of letters; NULL if there is none.
const StandardSpace* find_standard_space(std::string_view name);

}  // namespace bdpt
