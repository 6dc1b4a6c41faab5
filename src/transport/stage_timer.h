// Seconds by stage, for the statistics.
#pragma once

#include <chrono>

namespace bdpt {

inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Adds the time it lives to a stage.
class StageTimer {
 public:
  explicit StageTimer(double& total) : total_(total), begin_(seconds_now()) {}
  ~StageTimer() { total_ += seconds_now() - begin_; }

 private:
  double& total_;
  double begin_;
};

}  // namespace bdpt
