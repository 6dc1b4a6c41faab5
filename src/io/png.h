// PNG files.
#pragma once

#include <cstdint>
#include <string>

namespace bdpt {

// Writes display values, 3 floats to a pixel, packed, row 0 the top, as 8-bit RGB: clipped to [0,1] and rounded.
// path holds the old file or the new one. Errors: InvalidArgument (no pixel, a value that is not a number), Io.
void write_png(const std::string& path, const float* pixels, uint32_t width, uint32_t height);

}  // namespace bdpt
