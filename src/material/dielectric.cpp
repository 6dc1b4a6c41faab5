// Glass, water: Fresnel reflection and refraction, smooth or at GGX microfacets (Walter et al. 2007). p and n are
// previous and next, both turned so that p is on the side z > 0, and eta is the index on the other side of the surface
// over that on the side of p.
#include "material/boundary.h"
#include "material/compensation.h"
#include "material/kinds.h"
#include "sampling/warp.h"

namespace bdpt {
namespace {

float turn(const Vec3& previous, float z) { return previous.z < 0 ? -z : z; }

// Radiance over the squared index is what refraction keeps; importance it keeps as it is (Veach 5.2).
float radiance_scale(TransportMode mode, float eta) { return mode == TransportMode::Radiance ? 1 / (eta * eta) : 1; }

// What refracts at the microfacets, f and densities being
//   f = shared G2 / (cos cos') {eta^2 for importance, 1 for radiance}   Walter et al. 2007, eq. 21
//   density = shared eta^2 G1 / cos, density_reverse = shared G1' / cos'.
BsdfValue refract_at_microfacets(const Ggx& ggx, float eta, const Vec3& p, const Vec3& n, TransportMode mode) {
  const Vec3 half = p + n * eta;  // eq. 16, of either sign, and with |p.h + eta n.h| for its length
  const float sign = half.z < 0 ? -1.0f : 1.0f;
  const float cos_ph = sign * dot(p, half), cos_nh = -sign * dot(n, half);  // both times |half|
  if (!(cos_ph > 0) || !(cos_nh > 0)) return {};
  // D |p.h| |n.h| / |half|^2: the lengths cancel against the degree of d.
  const float shared = (1 - fresnel_dielectric(cos_ph, cos_nh, eta)) * ggx.d(half) * cos_ph * cos_nh;
  const float cos_p = p.z, cos_n = -n.z;
  const float stretched_p = ggx.stretched_length(p), stretched_n = ggx.stretched_length(n);
  const float f = shared * smith_g2_over_cosines(cos_p, stretched_p, cos_n, stretched_n);
  return {Rgb(f * eta * eta * radiance_scale(mode, eta)), shared * eta * eta * smith_g1_over_cos(cos_p, stretched_p),
          shared * smith_g1_over_cos(cos_n, stretched_n)};
}

BsdfSample sample_smooth(const Vec3& previous, float index_p, float index_n, TransportMode mode, float u) {
  const float eta = index_n / index_p;
  const float cos_p = std::fabs(previous.z);
  const float cos2_t = refracted_cosine_squared(cos_p, eta);
  const float cos_t = safe_sqrt(cos2_t);
  const float reflectance = cos2_t > 0 ? fresnel_dielectric(cos_p, cos_t, eta) : 1;
  BsdfSample s;
  s.specular = true;
  if (u < reflectance) {
    s.next = {-previous.x, -previous.y, previous.z};
    s.weight = Rgb(1);
    s.density = s.density_reverse = reflectance * sqr(index_p) * cos_p;
    return s;
  }
  s.next = {-previous.x / eta, -previous.y / eta, -turn(previous, cos_t)};
  s.weight = Rgb(radiance_scale(mode, eta));
  s.density = (1 - reflectance) * sqr(index_n) * cos_t;
  s.density_reverse = (1 - reflectance) * sqr(index_p) * cos_p;
  return s;
}

BsdfSample sample_rough(const Ggx& ggx, const Vec3& previous, float eta, TransportMode mode, const float u[3]) {
  const Vec3 p(previous.x, previous.y, std::fabs(previous.z));
  const Vec3 h = ggx.sample_visible(p, u[0], u[1]);
  const float cos_ph = std::min(dot(p, h), 1.0f);
  if (!(cos_ph > 0)) return {};
  const float cos2_t = refracted_cosine_squared(cos_ph, eta);
  const float cos_t = safe_sqrt(cos2_t);
  const float reflectance = cos2_t > 0 ? fresnel_dielectric(cos_ph, cos_t, eta) : 1;
  const bool reflects = u[2] < reflectance;
  const Vec3 n = reflects ? h * (2 * cos_ph) - p : h * (cos_ph / eta - cos_t) - p * (1 / eta);
  const float cos_n = reflects ? n.z : -n.z;
  if (cos_n < kMinCosine) return {};
  const float stretched_p = ggx.stretched_length(p), stretched_n = ggx.stretched_length(n);
  const float g1_p = smith_g1_over_cos(p.z, stretched_p), g1_n = smith_g1_over_cos(cos_n, stretched_n);
  const float weight = smith_g2_over_g1(p.z, stretched_p, cos_n, stretched_n);
  BsdfSample s;
  s.next = {n.x, n.y, turn(previous, n.z)};
  if (reflects) {
    const float shared = 0.25f * reflectance * ggx.d(h);
    s.weight = Rgb(weight);
    s.density = shared * g1_p;
    s.density_reverse = shared * g1_n;
  } else {
    // |p.h + eta n.h| = |cos_ph - eta cos_t|, the difference of their squares by Snell's law
    const float half_length = (1 - eta) * (1 + eta) / (cos_ph + eta * cos_t);
    const float shared = (1 - reflectance) * ggx.d(h) * cos_ph * cos_t / sqr(half_length);
    s.weight = Rgb(weight * radiance_scale(mode, eta));
    s.density = shared * eta * eta * g1_p;
    s.density_reverse = shared * g1_n;
  }
  return s;
}

// What is scattered more than once: x of it goes to the other side. For f over the squared index to be symmetric x has
// to go with the other side's squared index times its mean loss; by how much is set by what a smooth boundary
// transmits of diffuse light, both sides together.
struct BoundaryLoss {
  Ggx ggx;
  BoundaryAlbedo::Eta here, there;  // seen from the side of previous, and from the other
  float mean, other_mean, x, other_x;

  BoundaryLoss(const Ggx& g, float eta) : ggx(g), here(BoundaryAlbedo::at(eta)), there(here.reciprocal()) {
    const BoundaryAlbedo& albedo = BoundaryAlbedo::get();
    const float alpha = isotropic_alpha(ggx, Vec3(0, 0, 1));
    mean = 1 - albedo.all_mean(alpha, here);
    other_mean = 1 - albedo.all_mean(alpha, there);
    const float to = eta * eta * other_mean, back = mean, both = to + back;
    const float transmitted = 2 - albedo.reflected_mean(0, here) - albedo.reflected_mean(0, there);
    const float scale = both > 0 ? std::min(transmitted / both, 1 / std::max(to, back)) : 0;
    x = to * scale;
    other_x = back * scale;
  }

  // v is on the side of previous where its z is positive.
  float of(const Vec3& v) const {
    const float alpha = isotropic_alpha(ggx, v);
    return std::clamp(1 - BoundaryAlbedo::get().all(alpha, std::fabs(v.z), v.z > 0 ? here : there), 0.0f, 1.0f);
  }
};

// The lobe for one direction: f, and the chances and densities of sampling it from either.
struct LossLobe {
  float f, chance, chance_reverse, density, density_reverse;

  LossLobe(const BoundaryLoss& loss, float eta, const Vec3& p, const Vec3& n, TransportMode mode)
      : chance(loss.of(p)), chance_reverse(loss.of(n)) {
    const bool reflects = n.z > 0;
    const float part = reflects ? 1 - loss.x : loss.x, part_reverse = reflects ? 1 - loss.x : loss.other_x;
    f = part * compensation(chance, chance_reverse, reflects ? loss.mean : loss.other_mean);
    if (!reflects) f *= radiance_scale(mode, eta);
    density = part * std::fabs(n.z) * kInvPi;
    density_reverse = part_reverse * p.z * kInvPi;
  }
};

Boundary boundary_of(const Material& m) { return {m.ior, Ggx(m), m.is_smooth(), m.single_scattering}; }

BsdfValue evaluate_dielectric(const Material& material, const Rgb&, const Vec3& previous, const Vec3& next,
                              TransportMode mode) {
  return evaluate(boundary_of(material), previous, next, mode);
}

BsdfSample sample_dielectric(const Material& material, const Rgb&, const Vec3& previous, TransportMode mode,
                             const float u[3]) {
  return sample(boundary_of(material), previous, mode, u);
}

bool is_dirac(const Material& m) { return m.is_smooth() || m.is_index_matched(); }

}  // namespace

BsdfValue evaluate(const Boundary& boundary, const Vec3& previous, const Vec3& next, TransportMode mode) {
  if (boundary.smooth || boundary.is_index_matched()) return {};
  const Vec3 p(previous.x, previous.y, std::fabs(previous.z));
  const Vec3 n(next.x, next.y, turn(previous, next.z));
  if (p.z < kMinCosine || std::fabs(n.z) < kMinCosine) return {};
  const Ggx& ggx = boundary.ggx;
  const float eta = previous.z < 0 ? 1 / boundary.ior : boundary.ior;
  BsdfValue v;
  if (n.z < 0) {
    v = refract_at_microfacets(ggx, eta, p, n, mode);
  } else {
    const MicrofacetReflection r = reflect_at_microfacets(ggx, p, n);
    const float cos2_t = refracted_cosine_squared(r.cos_h, eta);
    const float reflectance = cos2_t > 0 ? fresnel_dielectric(r.cos_h, std::sqrt(cos2_t), eta) : 1;
    v = {Rgb(reflectance * r.f), reflectance * r.density, reflectance * r.density_reverse};
  }
  if (boundary.single_scattering) return v;
  const LossLobe lobe(BoundaryLoss(ggx, eta), eta, p, n, mode);
  v.f += Rgb(lobe.f);
  v.density += lobe.chance * (lobe.density - v.density);
  v.density_reverse += lobe.chance_reverse * (lobe.density_reverse - v.density_reverse);
  return v;
}

BsdfSample sample(const Boundary& boundary, const Vec3& previous, TransportMode mode, const float u[3]) {
  if (std::fabs(previous.z) < kMinCosine) return {};
  if (boundary.is_index_matched()) return pass_straight(previous);
  const float index_p = previous.z < 0 ? boundary.ior : 1, index_n = previous.z < 0 ? 1 : boundary.ior;
  const float eta = index_n / index_p;
  const Ggx& ggx = boundary.ggx;
  if (boundary.smooth) return sample_smooth(previous, index_p, index_n, mode, u[2]);
  if (boundary.single_scattering) return sample_rough(ggx, previous, eta, mode, u);
  const BoundaryLoss loss(ggx, eta);
  const Vec3 p(previous.x, previous.y, std::fabs(previous.z));
  const float chance = loss.of(p);
  if (u[2] < chance) {
    const bool transmits = u[2] < chance * loss.x;
    const Vec3 n = sample_cosine_hemisphere(u[0], u[1]);
    const Vec3 next(n.x, n.y, turn(previous, transmits ? -n.z : n.z));
    return sampled(next, evaluate(boundary, previous, next, mode));
  }
  const float rest[3] = {u[0], u[1], std::min((u[2] - chance) / (1 - chance), 0x1.fffffep-1f)};
  const BsdfSample s = sample_rough(ggx, previous, eta, mode, rest);
  if (!(s.density > 0)) return {};
  const LossLobe lobe(loss, eta, p, Vec3(s.next.x, s.next.y, turn(previous, s.next.z)), mode);
  return with_lobe(s, Rgb(lobe.f), lobe.chance, lobe.chance_reverse, lobe.density, lobe.density_reverse);
}

const MaterialKind kDielectricKind{evaluate_dielectric, sample_dielectric, is_dirac, always, is_dirac};

}  // namespace bdpt
