// Figures with their standard errors, from renders with independent seeds.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "variance.h"

namespace bdpt_experiments {

struct Estimate {
  double value = 0, error = 0;
};

// The jackknife over n turns: of(i) is the figure, positive, without turn i, of(n) that of all. The error is that of
// the logarithm, times the value.
Estimate jackknife(std::size_t n, const std::function<double(std::size_t without)>& of);

// var / (mean² + 0.01 M²), averaged over the pixels (variance.h), of all images but one; one past the last: of all.
// Mean and M are those of the reference.
double relative_variance(const std::vector<std::vector<float>>& images, std::size_t without,
                         const bdpt_benchmark::ImageVariance& reference);

bdpt_benchmark::ImageVariance reference_of(const std::vector<std::vector<float>>& images);

// "12.3 ± 0.4": one digit of the error, two where it begins with 1; without one, three digits of the value.
std::string text(const Estimate& estimate);

}  // namespace bdpt_experiments
