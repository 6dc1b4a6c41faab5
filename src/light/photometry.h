// A luminaire's intensities by angles, as laboratories measure them.
#pragma once

#include "sampling/hash.h"

#include <vector>

namespace bdpt {

// In degrees, each ascending. vertical: from the axis, within [0,180]; dark beyond. horizontal: round the axis, 0 alone
// where all are alike, or from 0 to 90, 180 or 360, the rest being mirrored.
struct Photometry {
  std::vector<float> vertical, horizontal;
  std::vector<float> intensities;  // for each horizontal angle all vertical ones

  uint64_t hash() const {
    uint64_t h = hash_values(vertical.size(), horizontal.size());
    for (const std::vector<float>* v : {&vertical, &horizontal, &intensities})
      h = hash_bytes(v->data(), v->size() * sizeof(float), h);
    return h;
  }
};

}  // namespace bdpt
