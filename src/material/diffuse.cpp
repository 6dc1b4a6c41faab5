// Lambertian reflection.
#include "material/kinds.h"
#include "sampling/warp.h"

namespace bdpt {
namespace {

BsdfValue evaluate_diffuse(const Material& material, const Rgb& reflectance, const Vec3& previous, const Vec3& next,
                           TransportMode) {
  if (!(previous.z * next.z > 0) || is_blind_side(material, previous)) return {};
  return {reflectance * kInvPi, std::fabs(next.z) * kInvPi, std::fabs(previous.z) * kInvPi};
}

BsdfSample sample_diffuse(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode,
                          const float u[3]) {
  if (previous.z == 0 || is_blind_side(material, previous)) return {};
  const Vec3 n = sample_cosine_hemisphere(u[0], u[1]);
  if (n.z == 0) return {};
  BsdfSample s;
  s.next = {n.x, n.y, std::copysign(n.z, previous.z)};
  s.weight = reflectance;
  s.density = n.z * kInvPi;
  s.density_reverse = std::fabs(previous.z) * kInvPi;
  return s;
}

}  // namespace

const MaterialKind kDiffuseKind{evaluate_diffuse, sample_diffuse, never, never, never};

}  // namespace bdpt
