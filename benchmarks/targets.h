// What the figures should be.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "results.h"

namespace bdpt_benchmark {

struct Verdict {
  std::string figure;
  double value = 0, limit = 0;
  bool at_most = true;
  bool met() const { return at_most ? value <= limit : value >= limit; }
};

// Empty where no target is set for this scene and integrator.
std::optional<Verdict> judge_replay(const SceneResult& scene, const IntegratorResult& result);
std::optional<Verdict> judge_cost(const SceneResult& scene, const IntegratorResult& result);
std::optional<Verdict> judge_scaling(const Results& results, const IntegratorResult& result);
// The efficiency over that of pbrt-v4.
std::optional<Verdict> judge_efficiency(const SceneResult& scene, const IntegratorResult& result);
Verdict judge_memory(const SceneResult& scene);

}  // namespace bdpt_benchmark
