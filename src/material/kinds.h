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
  bool (*has_specular)(const Material& material);
};

extern const MaterialKind kDiffuseKind, kMirrorKind, kConductorKind, kDielectricKind, kInterfaceKind,
    kDiffuseTransmissionKind, kCoatedDiffuseKind, kCoatedConductorKind, kPrincipledKind, kMixKind, kHostKind,
    kBrushedKind, kRoughDiffuseKind;

inline bool always(const Material&) { return true; }
inline bool never(const Material&) { return false; }

// Straight through, as if nothing were there.
inline BsdfSample pass_straight(const Vec3& previous) {
  BsdfSample s;
  s.next = -previous;
  s.weight = Rgb(1);
  s.density = s.density_reverse = std::fabs(previous.z);
  s.specular = true;
  return s;
}

// True where a reflecting kind scatters nothing, seen from that side.
inline bool is_blind_side(const Material& material, const Vec3& v) { return material.one_sided && v.z < 0; }

// v, mirrored in the surface where `previous` is on the back, so that it is seen from the front.
inline Vec3 to_front(const Vec3& previous, const Vec3& v) { return previous.z < 0 ? Vec3(v.x, v.y, -v.z) : v; }

// A sample of what is no Dirac, by the value for its direction.
inline BsdfSample sampled(const Vec3& next, const BsdfValue& value) {
  BsdfSample s;
  if (!(value.density > 0)) return s;
  s.next = next;
  s.weight = value.f * (std::fabs(next.z) / value.density);
  s.density = value.density;
  s.density_reverse = value.density_reverse;
  return s;
}

// A sample of a Dirac that is chosen with a probability that depends on the direction it is seen from.
inline BsdfSample sampled_dirac(BsdfSample s, float chance, float chance_reverse) {
  if (!(chance > 0)) return {};
  s.density *= chance;
  s.density_reverse *= chance_reverse;
  return s;
}

// The mirror's, of a layer that reflects so much, chosen with such a chance either way.
inline BsdfSample mirrored(const Vec3& previous, const Rgb& reflectance, float chance) {
  if (!(chance > 0)) return {};
  BsdfSample s;
  s.next = {-previous.x, -previous.y, previous.z};
  s.weight = reflectance * (1 / chance);
  s.density = s.density_reverse = chance * std::fabs(previous.z);
  s.specular = true;
  return s;
}

}  // namespace bdpt
