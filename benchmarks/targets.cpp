// SPDX-License-Identifier: Apache-2.0
#include "targets.h"

namespace bdpt_benchmark {
namespace {

// pbrt-v4's bdpt on two threads of the same machine: the grey veach-bidir, 256 x 256, k = 6, 16 spp.
constexpr double kPbrtSamplesPerSecond = 29e3;
constexpr double kPbrtRelativeVariance = 0.043;
constexpr double kPbrtPasses = 16;

}  // namespace

std::optional<Verdict> judge_replay(const SceneResult& scene, const IntegratorResult& result) {
  const bool set =
      (scene.name == "veach-bidir" || scene.name == "veach-ajar") && (result.name == "path" || result.name == "bdpt");
  if (!set) return std::nullopt;
  return Verdict{"replay_ratio", result.replay_ratio, 2, true};
}

std::optional<Verdict> judge_cost(const SceneResult&, const IntegratorResult& result) {
  if (result.name != "bdpt") return std::nullopt;
  return Verdict{"cost", result.cost, 3, true};
}

std::optional<Verdict> judge_scaling(const Results& results, const IntegratorResult& result) {
  if (results.setting.threads != 2 || results.setting.cores < 2) return std::nullopt;
  return Verdict{"scaling", result.scaling, 1.9, false};
}

std::optional<Verdict> judge_efficiency(const SceneResult& scene, const IntegratorResult& result) {
  if (scene.name != "veach-bidir" || result.name != "bdpt") return std::nullopt;
  const double seconds = kPbrtPasses * scene.width * scene.height / kPbrtSamplesPerSecond;
  return Verdict{"efficiency_over_pbrt", result.efficiency * kPbrtRelativeVariance * seconds, 10, false};
}

Verdict judge_memory(const SceneResult& scene) { return {"memory", scene.memory.used / scene.memory.allowed, 1, true}; }

}  // namespace bdpt_benchmark
