// Rectangles of pixels or texels, as the host gives them.
#pragma once

#include "api/check.h"
#include "sensor/sensor.h"

namespace bdpt {

// x0, y0, x1, y1 within width x height; four zeros stand for all of it.
PixelRect read_rect(const Subject& subject, const char* field, const uint32_t rect[4], int width, int height);

}  // namespace bdpt
