// Reflectance of a smooth boundary for unpolarised light.
#pragma once

#include <cfloat>

#include "math/vec.h"

namespace bdpt {

// Dielectric, from the cosines (>= 0) on both sides of the boundary; eta is the index on the transmitted side over the
// index on the incident side. Depends on the cosines' ratio alone, so both may be scaled by a common factor.
inline float fresnel_dielectric(float cos_i, float cos_t, float eta) {
  if (!(cos_i > 0)) return 1;
  const float r_s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const float r_p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return 0.5f * (r_s * r_s + r_p * r_p);
}

// Cosine of the refracted direction by Snell's law, squared; negative: total internal reflection. In this form it is
// exactly cos_i^2 for eta = 1, at any angle.
inline float refracted_cosine_squared(float cos_i, float eta) {
  return ((eta - 1) * (eta + 1) + cos_i * cos_i) / (eta * eta);
}

// The same for light that comes from outside of the denser medium: eta >= 1, and none is reflected in all.
inline float fresnel_outside(float cos_i, float eta) {
  return fresnel_dielectric(cos_i, safe_sqrt(refracted_cosine_squared(cos_i, eta)), eta);
}

// Conductor, one channel, with the complex index eta + ik over that of the incident side; cos_i in [0,1].
// (eta + ik)^2 - sin^2 = (a + ib)^2, after Born and Wolf, Principles of Optics, 14.2.
inline float fresnel_conductor(float cos_i, float eta, float k) {
  const float cos2 = cos_i * cos_i, sin2 = 1 - cos2;
  const float difference = eta * eta - k * k - sin2;                             // a^2 - b^2
  const float product = eta * k;                                                 // a b
  const float sum = std::sqrt(difference * difference + 4 * product * product);  // a^2 + b^2
  // The larger of a and b comes without cancellation, the other from their product.
  const float larger = std::sqrt(0.5f * (sum + std::fabs(difference)));
  const float a = difference >= 0 ? larger : product / larger;
  const float two_a_cos = 2 * a * cos_i;
  // r_p = r_s (x - y) / (x + y), and so their mean is r_s x / (x + y).
  const float x = cos2 * sum + sin2 * sin2, y = two_a_cos * sin2;
  return std::max(sum + cos2 - two_a_cos, 0.0f) * x / std::max((sum + cos2 + two_a_cos) * (x + y), FLT_MIN);
}

inline Rgb fresnel_conductor(float cos_i, const Rgb& eta, const Rgb& k) {
  return {fresnel_conductor(cos_i, eta.r, k.r), fresnel_conductor(cos_i, eta.g, k.g),
          fresnel_conductor(cos_i, eta.b, k.b)};
}

// Schlick's approximation is f0 + (f90 - f0) times this.
inline float schlick_part(float cosine) {
  const float x = std::clamp(1 - cosine, 0.0f, 1.0f), x2 = x * x;
  return x2 * x2 * x;
}
// Its mean over the cosine-weighted hemisphere.
inline constexpr float kSchlickMean = 1 / 21.0f;

// Of a conductor at normal incidence.
inline float fresnel_conductor_normal(float eta, float k) { return (sqr(eta - 1) + k * k) / (sqr(eta + 1) + k * k); }

}  // namespace bdpt
