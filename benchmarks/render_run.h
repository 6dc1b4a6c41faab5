// One render of a scene, with a film of its own, timed.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "integrator.h"
#include "render/executor.h"
#include "render/render.h"
#include "scene_set.h"

namespace bdpt_benchmark {

struct Timing {
  double seconds = 0;
  bdpt::TransportStats stats;
};

class RenderRun {
 public:
  RenderRun(const LoadedScene& scene, const Integrator& integrator, std::shared_ptr<bdpt::Executor> executor,
            std::uint64_t seed = 0);

  Timing advance(std::uint64_t passes, bdpt::RayRecorder* recorder = nullptr);

  // The mean of red, green and blue of every pixel.
  std::vector<float> grey_image() const;
  std::uint64_t film_bytes() const { return bdpt::Film::bytes_for(film_->desc()); }

 private:
  std::shared_ptr<bdpt::Film> film_;
  bdpt::Render render_;
};

}  // namespace bdpt_benchmark
