// What a kind of material is, behind the table in material.cpp; each is defined in the file of its name.
#pragma once

#include "material/material.h"

namespace bdpt {

struct MaterialKind {
  BsdfValue (*evaluate)(const Material& material, const Rgb& reflectance, const Vec3& previous, const Vec3& next,
                        TransportMode mode);
  BsdfSample (*sample)(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode mode,
                       const float u[3]);
  bool (*is_specular)(const Material& material);
  bool (*transmits)(const Material& material);
};

extern const MaterialKind kDiffuseKind, kMirrorKind, kConductorKind, kDielectricKind, kInterfaceKind;

inline bool always(const Material&) { return true; }
inline bool never(const Material&) { return false; }

// True where a reflecting kind scatters nothing, seen from that side.
inline bool is_blind_side(const Material& material, const Vec3& v) { return material.one_sided && v.z < 0; }

}  // namespace bdpt
