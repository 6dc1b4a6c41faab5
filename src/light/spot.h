// How a spot falls off.
#pragma once

namespace bdpt {

struct SpotCone {
  float cos_outer, cos_inner;
  float falloff(float cosine) const {
    if (cosine <= cos_outer) return 0;
    if (cosine >= cos_inner) return 1;
    const float t = (cosine - cos_outer) / (cos_inner - cos_outer);
    return t * t * (3 - 2 * t);
  }
};

}  // namespace bdpt
