// Lights that are no geometry, as the builder hands them over.
#pragma once

#include "math/vec.h"

#include <string>

namespace bdpt {

enum class LightType { Point, Spot, Environment };

struct LightDesc {
  std::string label;
  LightType type = LightType::Point;
  Vec3 position;
  Vec3 direction{0, 0, -1};  // unit
  Rgb intensity;             // point, spot
  Rgb radiance;              // environment
  float cos_outer = 0;       // spot: cosine where it is dark
  float cos_inner = 0;       // spot: cosine where it is full, >= cos_outer
  uint32_t group = 0;        // below 64; outputs may ask for some groups' light
  uint64_t id = 0;           // the host's; decides nothing
};

}  // namespace bdpt
