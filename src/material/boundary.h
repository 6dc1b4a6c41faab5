// The boundary of two dielectric media.
#pragma once

#include "material/microfacet.h"

namespace bdpt {

struct Boundary {
  float ior;  // behind it over before it
  Ggx ggx;
  bool smooth, single_scattering;

  bool is_index_matched() const { return std::fabs(ior - 1) < 1e-4f; }
};

BsdfValue evaluate(const Boundary& boundary, const Vec3& previous, const Vec3& next, TransportMode mode);
BsdfSample sample(const Boundary& boundary, const Vec3& previous, TransportMode mode, const float u[3]);

}  // namespace bdpt
