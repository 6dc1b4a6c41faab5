#include "lightmap/directional.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bdpt {
namespace {

using std::numbers::pi;
const double kY0 = 0.5 / std::sqrt(pi), kY1 = std::sqrt(3 / (4 * pi));
constexpr double kLobe[3] = {pi, 2 * pi / 3, pi / 4};
// Rec. 709
constexpr double kLuminance[3] = {0.2126, 0.7152, 0.0722};

constexpr int band(int k) { return k == 0 ? 0 : k < 4 ? 1 : 2; }

// A texel's coefficients of irradiance, [k][channel]. All zero, and counted, if one of them is not finite.
struct Moments {
  double e[9][3] = {};

  Moments(const ShTexels& texels, size_t texel, int n, EncodeCounts& counts) {
    const float* first = texels.pixels + texel * texels.texel_stride;
    bool finite = true;
    for (int k = 0; k < n; ++k)
      for (int c = 0; c < 3; ++c) {
        const float v = first[size_t(k) * texels.plane_stride + size_t(c)];
        finite &= std::isfinite(v);
        e[k][c] = texels.kind == ShKind::Radiance ? kLobe[band(k)] * double(v) : double(v);
      }
    if (finite) return;
    ++counts.not_finite;
    for (auto& k : e)
      for (double& v : k) v = 0;
  }
  double luminance(int k) const { return kLuminance[0] * e[k][0] + kLuminance[1] * e[k][1] + kLuminance[2] * e[k][2]; }
};

// v of E0 (1 + 2 v.n) for the luminance, in x, y, z, no longer than 1: light from one direction d has v = d. Longer
// ones would make E negative somewhere that light can come from; only noise has them.
struct Direction {
  double v[3] = {}, length = 0;
  bool clipped = false;

  explicit Direction(const Moments& m) {
    const double first[3] = {m.luminance(3), m.luminance(1), m.luminance(2)};
    const double norm = std::hypot(first[0], first[1], first[2]);
    if (norm == 0) return;
    for (int i = 0; i < 3; ++i) v[i] = first[i] / norm;
    const double l0 = m.luminance(0);
    if (l0 > 0) length = kY1 * norm / (2 * kY0 * l0);
    // Rounding may lengthen what is exactly 1.
    clipped = !(l0 > 0) || length > 1 + 1e-5;
    length = std::min(length, 1.0);
  }
};

// Counts a texel whose values are clipped: already, or by the range of a float.
void write(const double* values, uint32_t n, bool clipped, float*& out, EncodeCounts& counts) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  for (uint32_t i = 0; i < n; ++i) {
    const double v = std::clamp(values[i], -kLargest, kLargest);
    clipped |= v != values[i];
    *out++ = float(v);
  }
  counts.clipped += clipped;
}

}  // namespace

EncodeCounts encode_dominant(const ShTexels& texels, float* out) {
  EncodeCounts counts;
  for (size_t i = 0; i < texels.count; ++i) {
    const Moments m(texels, i, 4, counts);
    const Direction d(m);
    double values[kDominantFloats];
    for (int c = 0; c < 3; ++c)
      values[c] = kY0 * m.e[0][c] + kY1 * (m.e[3][c] * d.v[0] + m.e[1][c] * d.v[1] + m.e[2][c] * d.v[2]);
    for (int k = 0; k < 3; ++k) values[3 + k] = d.v[k];
    values[6] = d.length;
    write(values, kDominantFloats, d.clipped, out, counts);
  }
  return counts;
}

EncodeCounts encode_mono_sh(const ShTexels& texels, float* out) {
  EncodeCounts counts;
  for (size_t i = 0; i < texels.count; ++i) {
    const Moments m(texels, i, 4, counts);
    const Direction d(m);
    double values[kMonoShFloats];
    for (int c = 0; c < 3; ++c) values[c] = kY0 * m.e[0][c];
    for (int k = 0; k < 3; ++k) values[3 + k] = d.v[k] * d.length;
    write(values, kMonoShFloats, d.clipped, out, counts);
  }
  return counts;
}

EncodeCounts encode_h_basis(const ShTexels& texels, uint32_t functions, float* out) {
  // Integrals over the hemisphere of H_i Y_k: H = 1/sqrt(2pi), sqrt(3/2pi) (y, 2z - 1, x), sqrt(15/2pi) (xy,
  // (x^2 - y^2)/2). Those not named are zero.
  const double a = std::sqrt(0.5), b = std::sqrt(3.0 / 8), c = std::sqrt(45.0 / 128), d = std::sqrt(1.0 / 8),
               e = std::sqrt(15.0 / 32);
  EncodeCounts counts;
  for (size_t i = 0; i < texels.count; ++i) {
    const Moments m(texels, i, 9, counts);
    double values[18];
    for (int ch = 0; ch < 3; ++ch) {
      const auto y = [&](int k) { return m.e[k][ch]; };
      const double h[6] = {
          a * y(0) + b * y(2), a * y(1) + c * y(5), d * y(2) + e * y(6), a * y(3) + c * y(7), a * y(4), a * y(8)};
      for (int k = 0; k < 6; ++k) values[3 * k + ch] = h[k];
    }
    write(values, functions * 3, false, out, counts);
  }
  return counts;
}

}  // namespace bdpt
