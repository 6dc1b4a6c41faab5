// SPDX-License-Identifier: Apache-2.0
#include "image_metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bdpt_tool {
namespace {

double mean_of_finite(const Image& image) {
  double sum = 0;
  std::uint64_t count = 0;
  for (float x : image.pixels) {
    if (!std::isfinite(x)) continue;
    sum += x;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

double sum_of_variance(const Measured& image) {
  double sum = 0;
  for (float x : image.variance->pixels) {
    if (std::isfinite(x)) sum += x;
  }
  return sum * image.correlation;
}

// The channels of a pixel are taken as fully dependent, which can only make the error greater.
double variance_of_mean(const Measured& image) {
  const double pixels = static_cast<double>(image.color.pixels.size()) / 3;
  return image.variance ? sum_of_variance(image) / 3 / (pixels * pixels) : 0;
}

double filter_value(bdpt_filter filter, double x, double radius) {
  switch (filter) {
    case BDPT_FILTER_BOX:
      return 1;
    case BDPT_FILTER_TENT:
      return radius - x;
    case BDPT_FILTER_GAUSSIAN:
      return std::exp(-2 * x * x) - std::exp(-2 * radius * radius);  // standard deviation 1/2
    case BDPT_FILTER_MITCHELL: {
      const double u = 2 * x / radius;
      return u < 1 ? (7 * u * u * u - 12 * u * u + 16.0 / 3) / 6
                   : (-7.0 / 3 * u * u * u + 12 * u * u - 20 * u + 32.0 / 3) / 6;  // B = C = 1/3
    }
    default: {
      const double phase = std::numbers::pi * (1 + x / radius);
      return 0.35875 - 0.48829 * std::cos(phase) + 0.14128 * std::cos(2 * phase) - 0.01168 * std::cos(3 * phase);
    }
  }
}

}  // namespace

double filter_correlation(bdpt_filter filter, float radius) {
  constexpr int kSteps = 1024;
  double sum = 0, squares = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double value = filter_value(filter, (i + 0.5) / kSteps * radius, radius);
    sum += value;
    squares += value * value;
  }
  const double axis = sum * sum / squares * (2 * radius / kSteps);
  return std::max(1.0, axis * axis);
}

Metrics compare_images(const Measured& a, const Measured& b) {
  Metrics metrics;
  const double mean = mean_of_finite(b.color);
  const double floor = 0.01 * mean * mean;
  std::uint64_t count[3] = {};
  double squares = 0, relative = 0;
  for (std::size_t i = 0; i < a.color.pixels.size(); ++i) {
    const double x = a.color.pixels[i], y = b.color.pixels[i];
    if (!std::isfinite(x) || !std::isfinite(y)) {
      ++metrics.not_finite;
      continue;
    }
    const std::size_t c = i % 3;
    ++count[c];
    metrics.mean_a[c] += x;
    metrics.mean_b[c] += y;
    const double square = (x - y) * (x - y);
    squares += square;
    relative += square == 0 ? 0 : square / (y * y + floor);
  }
  const auto total = static_cast<double>(count[0] + count[1] + count[2]);
  if (total == 0) return metrics;
  metrics.mse = squares / total;
  metrics.relative_mse = relative / total;
  double overall_b = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto n = static_cast<double>(std::max<std::uint64_t>(count[c], 1));
    metrics.mean_a[c] /= n;
    metrics.mean_b[c] /= n;
    metrics.bias[c] = metrics.mean_a[c] - metrics.mean_b[c];
    metrics.overall_bias += metrics.bias[c] / 3;
    overall_b += metrics.mean_b[c] / 3;
  }
  metrics.relative_bias = overall_b != 0 ? metrics.overall_bias / overall_b : 0;
  if (a.variance || b.variance) metrics.bias_error = std::sqrt(variance_of_mean(a) + variance_of_mean(b));
  return metrics;
}

Image difference_image(const Image& a, const Image& b) {
  Image image(a.width, a.height);
  const double mean = std::abs(mean_of_finite(b));
  for (std::size_t i = 0; i + 2 < a.pixels.size(); i += 3) {
    const double grey_a = (a.pixels[i] + a.pixels[i + 1] + a.pixels[i + 2]) / 3;
    const double grey_b = (b.pixels[i] + b.pixels[i + 1] + b.pixels[i + 2]) / 3;
    const double scale = std::abs(grey_b) + 0.1 * mean;
    const double d = scale > 0 ? std::clamp((grey_a - grey_b) / scale, -1.0, 1.0) : 0;
    const auto fade = static_cast<float>(1 - std::abs(std::isfinite(d) ? d : 1));
    image.pixels[i] = d >= 0 ? 1 : fade;
    image.pixels[i + 1] = fade;
    image.pixels[i + 2] = d <= 0 ? 1 : fade;
  }
  return image;
}

}  // namespace bdpt_tool
