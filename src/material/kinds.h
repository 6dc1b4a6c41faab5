// The functions behind the table in material.cpp; each pair is defined in the file of its kind.
#pragma once

#include "material/material.h"

namespace bdpt {

using EvaluateFunction = BsdfValue(const Material& material, const Rgb& reflectance, const Vec3& previous,
                                   const Vec3& next, TransportMode mode);
using SampleFunction = BsdfSample(const Material& material, const Rgb& reflectance, const Vec3& previous,
                                  TransportMode mode, const float u[3]);

EvaluateFunction evaluate_diffuse, evaluate_mirror, evaluate_conductor, evaluate_dielectric;
SampleFunction sample_diffuse, sample_mirror, sample_conductor, sample_dielectric;

// True where a reflecting kind scatters nothing, seen from that side.
inline bool is_blind_side(const Material& material, const Vec3& v) { return material.one_sided && v.z < 0; }

}  // namespace bdpt
