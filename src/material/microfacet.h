// The GGX distribution of microfacet normals with Smith's masking and shadowing. Directions are on the side z > 0
// unless said otherwise; all functions are even in each coordinate but for the visible normals.
#pragma once

#include "material/material.h"

namespace bdpt {

// Directions closer to the plane of the surface count as in it and scatter nothing: there f has no finite value.
inline constexpr float kMinCosine = 1e-6f;

struct Ggx {
  float alpha_u, alpha_v;
  float inverse_u, inverse_v;  // of the alphas

  // Below 1e-4 the rounding of float directions is wider than the lobe.
  explicit Ggx(const Material& m) : Ggx(m.alpha_u, m.alpha_v) {}
  Ggx(float u, float v)
      : alpha_u(std::max(u, 1e-4f)), alpha_v(std::max(v, 1e-4f)), inverse_u(1 / alpha_u), inverse_v(1 / alpha_v) {}

  // D for a vector of any length, homogeneous of degree -4: D of the unit vector is d(h) |h|^4. Heitz 2014, eq. 85.
  float d(const Vec3& h) const {
    const float q = sqr(h.x * inverse_u) + sqr(h.y * inverse_v) + sqr(h.z);
    return kInvPi * inverse_u * inverse_v / (q * q);
  }

  // |cos| (1 + 2 Lambda), Heitz 2014, eq. 72 and 86: the length of v once the surface is stretched to alpha = 1.
  float stretched_length(const Vec3& v) const { return std::sqrt(sqr(alpha_u * v.x) + sqr(alpha_v * v.y) + sqr(v.z)); }

  // A normal h visible from v, with density D G1 v.h / cos v (Dupuy and Benyoub 2023, spherical caps; the sums are
  // arranged so that nothing cancels).
  Vec3 sample_visible(const Vec3& v, float u0, float u1) const {
    const Vec3 w = unit(Vec3(alpha_u * v.x, alpha_v * v.y, v.z));
    const float phi = kTwoPi * u0;
    const float depth = u1 * (1 + w.z);  // 1 - z of the point on the cap
    const float sin_theta = safe_sqrt(depth * (2 - depth));
    const float x = sin_theta * std::cos(phi) + w.x;
    const float y = sin_theta * std::sin(phi) + w.y;
    return unit(Vec3(alpha_u * x, alpha_v * y, (1 - u1) * (1 + w.z)));
  }
};

// Smith's G1 over the cosine: 2 / (cos + stretched length). Heitz 2014, eq. 43.
inline float smith_g1_over_cos(float cosine, float stretched) { return 2 / (cosine + stretched); }

// Smith's height-correlated G2 = 1 / (1 + Lambda + Lambda') over both cosines. Heitz 2014, eq. 99; taken for directions
// on opposite sides, too.
inline float smith_g2_over_cosines(float cos_a, float stretched_a, float cos_b, float stretched_b) {
  return 2 / (cos_a * stretched_b + cos_b * stretched_a);
}

// G2 / G1, the weight of a sampled visible normal.
inline float smith_g2_over_g1(float cos_previous, float stretched_previous, float cos_next, float stretched_next) {
  return cos_next * (cos_previous + stretched_previous) /
         (cos_next * stretched_previous + cos_previous * stretched_next);
}

// Reflection at the microfacets, the Fresnel reflectance left out. Walter et al. 2007, eq. 20, and the density of
// visible normals, D G1 |v.h| / |cos v| (Heitz 2018, eq. 3), over the reflection's 4 |v.h|.
struct MicrofacetReflection {
  float cos_h;  // of both directions with the microfacet normal
  float f, density, density_reverse;
};

inline MicrofacetReflection reflect_at_microfacets(const Ggx& ggx, const Vec3& previous, const Vec3& next) {
  const float cos_p = std::fabs(previous.z), cos_n = std::fabs(next.z);
  const float stretched_p = ggx.stretched_length(previous), stretched_n = ggx.stretched_length(next);
  const Vec3 h = previous + next;
  const float h2 = length_squared(h);
  const float quarter_d = 0.25f * ggx.d(h) * h2 * h2;
  return {0.5f * std::sqrt(h2), quarter_d * smith_g2_over_cosines(cos_p, stretched_p, cos_n, stretched_n),
          quarter_d * smith_g1_over_cos(cos_p, stretched_p), quarter_d * smith_g1_over_cos(cos_n, stretched_n)};
}

}  // namespace bdpt
