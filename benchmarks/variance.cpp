// SPDX-License-Identifier: Apache-2.0
#include "variance.h"

#include <numeric>

namespace bdpt_benchmark {

void ImageVariance::add(const std::vector<float>& image) {
  mean_.resize(image.size());
  squares_.resize(image.size());
  ++images_;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double difference = image[i] - mean_[i];
    mean_[i] += difference / double(images_);
    squares_[i] += difference * (image[i] - mean_[i]);
  }
}

double ImageVariance::image_mean() const {
  return std::accumulate(mean_.begin(), mean_.end(), 0.0) / double(mean_.size());
}

double ImageVariance::relative_to(const ImageVariance& reference) const {
  const std::vector<double>& mean = reference.mean_;
  const double floor = 0.01 * reference.image_mean() * reference.image_mean();
  double sum = 0;
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    const double variance = squares_[i] / double(images_ - 1);
    if (variance > 0) sum += variance / (mean[i] * mean[i] + floor);
  }
  return sum / double(mean_.size());
}

}  // namespace bdpt_benchmark
