// A texture whose colours the host computes, many places at once.
#pragma once

#include "geometry/rgba.h"

#include <cstdint>
#include <string>

namespace bdpt {

// Where it is looked up.
struct TexturePlace {
  Vec2 uv;
  Vec3 position;      // in the world
  uint64_t instance;  // the host's id
};

class HostTexture {
 public:
  virtual ~HostTexture() = default;
  // A colour for each place. Throws where the host fails.
  virtual void look_up(size_t count, const TexturePlace* places, Rgba* colors) const = 0;

  std::string label;
  float maximum = 1;  // of all channels; none is below 0
  Vec2 step{0, 0};    // in u and v, over which heights are compared
  uint64_t hash = 0;  // of all that decides the colours

  bool keeps_promise(const Rgba& color) const {
    for (float v : color)
      if (!(v >= 0 && v <= maximum)) return false;
    return true;
  }
};

}  // namespace bdpt
