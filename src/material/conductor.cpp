// A metal: Fresnel reflection, smooth or at GGX microfacets with single scattering.
#include "material/fresnel.h"
#include "material/kinds.h"
#include "material/microfacet.h"

namespace bdpt {
namespace {

BsdfValue evaluate_conductor(const Material& material, const Rgb&, const Vec3& previous, const Vec3& next,
                             TransportMode) {
  if (material.is_smooth() || is_blind_side(material, previous)) return {};
  const float cos_n = previous.z < 0 ? -next.z : next.z;
  if (std::fabs(previous.z) < kMinCosine || cos_n < kMinCosine) return {};
  const MicrofacetReflection r = reflect_at_microfacets(Ggx(material), previous, next);
  const Rgb fresnel = fresnel_conductor(std::min(r.cos_h, 1.0f), material.eta, material.k);
  return {fresnel * r.f, r.density, r.density_reverse};
}

BsdfSample sample_conductor(const Material& material, const Rgb&, const Vec3& previous, TransportMode,
                            const float u[3]) {
  const float cos_p = std::fabs(previous.z);
  if (cos_p < kMinCosine || is_blind_side(material, previous)) return {};
  BsdfSample s;
  if (material.is_smooth()) {
    s.next = {-previous.x, -previous.y, previous.z};
    s.weight = fresnel_conductor(std::min(cos_p, 1.0f), material.eta, material.k);
    s.density = s.density_reverse = cos_p;
    s.specular = true;
    return s;
  }
  const Ggx ggx(material);
  const Vec3 p(previous.x, previous.y, cos_p);  // seen from the front, whichever side it is
  const Vec3 h = ggx.sample_visible(p, u[0], u[1]);
  const float cos_h = dot(p, h);
  const Vec3 n = h * (2 * cos_h) - p;
  if (n.z < kMinCosine) return {};
  const float stretched_p = ggx.stretched_length(p), stretched_n = ggx.stretched_length(n);
  const float quarter_d = 0.25f * ggx.d(h);
  s.next = {n.x, n.y, std::copysign(n.z, previous.z)};
  s.weight = fresnel_conductor(std::clamp(cos_h, 0.0f, 1.0f), material.eta, material.k) *
             smith_g2_over_g1(cos_p, stretched_p, n.z, stretched_n);
  s.density = quarter_d * smith_g1_over_cos(cos_p, stretched_p);
  s.density_reverse = quarter_d * smith_g1_over_cos(n.z, stretched_n);
  return s;
}

}  // namespace

const MaterialKind kConductorKind{evaluate_conductor, sample_conductor, [](const Material& m) { return m.is_smooth(); },
                                  never};

}  // namespace bdpt
