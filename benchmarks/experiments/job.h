// One render: a variant on a stage, with a seed of its own.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "image.h"
#include "stage.h"
#include "variant.h"

namespace bdpt_experiments {

class Job {
 public:
  Job(const Stage& stage, const Variant& variant, std::uint32_t max_edges, std::uint64_t seed,
      std::uint32_t pyramid_edges = 0);

  // Returns the processor time of all threads, divided by the threads.
  double advance(std::uint64_t passes);

  const bdpt_film* film() const { return film_.get(); }
  bdpt_tool::Image color() const;
  bdpt_render_stats stats() const;
  bdpt_technique_stats technique(std::uint32_t s, std::uint32_t t) const;

 private:
  const Stage& stage_;
  Variant variant_;
  bdpt_tool::Film film_;
  bdpt_tool::Render render_;
};

// The mean of red, green and blue of every pixel.
std::vector<float> grey(const bdpt_tool::Image& image);

}  // namespace bdpt_experiments
