// SPDX-License-Identifier: Apache-2.0
#include "estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bdpt_experiments {
namespace {

std::string fixed(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  return buffer;
}

}  // namespace

Estimate jackknife(std::size_t n, const std::function<double(std::size_t)>& of) {
  std::vector<double> logs(n);
  double mean = 0;
  for (std::size_t i = 0; i < n; ++i) mean += logs[i] = std::log(of(i));
  mean /= double(n);
  double sum = 0;
  for (const double x : logs) sum += (x - mean) * (x - mean);
  const double value = of(n);
  return {value, value * std::sqrt(sum * double(n - 1) / double(n))};
}

double relative_variance(const std::vector<std::vector<float>>& images, std::size_t without,
                         const bdpt_benchmark::ImageVariance& reference) {
  bdpt_benchmark::ImageVariance variance;
  for (std::size_t i = 0; i < images.size(); ++i)
    if (i != without) variance.add(images[i]);
  return variance.relative_to(reference);
}

bdpt_benchmark::ImageVariance reference_of(const std::vector<std::vector<float>>& images) {
  bdpt_benchmark::ImageVariance reference;
  for (const auto& image : images) reference.add(image);
  return reference;
}

std::string text(const Estimate& e) {
  if (!std::isfinite(e.value) || !std::isfinite(e.error)) return "–";
  if (e.value == 0 && e.error == 0) return "0";
  const double finest = std::abs(e.value) / 500;  // no more than three digits of the value, or four
  const double scale = e.error > 0 ? std::max(e.error / 1.5, finest) : std::abs(e.value) / 100;
  const int decimals = std::clamp(-int(std::floor(std::log10(scale))), 0, 6);
  return fixed(e.value, decimals) + (e.error > 0 ? " ± " + fixed(e.error, decimals) : "");
}

}  // namespace bdpt_experiments
