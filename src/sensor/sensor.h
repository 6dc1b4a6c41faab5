// Sensors: what is measured. A sensor starts eye subpaths, is seen by light subpaths, and maps both to measurements.
// After Veach, W_e is split into W_e^(0) (position) and W_e^(1) (direction), and the directional part is treated as a
// BSDF at z0, with densities per projected solid angle. The engine never asks which kind a sensor is.
#pragma once

#include "math/vec.h"

#include <cstdint>

namespace bdpt {

// Where on the film, in pixels of the region measured; may lie outside by the filter's radius.
using FilmPosition = Vec2;

// z0 and the first direction of an eye subpath.
struct EyeStart {
  FilmPosition film;
  Vec3 p, normal;           // z0, and the unit normal of the lens
  Vec3 direction;           // unit
  float density_position;   // P_A(z0); of a pinhole the Dirac's coefficient, 1
  float density_direction;  // P_sigma-perp(z0 -> z1)
  float weight;             // alpha_2 = W_e / (P_A P_sigma-perp)
};

// z0 as seen from a point (t = 1), or as hit by a light segment (t = 0).
struct SensorPoint {
  FilmPosition film;
  Vec3 p, normal;
  float importance;         // W_e(x -> z0)
  float density_position;   // P_A(z0)
  float density_direction;  // P_sigma-perp(z0 -> x)
};

// Pixels [x0, x1) x [y0, y1), in film coordinates.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  uint64_t count() const { return uint64_t(x1 - x0) * uint64_t(y1 - y0); }
  int width() const { return x1 - x0; }
};

class Sensor {
 public:
  virtual ~Sensor() = default;

  virtual int width() const = 0;  // of the region measured
  virtual int height() const = 0;
  // Whether light subpaths can hit the sensor by chance (t = 0).
  virtual bool is_hittable() const = 0;
  virtual uint64_t hash() const = 0;

  // Starts an eye subpath at a film position with two uniform numbers for the lens. The film positions of a pass lie
  // evenly in `bounds`, which enters W_e and the density of directions: a pixel's value is the mean over its filter.
  virtual EyeStart start(const FilmPosition& film, const float lens[2], const PixelRect& bounds) const = 0;
  // Chooses z0 for t = 1; false where x is not in the picture.
  virtual bool sample_toward(const Vec3& x, const float lens[2], const PixelRect& bounds, SensorPoint& z0) const = 0;
  // t = 0: whether the segment from origin along the unit direction, up to tmax, passes through the sensor.
  virtual bool hit(const Vec3& origin, const Vec3& direction, float tmax, const PixelRect& bounds,
                   SensorPoint& z0) const = 0;
};

}  // namespace bdpt
