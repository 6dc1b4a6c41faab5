// The axes of a light at a point that has a direction and a side that is up.
#pragma once

#include "math/vec.h"

namespace bdpt {

struct LightAxes {
  Vec3 right, up, forward;  // orthonormal; right of who looks forward with up above
  LightAxes() = default;
  // up: of any length; where it is of none, or along the direction, +y, or -z.
  LightAxes(const Vec3& direction, const Vec3& desired_up) : forward(direction) {
    for (const Vec3& above : {desired_up, Vec3(0, 1, 0), Vec3(0, 0, -1)}) {
      right = cross(forward, above);
      if (!(length_squared(right) > 1e-6f * length_squared(above))) continue;
      right = unit(right);
      up = cross(right, forward);
      return;
    }
  }
  Vec3 to_local(const Vec3& v) const { return {dot(v, right), dot(v, up), dot(v, forward)}; }
  Vec3 to_world(const Vec3& v) const { return right * v.x + up * v.y + forward * v.z; }
};

}  // namespace bdpt
