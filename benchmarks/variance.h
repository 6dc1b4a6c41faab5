// The variance of an image between independent renders.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace bdpt_benchmark {

class ImageVariance {
 public:
  void add(const std::vector<float>& image);

  // var / (mean² + 0.01 M²), averaged over the pixels: var the unbiased sample variance of a pixel, mean its mean, M
  // the mean of the whole image.
  double relative() const { return relative_to(*this); }
  // The same with mean and M of other renders: a variant that seldom finds some light is else measured by what it
  // found.
  double relative_to(const ImageVariance& reference) const;
  // The mean of the whole image.
  double image_mean() const;
  std::size_t pixels() const { return mean_.size(); }
  double mean(std::size_t pixel) const { return mean_[pixel]; }
  // The variance of that mean.
  double mean_variance(std::size_t pixel) const { return squares_[pixel] / (double(images_) - 1) / double(images_); }

 private:
  std::size_t images_ = 0;
  std::vector<double> mean_, squares_;  // Welford's running mean and sum of squared differences
};

}  // namespace bdpt_benchmark
