// Perfectly anisotropic reflection, as of a surface with fine scratches along u: light leaves on the cone round u on
// which it would leave a mirror. A Dirac in one dimension (Veach 10.3.5).
//
// With t the cosine of a direction with u and phi its angle round u, from the surface: f is reflectance / (2 sin) times
// the Dirac of t_next + t_previous, symmetric, and next is sampled by sin(phi) / 2. The Dirac is shared by both
// densities and left out of them.
#include "material/kinds.h"

namespace bdpt {
namespace {

BsdfValue evaluate_brushed(const Material&, const Rgb&, const Vec3&, const Vec3&, TransportMode) { return {}; }

BsdfSample sample_brushed(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode,
                          const float u[3]) {
  if (previous.z == 0 || is_blind_side(material, previous)) return {};
  const float c = material.tangent_cos, d = material.tangent_sin;
  const float along = c * previous.x + d * previous.y, across = c * previous.y - d * previous.x;
  const float radius = std::sqrt(across * across + previous.z * previous.z);
  const float side = 1 - 2 * u[0], height = safe_sqrt(1 - side * side);
  if (height == 0) return {};
  BsdfSample s;
  const float x = -along, y = side * radius;
  s.next = {c * x - d * y, d * x + c * y, std::copysign(height * radius, previous.z)};
  if (s.next.z == 0) return {};
  s.weight = reflectance;
  s.density = 0.5f * height;
  s.density_reverse = 0.5f * std::fabs(previous.z) / radius;
  s.specular = true;
  return s;
}

}  // namespace

const MaterialKind kBrushedKind{evaluate_brushed, sample_brushed, always, never, always};

}  // namespace bdpt
