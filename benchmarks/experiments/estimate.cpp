// SPDX-License-Identifier: Apache-2.0
#include "estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "variance.h"

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

double relative_variance(const std::vector<std::vector<float>>& images, std::size_t without) {
  bdpt_benchmark::ImageVariance variance;
  for (std::size_t i = 0; i < images.size(); ++i)
    if (i != without) variance.add(images[i]);
  return variance.relative();
}

std::string text(const Estimate& e) {
  if (!std::isfinite(e.value) || !std::isfinite(e.error)) return "–";
  // Two digits of the error, three of a value without one.
  const double scale = e.error > 0 ? e.error : std::abs(e.value) / 10;
  const int decimals = scale > 0 ? std::clamp(1 - int(std::floor(std::log10(scale))), 0, 6) : 0;
  return fixed(e.value, decimals) + (e.error > 0 ? " ± " + fixed(e.error, decimals) : "");
}

}  // namespace bdpt_experiments
