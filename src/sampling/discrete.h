// A discrete distribution by its cumulative sums; one uniform number chooses, and what is left of it can be used again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bdpt {

class Discrete {
 public:
  Discrete() = default;
  explicit Discrete(const std::vector<double>& weights) {
    cumulative_.reserve(weights.size() + 1);
    double sum = 0;
    cumulative_.push_back(0);
    for (double w : weights) cumulative_.push_back(float(sum += w));
    total_ = sum;
    if (sum > 0) {
      // Normalised in double first, so that probabilities do not depend on the scene's scale.
      double running = 0;
      for (size_t i = 0; i < weights.size(); ++i) cumulative_[i + 1] = float((running += weights[i]) / sum);
      cumulative_.back() = 1;
    }
  }
  bool empty() const { return !(total_ > 0); }
  double total() const { return total_; }
  size_t size() const { return cumulative_.empty() ? 0 : cumulative_.size() - 1; }
  float probability(size_t i) const { return cumulative_[i + 1] - cumulative_[i]; }
  // Chooses i with its probability and stretches u back to [0,1).
  size_t sample(float& u) const {
    const auto it = std::upper_bound(cumulative_.begin(), cumulative_.end(), u);
    size_t i = it == cumulative_.begin() ? 0 : size_t(it - cumulative_.begin()) - 1;
    i = std::min(i, size() - 1);
    while (i > 0 && probability(i) == 0) --i;
    const float p = probability(i);
    u = p > 0 ? std::min((u - cumulative_[i]) / p, 0x1.fffffep-1f) : 0;
    return i;
  }

 private:
  std::vector<float> cumulative_;
  double total_ = 0;
};

}  // namespace bdpt
