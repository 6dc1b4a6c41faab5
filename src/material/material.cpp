#include "material/material.h"

#include <iterator>

#include "material/kinds.h"

namespace bdpt {
namespace {

// In the order of MaterialType.
constexpr const MaterialKind* kKinds[] = {&kDiffuseKind,       &kMirrorKind,
                                          &kConductorKind,     &kDielectricKind,
                                          &kInterfaceKind,     &kDiffuseTransmissionKind,
                                          &kCoatedDiffuseKind, &kCoatedConductorKind,
                                          &kPrincipledKind,    &kMixKind,
                                          &kHostKind,          &kBrushedKind,
                                          &kRoughDiffuseKind};
static_assert(std::size(kKinds) == static_cast<size_t>(MaterialType::RoughDiffuse) + 1);

const MaterialKind& kind_of(const Material& material) { return *kKinds[static_cast<int>(material.type)]; }

}  // namespace

bool Material::is_specular() const { return kind_of(*this).is_specular(*this); }
bool Material::has_specular() const { return kind_of(*this).has_specular(*this); }
bool Material::transmits() const { return kind_of(*this).transmits(*this); }

BsdfValue evaluate(const Material& material, const Rgb& reflectance, const Vec3& previous, const Vec3& next,
                   TransportMode mode) {
  return kind_of(material).evaluate(material, reflectance, previous, next, mode);
}

BsdfSample sample(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode mode,
                  const float u[3]) {
  return kind_of(material).sample(material, reflectance, previous, mode, u);
}

}  // namespace bdpt
