// OpenEXR files.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bdpt {

struct ExrLayer {
  std::string name;               // empty for the main layer: channels R, G, B; else name.R, name.G, name.B
  const float* pixels = nullptr;  // 3 floats to a pixel, packed, row 0 the top
};

// CIE 1931 xy of red, green, blue and white.
using ExrChromaticities = std::array<std::array<float, 2>, 4>;
// The format's default, for files that name none.
inline constexpr ExrChromaticities kRec709Chromaticities{
    {{0.64f, 0.33f}, {0.30f, 0.60f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}}};

// Writes scanlines with ZIP compression; path holds the old file or the new one. As half floats, finite values beyond
// the range of half are clipped to it; NaN and infinities are kept. Uses OpenEXR's threads as the host set them.
// The file's attribute of that name has the chromaticities.
// Errors: InvalidArgument (no layer, no pixel, two layers of one name, a name too long), Io.
void write_exr(const std::string& path, uint32_t width, uint32_t height, const std::vector<ExrLayer>& layers,
               bool as_half, const ExrChromaticities& chromaticities = kRec709Chromaticities);

}  // namespace bdpt
