#include "color/standard_spaces.h"

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

constexpr StandardSpace kSpaces[] = {
    {{kLinearRec709, "lin_rec709", "lin_rec709_srgb", "lin_srgb", "Utility - Linear - sRGB"}, kRec709},
    {{kSrgbTexture, "srgb_texture", "srgb_tx", "sRGB", "Utility - sRGB - Texture"}, kRec709, Curve::Srgb},
    {{"ACEScg", "lin_ap1", "ACES - ACEScg"}, kAp1},
    {{kAces2065, "lin_ap0", "aces", "ACES - ACES2065-1"}, kAp0},
    {{"Linear Rec.2020", "lin_rec2020", "Utility - Linear - Rec.2020"}, kRec2020},
    {{"Linear P3-D65", "lin_p3d65", "lin_displayp3", "Utility - Linear - P3-D65"}, kP3D65},
    {{"Raw", "data", "Utility - Raw"}, kRec709, Curve::Data},
};

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

std::span<const StandardSpace> standard_spaces() { return kSpaces; }

const StandardSpace* find_standard_space(std::string_view name) {
  for (const StandardSpace& space : kSpaces)
    for (const char* known : space.names)
      if (known && same_name(known, name)) return &space;
  return nullptr;
}

}  // namespace bdpt
