// How far one picture is from another.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "bdpt.h"
#include "image.h"

namespace bdpt_tool {

// A picture with what is known of its noise.
struct Measured {
  Image color;
  std::optional<Image> variance;  // of each pixel's value
  // By this factor the variance of the sum of all pixels exceeds the sum of their variances, for neighbours share
  // samples where the filter is wide.
  double correlation = 1;
};

struct Metrics {
  double mse = 0;
  double relative_mse = 0;  // (a - b)² / (b² + 0.01 M²), M the mean of b
  std::array<double, 3> mean_a = {}, mean_b = {};
  std::array<double, 3> bias = {};   // mean of a - b
  double overall_bias = 0;           // over the channels
  double relative_bias = 0;          // over the mean of b
  std::optional<double> bias_error;  // the standard error of overall_bias, where a variance is known
  std::uint64_t not_finite = 0;      // values left out
};

// Both of the same size.
Metrics compare_images(const Measured& a, const Measured& b);

// The correlation factor of a film's filter.
double filter_correlation(bdpt_filter filter, float radius);

// Red where a is brighter than b, blue where it is darker; full colour at a difference as large as b. Display values.
Image difference_image(const Image& a, const Image& b);

}  // namespace bdpt_tool
