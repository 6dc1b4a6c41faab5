// A metal: Fresnel reflection, smooth or at GGX microfacets.
#include "material/compensation.h"
#include "material/kinds.h"
#include "sampling/warp.h"

namespace bdpt {
namespace {

BsdfValue evaluate_conductor(const Material& material, const Rgb&, const Vec3& previous, const Vec3& next,
                             TransportMode) {
  if (material.is_smooth() || is_blind_side(material, previous)) return {};
  const float cos_n = previous.z < 0 ? -next.z : next.z, cos_p = std::fabs(previous.z);
  if (cos_p < kMinCosine || cos_n < kMinCosine) return {};
  const Ggx ggx(material);
  const MicrofacetReflection r = reflect_at_microfacets(ggx, previous, next);
  const Rgb fresnel = fresnel_conductor(std::min(r.cos_h, 1.0f), material.eta, material.k);
  BsdfValue v{fresnel * r.f, r.density, r.density_reverse};
  if (material.single_scattering) return v;
  const MetalLoss loss(ggx, previous, next);
  v.f += loss.f(fresnel_conductor_mean(material.eta, material.k));
  v.density += loss.p * (cos_n * kInvPi - v.density);
  v.density_reverse += loss.n * (cos_p * kInvPi - v.density_reverse);
  return v;
}

BsdfSample sample_conductor(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode mode,
                            const float u[3]) {
  const float cos_p = std::fabs(previous.z);
  if (cos_p < kMinCosine || is_blind_side(material, previous)) return {};
  if (material.is_smooth())
    return mirrored(previous, fresnel_conductor(std::min(cos_p, 1.0f), material.eta, material.k), 1);
  const Ggx ggx(material);
  if (!material.single_scattering && u[2] < MetalLoss::of(ggx, previous)) {
    const Vec3 n = to_front(previous, sample_cosine_hemisphere(u[0], u[1]));
    return sampled(n, evaluate_conductor(material, reflectance, previous, n, mode));
  }
  const Vec3 p(previous.x, previous.y, cos_p);  // seen from the front, whichever side it is
  const Vec3 h = ggx.sample_visible(p, u[0], u[1]);
  const float cos_h = dot(p, h);
  const Vec3 n = h * (2 * cos_h) - p;
  if (n.z < kMinCosine) return {};
  const float stretched_p = ggx.stretched_length(p), stretched_n = ggx.stretched_length(n);
  const float quarter_d = 0.25f * ggx.d(h);
  BsdfSample s;
  s.next = {n.x, n.y, std::copysign(n.z, previous.z)};
  s.weight = fresnel_conductor(std::clamp(cos_h, 0.0f, 1.0f), material.eta, material.k) *
             smith_g2_over_g1(cos_p, stretched_p, n.z, stretched_n);
  s.density = quarter_d * smith_g1_over_cos(cos_p, stretched_p);
  s.density_reverse = quarter_d * smith_g1_over_cos(n.z, stretched_n);
  if (material.single_scattering) return s;
  const MetalLoss loss(ggx, p, n);
  return with_lobe(s, loss.f(fresnel_conductor_mean(material.eta, material.k)), loss.p, loss.n, n.z * kInvPi,
                   cos_p * kInvPi);
}

bool is_smooth(const Material& material) { return material.is_smooth(); }

}  // namespace

const MaterialKind kConductorKind{evaluate_conductor, sample_conductor, is_smooth, never, is_smooth};

}  // namespace bdpt
