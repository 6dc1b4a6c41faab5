// Diffuse reflection of a rough surface.
#include "material/kinds.h"
#include "material/oren_nayar.h"

namespace bdpt {
namespace {

BsdfValue evaluate_rough_diffuse(const Material& material, const Rgb& reflectance, const Vec3& previous,
                                 const Vec3& next, TransportMode) {
  if (!(previous.z * next.z > 0) || is_blind_side(material, previous)) return {};
  const OrenNayar rough(material.diffuse_roughness);
  const Vec3 p = to_front(previous, previous), n = to_front(previous, next);
  return {rough.f(reflectance, p, n), rough.density(n.z), rough.density(p.z)};
}

BsdfSample sample_rough_diffuse(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode,
                                const float u[3]) {
  if (previous.z == 0 || is_blind_side(material, previous)) return {};
  const OrenNayar rough(material.diffuse_roughness);
  const Vec3 p = to_front(previous, previous), n = rough.sample(u[0], u[1]);
  if (n.z == 0) return {};
  return sampled(to_front(previous, n), {rough.f(reflectance, p, n), rough.density(n.z), rough.density(p.z)});
}

}  // namespace

const MaterialKind kRoughDiffuseKind{evaluate_rough_diffuse, sample_rough_diffuse, never, never, never};

}  // namespace bdpt
