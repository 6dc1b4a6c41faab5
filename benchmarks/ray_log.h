// The rays of a render, and what Embree alone needs for them: the limit a render is measured against.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "render/executor.h"
#include "scene/scene.h"
#include "transport/engine.h"

namespace bdpt_benchmark {

class RayLog final : public bdpt::RayRecorder {
 public:
  void record(const bdpt::Ray* rays, std::size_t count, bool shadow) override;

  // Traces all of them, in the order in which they were recorded, in full packets on the executor's threads.
  // Returns seconds.
  double replay(const bdpt::Scene& scene, bdpt::Executor& executor) const;

  std::size_t size() const { return closest_.size() + shadow_.size(); }

 private:
  std::mutex mutex_;
  std::vector<bdpt::Ray> closest_, shadow_;
};

}  // namespace bdpt_benchmark
