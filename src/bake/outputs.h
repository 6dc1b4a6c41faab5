// What a measurement of arriving light may be asked for. Each output is some planes of the film; a plane's measurement
// function is the base's times a function of the direction.
//
// The base W_e^(1) is 1 per projected solid angle of the geometric normal on a surface (its measurement is the
// irradiance E), and 1 per solid angle at a point in space (the fluence).
#pragma once

#include "bake/octahedral.h"
#include "math/vec.h"
#include "sensor/sensor.h"

#include <algorithm>
#include <vector>

namespace bdpt {

enum class OutputKind {
  Irradiance,        // E = INT L max(0, w n) dw
  IrradianceOverPi,  // E / pi
  RadianceSh1,       // c_lm = INT L Y_lm(w) dw, l <= 1: 4 planes
  RadianceSh2,       // l <= 2: 9 planes
  IrradianceSh1,     // the same times pi, 2 pi / 3, pi / 4 for l = 0, 1, 2: E(n) = SUM of these times Y_lm(n)
  IrradianceSh2,
  Fluence,      // INT L dw
  Openness,     // 1 / pi INT V max(0, w n) dw: 1 in the open; V(w) = 1 where nothing is within reach
  BentNormal,   // INT V w max(0, w n) dw
  OpennessSh1,  // INT V Y_lm(w) dw
  OpennessSh2,
  Fronts,                // part of the rays that do not meet the back of a one-sided surface
  RadianceOctahedral,    // the mean of L over each texel of an Octahedron
  IrradianceOctahedral,  // INT L max(0, w n) dw for n of each texel's centre
  DistanceOctahedral,    // means over each texel: of the distance, of its square, and of 1 - V
  Unshadowed,            // the direct part of E as if nothing were in the light's way
};

struct OutputDesc {
  OutputKind kind = OutputKind::Irradiance;
  bool direct = true, indirect = true;
  uint64_t groups = ~0ull;
  float reach = 0;  // 0 = without end
  int size = 0;     // of an octahedron
};

// Whether it is zero at the horizon of a surface.
inline bool fades(OutputKind kind) {
  return kind == OutputKind::Irradiance || kind == OutputKind::IrradianceOverPi || kind == OutputKind::Openness ||
         kind == OutputKind::BentNormal || kind == OutputKind::Unshadowed;
}

inline bool all_fade(const std::vector<OutputDesc>& outputs) {
  return std::all_of(outputs.begin(), outputs.end(), [](const OutputDesc& o) { return fades(o.kind); });
}

inline bool is_octahedral(OutputKind kind) {
  return kind == OutputKind::RadianceOctahedral || kind == OutputKind::IrradianceOctahedral ||
         kind == OutputKind::DistanceOctahedral;
}

// Y_lm in the order (0,0); (1,-1), (1,0), (1,1); (2,-2) ... (2,2): 0.282095; 0.488603 (y, z, x);
// 1.092548 xy, 1.092548 yz, 0.315392 (3z^2 - 1), 1.092548 xz, 0.546274 (x^2 - y^2). l <= 2.
void real_sh(const Vec3& w, int planes, float* y);

class Outputs {
 public:
  explicit Outputs(const std::vector<OutputDesc>& outputs);
  const std::vector<OutputPlanes>& list() const { return list_; }
  int planes() const { return list_.back().first + list_.back().count; }
  static int planes_of(const OutputDesc& output);
  // Whether some plane is not the base. on_surface: of its sensor; normals may differ: shading normals are used.
  bool respond(bool on_surface, bool normals_differ) const;
  // Of all planes. cosine: of w with the normal that the base knows; 1 at a point in space.
  void evaluate(const Vec3& w, const Vec3& shading, float cosine, float* response) const;
  uint64_t hash() const;

 private:
  std::vector<OutputDesc> descs_;
  std::vector<OutputPlanes> list_;
  std::vector<Octahedron> octahedra_;  // of each output; empty where it has none
};

}  // namespace bdpt
