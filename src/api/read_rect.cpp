#include "api/read_rect.h"

#include <algorithm>

namespace bdpt {

PixelRect read_rect(const Subject& subject, const char* field, const uint32_t rect[4], int width, int height) {
  if (std::all_of(rect, rect + 4, [](uint32_t v) { return v == 0; })) return {0, 0, width, height};
  if (rect[0] >= rect[2] || rect[1] >= rect[3] || rect[2] > uint32_t(width) || rect[3] > uint32_t(height))
    subject.refuse(field, "is (", rect[0], ", ", rect[1], ") to (", rect[2], ", ", rect[3],
                   "): give a rectangle that is not empty, within ", width, " x ", height, ", or four zeros for all");
  return {int(rect[0]), int(rect[1]), int(rect[2]), int(rect[3])};
}

}  // namespace bdpt
