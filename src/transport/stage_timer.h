// Seconds by stage, for the statistics.
#pragma once

#include "transport/stats.h"

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

// The same for a stage that may test and add connections meanwhile: without the seconds of those.
class OuterStageTimer {
 public:
  OuterStageTimer(double& total, const TransportStats& stats)
      : total_(total), stats_(stats), begin_(seconds_now() - inner()) {}
  ~OuterStageTimer() { total_ += seconds_now() - inner() - begin_; }

 private:
  double inner() const { return stats_.shadow + stats_.accumulate; }
  double& total_;
  const TransportStats& stats_;
  double begin_;
};

}  // namespace bdpt
