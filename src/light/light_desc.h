// Lights that are no geometry, as the builder hands them over.
#pragma once

#include "math/transform.h"

#include <memory>
#include <string>
#include <vector>

namespace bdpt {

class Texture;
struct Photometry;

// A rectangle; its edges are of some length, at right angles but for rounding.
struct Portal {
  Vec3 corner, edge_u, edge_v;
};

enum class LightType { Point, Spot, Environment, Directional };

struct LightDesc {
  std::string label;
  LightType type = LightType::Point;
  Vec3 position;
  Vec3 direction{0, 0, -1};                      // unit; spot, directional: the way that light goes
  Rgb intensity;                                 // point, spot
  Rgb radiance;                                  // environment; with a texture its factor
  float cos_outer = 0;                           // spot: cosine where it is dark
  float cos_inner = 0;                           // spot: cosine where it is full, >= cos_outer
  Vec3 up{0, 0, 0};                              // spot with a texture, photometry; zero: see LightAxes
  std::shared_ptr<const Photometry> photometry;  // point: times intensity
  std::shared_ptr<const Texture> texture;        // environment, spot
  Transform transform;                           // of the environment's texture: orthonormal, may reflect
  Rgb irradiance;                                // directional: of a surface that faces it
  double angular_radius = 0;                     // directional, in radians: of a disc; 0: a Dirac
  std::vector<Portal> portals;                   // environment, directional: hints, see Portals
  uint32_t group = 0;                            // below 64; outputs may ask for some groups' light
  uint64_t id = 0;                               // the host's; decides nothing

  // Whether it is at its position.
  bool has_position() const { return type == LightType::Point || type == LightType::Spot; }
  // What its strength is told by.
  const Rgb& strength() const {
    return has_position() ? intensity : type == LightType::Environment ? radiance : irradiance;
  }
};

}  // namespace bdpt
