// What GGX microfacets scatter more than once, as a diffuse lobe that gives back what single scattering loses (Kulla
// and Conty 2017): f = (1 - E(p)) (1 - E(n)) / (pi (1 - mean E)), E the albedo of single scattering.
#pragma once

#include "material/albedo.h"
#include "material/fresnel.h"

namespace bdpt {

inline float compensation(float loss_p, float loss_n, float mean_loss) {
  return mean_loss > 1e-7f ? kInvPi * loss_p * loss_n / mean_loss : 0;
}

// Of anisotropic surfaces the albedo is known from isotropic ones, about: less is given back, so that it is not too
// much.
inline float sure_part(const Ggx& ggx) {
  return 1 - 0.15f * std::fabs(ggx.alpha_u - ggx.alpha_v) / (ggx.alpha_u + ggx.alpha_v);
}

// Of a surface that reflects all light.
struct MetalLoss {
  float p, n, mean;

  MetalLoss(const Ggx& ggx, const Vec3& previous, const Vec3& next)
      : MetalLoss(ggx, of(ggx, previous), of(ggx, next)) {}
  MetalLoss(const Ggx& ggx, float loss_p, float loss_n) : p(loss_p), n(loss_n) {
    const Vec3 up(0, 0, 1);
    mean = (1 - MetalAlbedo::get().all_mean(isotropic_alpha(ggx, up))) * sure_part(ggx);
  }

  static float of(const Ggx& ggx, const Vec3& v) {
    const float loss = 1 - MetalAlbedo::get().all(isotropic_alpha(ggx, v), std::fabs(v.z));
    return std::clamp(loss * sure_part(ggx), 0.0f, 1.0f);
  }

  // Reflectances of two and more times, by the mean Fresnel reflectance.
  Rgb f(const Rgb& fresnel_mean) const {
    const float lobe = compensation(p, n, mean), kept = 1 - mean;
    const auto channel = [&](float m) { return lobe * m * m * kept / (1 - m * mean); };
    return {channel(fresnel_mean.r), channel(fresnel_mean.g), channel(fresnel_mean.b)};
  }
};

// Schlick's mean with the reflectance at normal incidence.
inline Rgb schlick_mean(const Rgb& f0) { return f0 * (1 - kSchlickMean) + Rgb(kSchlickMean); }
inline Rgb fresnel_conductor_mean(const Rgb& eta, const Rgb& k) {
  return schlick_mean({fresnel_conductor_normal(eta.r, k.r), fresnel_conductor_normal(eta.g, k.g),
                       fresnel_conductor_normal(eta.b, k.b)});
}

// A sample with more f for its direction, and another lobe's densities mixed in: the chances are those of the other.
inline BsdfSample with_lobe(BsdfSample s, const Rgb& f, float chance, float chance_reverse, float density,
                            float density_reverse) {
  if (!(s.density > 0)) return s;
  const Rgb own = s.weight * s.density;
  s.density += chance * (density - s.density);
  s.density_reverse += chance_reverse * (density_reverse - s.density_reverse);
  s.weight = (own + f * std::fabs(s.next.z)) * (1 / s.density);
  return s;
}

}  // namespace bdpt
