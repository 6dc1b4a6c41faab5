// OpenEXR files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt {

struct ExrLayer {
  std::string name;               // empty for the main layer: channels R, G, B; else name.R, name.G, name.B
  const float* pixels = nullptr;  // 3 floats to a pixel, packed, row 0 the top
};

// Writes scanlines with ZIP compression; path holds the old file or the new one. As half floats, finite values beyond
// the range of half are clipped to it; NaN and infinities are kept. Uses OpenEXR's threads as the host set them.
// Errors: InvalidArgument (no layer, no pixel, two layers of one name, a name too long), Io.
void write_exr(const std::string& path, uint32_t width, uint32_t height, const std::vector<ExrLayer>& layers,
               bool as_half);

}  // namespace bdpt
