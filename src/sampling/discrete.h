// A discrete distribution by its cumulative sums; one uniform number chooses, and what is left of it can be used again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bdpt {

// Two of a stream's 24-bit numbers as one of 48 bits: enough to choose a weak light among strong ones, and then one of
// its triangles.
inline double join(float high, float low) { return double(high) + double(low) * 0x1p-24; }

class Discrete {
 public:
  Discrete() = default;
  explicit Discrete(const std::vector<double>& weights) {
    cumulative_.reserve(weights.size() + 1);
    cumulative_.push_back(0);
    for (double w : weights) cumulative_.push_back(total_ += w);
    if (!(total_ > 0)) return;
    for (double& c : cumulative_) c /= total_;
    cumulative_.back() = 1;
  }
  bool empty() const { return !(total_ > 0); }
  double total() const { return total_; }
  size_t size() const { return cumulative_.empty() ? 0 : cumulative_.size() - 1; }
  float probability(size_t i) const { return float(cumulative_[i + 1] - cumulative_[i]); }
  // Chooses i with its probability and stretches u back to [0,1).
  size_t sample(double& u) const {
    if (cumulative_.size() == 2) return 0;
    const auto it = std::upper_bound(cumulative_.begin(), cumulative_.end(), u);
    size_t i = it == cumulative_.begin() ? 0 : size_t(it - cumulative_.begin()) - 1;
    i = std::min(i, size() - 1);
    while (i > 0 && cumulative_[i + 1] == cumulative_[i]) --i;
    const double p = cumulative_[i + 1] - cumulative_[i];
    u = p > 0 ? std::min((u - cumulative_[i]) / p, 0x1.fffffffffffffp-1) : 0;
    return i;
  }

 private:
  std::vector<double> cumulative_;
  double total_ = 0;
};

}  // namespace bdpt
