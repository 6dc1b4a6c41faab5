// A material of the host's: f, and a way to sample it.
#pragma once

#include "material/material.h"

namespace bdpt {

class HostMaterial {
 public:
  virtual ~HostMaterial() = default;
  // f for radiance and importance alike: it is symmetric. False: the host failed.
  virtual bool evaluate(const Material& material, const Rgb& reflectance, const Vec3& previous, const Vec3& next,
                        BsdfValue& value) const = 0;
  virtual bool sample(const Material& material, const Rgb& reflectance, const Vec3& previous, const float u[3],
                      Vec3& next) const = 0;

  uint64_t hash = 0;  // of all that decides f
};

}  // namespace bdpt
