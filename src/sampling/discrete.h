// A discrete distribution by its cumulative sums; one uniform number chooses, and what is left of it can be used again.
// A guide table (Chen and Asau 1974) says where to look, so that the choice takes constant time on average however many
// there are. Unlike an alias table it leaves the map monotone: neighbouring numbers choose neighbours.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
    guide_.reserve(weights.size());
    uint32_t i = 0;
    for (size_t k = 0; k < weights.size(); ++k) {
      while (cumulative_[i + 1] <= double(k) / double(weights.size())) ++i;
      guide_.push_back(i);
    }
  }
  bool empty() const { return !(total_ > 0); }
  double total() const { return total_; }
  size_t size() const { return cumulative_.empty() ? 0 : cumulative_.size() - 1; }
  float probability(size_t i) const { return float(cumulative_[i + 1] - cumulative_[i]); }
  // Chooses i with its probability, and stretches u, in [0,1), back to [0,1).
  size_t sample(double& u) const {
    if (cumulative_.size() == 2) return 0;
    size_t i = guide_[size_t(u * double(guide_.size()))];
    while (i > 0 && cumulative_[i] > u) --i;  // the table's place is rounded
    while (cumulative_[i + 1] <= u) ++i;
    u = std::min((u - cumulative_[i]) / (cumulative_[i + 1] - cumulative_[i]), 0x1.fffffffffffffp-1);
    return i;
  }

 private:
  std::vector<double> cumulative_;
  std::vector<uint32_t> guide_;
  double total_ = 0;
};

}  // namespace bdpt
