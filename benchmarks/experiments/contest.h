// Variants that take turns on one stage: A B A B, each turn with a seed of its own.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "estimate.h"
#include "job.h"

namespace bdpt_experiments {

struct ContestOptions {
  std::uint32_t max_edges = 0;
  std::size_t turns = 8;        // at least 2
  std::uint64_t passes = 16;    // of the first variant
  bool equal_time = true;       // the others: as many as the first one's time allows; else as many as the first
  std::size_t checkpoints = 1;  // looks at each render: at its end, at half its passes, at a quarter ...
  std::uint32_t pyramid_edges = 0;
};

// A look at the renders of a variant, one in each turn.
struct Checkpoint {
  std::uint64_t passes = 0;
  std::vector<double> seconds;
  std::vector<std::vector<float>> images;  // grey
  // Whose mean and M the relative variance takes.
  std::shared_ptr<const bdpt_benchmark::ImageVariance> reference;
};

struct Contestant {
  Variant variant;
  std::vector<Checkpoint> checkpoints;  // the last is the end of the render
  bdpt_tool::Image picture;             // of the first turn
  std::unique_ptr<Job> first;           // the first turn itself
  bdpt_render_stats stats{};            // of the first turn

  const Checkpoint& end() const { return checkpoints.back(); }
};

// Variants that the library lacks are left out. The first must be there, and measure all the light: a render of its own
// with another seed and as many samples as all turns together is the reference. No variant's own noise may enter it: a
// pixel with a rare bright sample would weigh less for that variant than for the others.
std::vector<Contestant> hold(const Stage& stage, const std::vector<Variant>& variants, const ContestOptions& options);

Estimate relative_variance(const Checkpoint& checkpoint);
// Of whole images; all variants measure the same, unless they lack techniques for some of the light.
Estimate mean(const Checkpoint& checkpoint);
Estimate mean_ratio(const Checkpoint& a, const Checkpoint& b);
double seconds(const Checkpoint& checkpoint);
// The part of the pixels whose means over the turns differ by more than so many standard errors of the difference.
double apart(const Checkpoint& a, const Checkpoint& b, double standard_errors);

// 1 / (relative variance x seconds) of a over that of b.
Estimate efficiency_ratio(const Checkpoint& a, const Checkpoint& b);
// The relative variance of b's samples over that of a's: how many times better one sample of a is.
Estimate sample_ratio(const Checkpoint& a, const Checkpoint& b);

}  // namespace bdpt_experiments
