// Lambertian reflection, and Lambertian transmission to the other side: paper, leaves, lampshades.
#include "material/kinds.h"
#include "sampling/warp.h"

namespace bdpt {
namespace {

float chance_of_reflection(const Rgb& reflectance, const Rgb& transmittance) {
  const float r = norm(reflectance), t = norm(transmittance);
  return r > 0 ? r / (r + t) : 0;
}

BsdfValue value(const Material& material, const Rgb& reflectance, const Vec3& previous, const Vec3& next) {
  const bool reflects = previous.z * next.z > 0;
  const float reflection = chance_of_reflection(reflectance, material.transmittance);
  const float part = (reflects ? reflection : 1 - reflection) * kInvPi;
  return {(reflects ? reflectance : material.transmittance) * kInvPi, part * std::fabs(next.z),
          part * std::fabs(previous.z)};
}

BsdfValue evaluate_diffuse_transmission(const Material& material, const Rgb& reflectance, const Vec3& previous,
                                        const Vec3& next, TransportMode) {
  if (previous.z == 0 || next.z == 0) return {};
  return value(material, reflectance, previous, next);
}

BsdfSample sample_diffuse_transmission(const Material& material, const Rgb& reflectance, const Vec3& previous,
                                       TransportMode, const float u[3]) {
  Vec3 n = sample_cosine_hemisphere(u[0], u[1]);
  if (previous.z == 0 || n.z == 0) return {};
  const bool reflects = u[2] < chance_of_reflection(reflectance, material.transmittance);
  n.z = std::copysign(n.z, reflects ? previous.z : -previous.z);
  return sampled(n, value(material, reflectance, previous, n));
}

}  // namespace

const MaterialKind kDiffuseTransmissionKind{evaluate_diffuse_transmission, sample_diffuse_transmission, never, always,
                                            never};

}  // namespace bdpt
