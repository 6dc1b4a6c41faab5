// A metal below a clear coat, both smooth or of GGX microfacets. Light that comes back from the metal F of the times
// leaves, or is thrown back; seen and thrown back at one angle all orders sum to T^2 F / (1 - R F), with R the coat's
// albedo and T = 1 - R. For two angles
//   f = f_coat + T(p) T(n) / (1 - F min(R(p), R(n))) f_metal,
// which is symmetric, never more than arrives, and all of it where the metal reflects all light at its mirror's angle.
#include "material/compensation.h"
#include "material/kinds.h"
#include "sampling/warp.h"

namespace bdpt {
namespace {

struct CoatedMetal {
  float ior;
  BoundaryAlbedo::Eta index;
  Ggx coat, metal;
  bool smooth_coat, smooth_metal, single_scattering;
  Rgb eta, k, mean;  // of the metal in the coat's medium; and its mean reflectance

  explicit CoatedMetal(const Material& m)
      : ior(m.coat_ior),
        index(BoundaryAlbedo::at(ior)),
        coat(m.coat_alpha, m.coat_alpha),
        metal(seen_through(m.alpha_u, m), seen_through(m.alpha_v, m)),
        smooth_coat(m.coat_alpha == 0),
        smooth_metal(smooth_coat && m.is_smooth()),
        single_scattering(m.single_scattering),
        eta(m.eta * (1 / ior)),
        k(m.k * (1 / ior)),
        mean(fresnel_conductor_mean(eta, k)) {}

  // A rough coat blurs what is below it, on the way in and on the way out.
  static float seen_through(float alpha, const Material& m) {
    return std::min(std::sqrt(alpha * alpha + 2 * (1 - 1 / m.coat_ior) * sqr(m.coat_alpha)), 1.0f);
  }

  float reflected(const Vec3& v) const {
    const float cosine = std::min(v.z, 1.0f);
    if (smooth_coat) return fresnel_outside(cosine, ior);
    return std::min(BoundaryAlbedo::get().reflected(coat.alpha_u, cosine, index), 1.0f);
  }
  // The metal's reflectance, of light that comes at this angle above the coat.
  Rgb fresnel(float cosine) const {
    return fresnel_conductor(std::min(safe_sqrt(refracted_cosine_squared(cosine, ior)), 1.0f), eta, k);
  }
  static Rgb through(const Rgb& metal, float r_p, float r_n) {
    const float r = std::min(r_p, r_n), t = (1 - r_p) * (1 - r_n);
    const auto channel = [&](float f) { return t / (1 - f * r); };
    return {channel(metal.r), channel(metal.g), channel(metal.b)};
  }
  float chance(float reflected) const { return reflected / (reflected + (1 - reflected) * norm(mean)); }
};

BsdfValue value(const CoatedMetal& c, const Vec3& p, const Vec3& n) {
  const float r_p = c.reflected(p), r_n = c.reflected(n);
  const float coat_p = c.chance(r_p), coat_n = c.chance(r_n);
  BsdfValue v;
  if (!c.smooth_metal) {
    const MicrofacetReflection r = reflect_at_microfacets(c.metal, p, n);
    const Rgb fresnel = c.fresnel(std::min(r.cos_h, 1.0f));
    v = {fresnel * CoatedMetal::through(fresnel, r_p, r_n) * r.f, r.density, r.density_reverse};
    if (!c.single_scattering) {
      const MetalLoss loss(c.metal, p, n);
      v.f += loss.f(c.mean) * CoatedMetal::through(c.mean, r_p, r_n);
      v.density += loss.p * (n.z * kInvPi - v.density);
      v.density_reverse += loss.n * (p.z * kInvPi - v.density_reverse);
    }
    v.density *= 1 - coat_p;
    v.density_reverse *= 1 - coat_n;
  }
  if (c.smooth_coat) return v;
  const MicrofacetReflection r = reflect_at_microfacets(c.coat, p, n);
  v.f += Rgb(r.f * fresnel_outside(std::min(r.cos_h, 1.0f), c.ior));
  v.density += coat_p * r.density;
  v.density_reverse += coat_n * r.density_reverse;
  return v;
}

BsdfValue evaluate_coated_conductor(const Material& material, const Rgb&, const Vec3& previous, const Vec3& next,
                                    TransportMode) {
  const Vec3 p = to_front(previous, previous), n = to_front(previous, next);
  if (p.z < kMinCosine || n.z < kMinCosine || is_blind_side(material, previous)) return {};
  return value(CoatedMetal(material), p, n);
}

BsdfSample sample_coated_conductor(const Material& material, const Rgb&, const Vec3& previous, TransportMode,
                                   const float u[3]) {
  const Vec3 p = to_front(previous, previous);
  if (p.z < kMinCosine || is_blind_side(material, previous)) return {};
  const CoatedMetal c(material);
  const float reflected = c.reflected(p), coat = c.chance(reflected);
  if (c.smooth_metal) {  // one mirror
    const Rgb fresnel = c.fresnel(std::min(p.z, 1.0f));
    return mirrored(previous, Rgb(reflected) + fresnel * CoatedMetal::through(fresnel, reflected, reflected), 1);
  }
  const bool at_coat = u[2] < coat;
  if (at_coat && c.smooth_coat) return mirrored(previous, Rgb(reflected), coat);
  const float rest = (u[2] - coat) / (1 - coat);
  Vec3 n;
  if (!at_coat && !c.single_scattering && rest < MetalLoss::of(c.metal, p)) {
    n = sample_cosine_hemisphere(u[0], u[1]);
  } else {
    const Vec3 h = (at_coat ? c.coat : c.metal).sample_visible(p, u[0], u[1]);
    n = h * (2 * dot(p, h)) - p;
  }
  if (n.z < kMinCosine) return {};
  return sampled(to_front(previous, n), value(c, p, n));
}

bool has_smooth_coat(const Material& m) { return m.coat_alpha == 0; }
bool is_all_smooth(const Material& m) { return m.coat_alpha == 0 && m.is_smooth(); }

}  // namespace

const MaterialKind kCoatedConductorKind{evaluate_coated_conductor, sample_coated_conductor, is_all_smooth, never,
                                        has_smooth_coat};

}  // namespace bdpt
