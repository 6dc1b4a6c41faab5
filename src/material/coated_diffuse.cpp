// Plastic, varnished wood: a dielectric coat, smooth or of GGX microfacets, over a diffuse base. Light that the coat
// does not reflect goes to the base, and comes back in the directions that the coat lets it out:
//   f = f_coat + (1 - R(p)) (1 - R(n)) / (1 - mean R) f_base,
// R the albedo of the coat. Light that the coat throws back to the base meets it again and again, which makes colours
// deeper: the base's reflectance is rho (1 - Ri) / (1 - rho Ri), Ri the coat's mean reflectance from below.
#include "material/albedo.h"
#include "material/fresnel.h"
#include "material/kinds.h"
#include "material/oren_nayar.h"

namespace bdpt {
namespace {

struct Coated {
  Ggx ggx;
  bool smooth;
  float ior, mean;  // mean R
  Rgb base;         // its reflectance below the coat
  BoundaryAlbedo::Eta eta;

  Coated(const Material& m, const Rgb& reflectance) : ggx(m), smooth(m.is_smooth()), ior(m.ior) {
    const BoundaryAlbedo& albedo = BoundaryAlbedo::get();
    eta = BoundaryAlbedo::at(ior);
    mean = albedo.reflected_mean(smooth ? 0 : isotropic_alpha(ggx, Vec3(0, 0, 1)), eta);
    const float inside = 1 - (1 - albedo.reflected_mean(0, eta)) / (ior * ior);
    const auto channel = [&](float rho) { return rho * (1 - inside) / (1 - rho * inside); };
    base = {channel(reflectance.r), channel(reflectance.g), channel(reflectance.b)};
  }

  float reflected(const Vec3& v) const {
    const float cosine = std::min(v.z, 1.0f);
    if (smooth) return fresnel_outside(cosine, ior);
    return std::min(BoundaryAlbedo::get().reflected(isotropic_alpha(ggx, v), cosine, eta), 1.0f);
  }
  // Of the coat, where so much is reflected by it.
  float chance(float reflected) const {
    const float below = (1 - reflected) * norm(base);
    return reflected > 0 ? reflected / (reflected + below) : 0;
  }
};

// For directions on the front.
BsdfValue value(const Coated& c, float roughness, const Vec3& p, const Vec3& n) {
  const float reflected_p = c.reflected(p), reflected_n = c.reflected(n);
  const float coat_p = c.chance(reflected_p), coat_n = c.chance(reflected_n);
  const OrenNayar rough(roughness);
  BsdfValue v;
  v.f = rough.f(c.base, p, n) * ((1 - reflected_p) * (1 - reflected_n) / (1 - c.mean));
  v.density = (1 - coat_p) * rough.density(n.z);
  v.density_reverse = (1 - coat_n) * rough.density(p.z);
  if (c.smooth) return v;
  const MicrofacetReflection r = reflect_at_microfacets(c.ggx, p, n);
  v.f += Rgb(r.f * fresnel_outside(std::min(r.cos_h, 1.0f), c.ior));
  v.density += coat_p * r.density;
  v.density_reverse += coat_n * r.density_reverse;
  return v;
}

BsdfValue evaluate_coated_diffuse(const Material& material, const Rgb& reflectance, const Vec3& previous,
                                  const Vec3& next, TransportMode) {
  const Vec3 p = to_front(previous, previous), n = to_front(previous, next);
  if (p.z < kMinCosine || n.z < kMinCosine || is_blind_side(material, previous)) return {};
  return value(Coated(material, reflectance), material.diffuse_roughness, p, n);
}

BsdfSample sample_coated_diffuse(const Material& material, const Rgb& reflectance, const Vec3& previous, TransportMode,
                                 const float u[3]) {
  const Vec3 p = to_front(previous, previous);
  if (p.z < kMinCosine || is_blind_side(material, previous)) return {};
  const Coated c(material, reflectance);
  const float reflected = c.reflected(p), coat = c.chance(reflected);
  Vec3 n;
  if (u[2] >= coat) {
    n = OrenNayar(material.diffuse_roughness).sample(u[0], u[1]);
  } else if (c.smooth) {
    return mirrored(previous, Rgb(reflected), coat);
  } else {
    const Vec3 h = c.ggx.sample_visible(p, u[0], u[1]);
    n = h * (2 * dot(p, h)) - p;
  }
  if (n.z < kMinCosine) return {};
  return sampled(to_front(previous, n), value(c, material.diffuse_roughness, p, n));
}

bool is_smooth(const Material& m) { return m.is_smooth(); }

}  // namespace

const MaterialKind kCoatedDiffuseKind{evaluate_coated_diffuse, sample_coated_diffuse, never, never, is_smooth};

}  // namespace bdpt
