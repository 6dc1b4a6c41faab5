// Directional encodings, derived from moments in spherical harmonics. All say what the irradiance E(n) is for a
// surface with normal n.
//
// Real spherical harmonics, in the order 1; y, z, x; xy, yz, 3z^2 - 1, xz, x^2 - y^2. Ramamoorthi and Hanrahan (2001):
// E(n) = sum A_l c_lm Y_lm(n) with A = pi, 2pi/3, pi/4 and c_lm the coefficients of radiance.
#pragma once

#include "lightmap/encode.h"

namespace bdpt {

enum class ShKind { Radiance, Irradiance };

// Coefficient k of texel i is the colour at pixels[i * texel_stride + k * plane_stride].
struct ShTexels {
  const float* pixels = nullptr;
  size_t count = 0, texel_stride = 0, plane_stride = 0;
  ShKind kind = ShKind::Radiance;
};

// From bands 0 and 1: E(d) as RGB; d, the direction of the luminance's first moment, or zeros; s in [0,1], how much of
// the light comes from there: 0 for an even one, 1 for a single direction. 7 floats.
inline constexpr uint32_t kDominantFloats = 7;
EncodeCounts encode_dominant(const ShTexels& texels, float* out);

// From bands 0 and 1: E0, the mean of E(n) over all n, as RGB, and v, |v| <= 1: E(n) = E0 (1 + 2 v.n). 6 floats.
inline constexpr uint32_t kMonoShFloats = 6;
EncodeCounts encode_mono_sh(const ShTexels& texels, float* out);

// From bands 0 to 2, in a frame whose z is the surface's normal: coefficients of E(n), n.z >= 0, in the first 4 or in
// all 6 functions of the H-basis of Habel and Wimmer (2010), orthonormal on the hemisphere. 3 floats for each.
EncodeCounts encode_h_basis(const ShTexels& texels, uint32_t functions, float* out);

}  // namespace bdpt
