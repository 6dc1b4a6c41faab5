// SPDX-License-Identifier: Apache-2.0
#include "pbrt/spectra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace bdpt_tool {
namespace {

struct Metal {
  const char* name;
  Rgb eta, k;
};

// Complex indices weighed to linear sRGB.
constexpr std::array<Metal, 4> kMetals = {{
    {"Ag", {0.155265f, 0.116723f, 0.138381f}, {4.828343f, 3.122225f, 2.147050f}},
    {"Al", {1.657460f, 0.880369f, 0.521229f}, {9.223870f, 6.269523f, 4.837001f}},
    {"Au", {0.143119f, 0.374957f, 1.442479f}, {3.983160f, 2.385721f, 1.603215f}},
    {"Cu", {0.200438f, 0.924033f, 1.102212f}, {3.912949f, 2.452848f, 2.142188f}},
}};

constexpr std::array<std::pair<const char*, float>, 7> kGlasses = {{
    {"glass-BK7", 1.5168f},
    {"glass-BAF10", 1.6700f},
    {"glass-FK51A", 1.4866f},
    {"glass-LASF9", 1.8503f},
    {"glass-SF5", 1.6727f},
    {"glass-SF10", 1.7283f},
    {"glass-SF11", 1.7847f},
}};

constexpr double kFirst = 380, kStep = 10;  // nanometres
constexpr std::size_t kCount = 41;

// CIE illuminant D65. Source: CIE 15.
constexpr std::array<double, kCount> kD65 = {
    49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923,
    108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880, 88.6856,
    90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091,
    74.3490, 61.6040, 69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828};

double lobe(double x, double mean, double below, double above) {
  const double t = (x - mean) / (x < mean ? below : above);
  return std::exp(-t * t / 2);
}

// The CIE 1931 observer. Source: Wyman, Sloan and Shirley (2013), the fit by several lobes.
std::array<double, 3> observer(double x) {
  return {1.056 * lobe(x, 599.8, 37.9, 31.0) + 0.362 * lobe(x, 442.0, 16.0, 26.7) - 0.065 * lobe(x, 501.1, 20.4, 26.2),
          0.821 * lobe(x, 568.8, 46.9, 40.5) + 0.286 * lobe(x, 530.9, 16.3, 31.1),
          1.217 * lobe(x, 437.0, 11.8, 36.0) + 0.681 * lobe(x, 459.0, 26.0, 13.8)};
}

// Linear Rec.709 of what is f(i, wavelength) at each sample.
std::array<double, 3> rgb_of(const std::function<double(std::size_t, double)>& f) {
  std::array<double, 3> xyz = {};
  for (std::size_t i = 0; i < kCount; ++i) {
    const double wavelength = kFirst + kStep * static_cast<double>(i);
    const auto weights = observer(wavelength);
    for (std::size_t c = 0; c < 3; ++c) xyz[c] += weights[c] * f(i, wavelength);
  }
  const auto [x, y, z] = xyz;
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

double value_at(const Samples& samples, double wavelength) {
  if (wavelength <= samples[0]) return samples[1];
  for (std::size_t i = 2; i < samples.size(); i += 2) {
    if (wavelength > samples[i]) continue;
    const double t = (wavelength - samples[i - 2]) / (samples[i] - samples[i - 2]);
    return (1 - t) * samples[i - 1] + t * samples[i + 1];
  }
  return samples.back();
}

Rgb of_luminance_one(std::array<double, 3> rgb) {
  for (double& x : rgb) x = std::max(x, 0.0);
  const double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  if (!(luminance > 0)) return {};
  return {static_cast<float>(rgb[0] / luminance), static_cast<float>(rgb[1] / luminance),
          static_cast<float>(rgb[2] / luminance)};
}

}  // namespace

std::optional<Rgb> named_metal(const std::string& name) {
  for (const Metal& metal : kMetals) {
    const std::string prefix = std::string("metal-") + metal.name;
    if (name == prefix + "-eta") return metal.eta;
    if (name == prefix + "-k") return metal.k;
  }
  return std::nullopt;
}

std::optional<float> named_glass(const std::string& name) {
  for (const auto& [glass, index] : kGlasses) {
    if (name == glass) return index;
  }
  return std::nullopt;
}

std::optional<Rgb> named_illuminant(const std::string& name) {
  if (name == "stdillum-D65") return Rgb{1, 1, 1};
  if (name == "stdillum-A") return black_body(2856);
  return std::nullopt;
}

bool are_samples(const Samples& samples) {
  if (samples.empty() || samples.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!std::isfinite(samples[i]) || (i >= 2 && i % 2 == 0 && !(samples[i] > samples[i - 2]))) return false;
  }
  return true;
}

Rgb reflected(const Samples& samples) {
  static const std::array<double, 3> white = rgb_of([](std::size_t i, double) { return kD65[i]; });
  const auto rgb = rgb_of([&](std::size_t i, double x) { return kD65[i] * value_at(samples, x); });
  Rgb result;
  for (std::size_t c = 0; c < 3; ++c) result[c] = static_cast<float>(std::max(rgb[c] / white[c], 0.0));
  return result;
}

Rgb emitted(const Samples& samples) {
  return of_luminance_one(rgb_of([&](std::size_t, double x) { return value_at(samples, x); }));
}

// Planck's law, but for its scale.
Rgb black_body(double kelvin) {
  const auto radiance = [&](std::size_t, double nanometres) {
    const double x = nanometres / 560;
    return 1 / (x * x * x * x * x * std::expm1(1.438776877e7 / (nanometres * kelvin)));
  };
  return of_luminance_one(rgb_of(radiance));
}

}  // namespace bdpt_tool
