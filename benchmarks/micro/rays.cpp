// Ray queries, for one packet of 16 and for 4096 rays at once, in the scene that needs no file.
//
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <vector>

#include "render/float_mode.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"
#include "scene_set.h"

namespace {

constexpr std::uint32_t kRays = 1 << 16;

const bdpt::Scene& scene() {
  static bdpt_tool::Diagnostics diagnostics;
  static const bdpt_benchmark::LoadedScene loaded = bdpt_benchmark::load_scene({"built-in", ""}, 256, 1, diagnostics);
  return *loaded.scene;
}

// Incoherent: from anywhere within the box, in any direction.
std::vector<bdpt::Ray> rays(float tmax) {
  std::vector<bdpt::Ray> all;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const bdpt::Four p = bdpt::independent4({1, i}, 0), d = bdpt::independent4({2, i}, 0);
    const bdpt::Vec3 origin(1.9f * p[0] - 0.95f, 1.9f * p[1] + 0.05f, 1.9f * p[2] - 0.95f);
    all.push_back({origin, tmax, bdpt::sample_sphere(d[0], d[1])});
  }
  return all;
}

void intersect(benchmark::State& state) {
  const bdpt::FloatMode mode;
  const auto all = rays(1e30f);
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<bdpt::Hit> hits(count);
  std::size_t first = 0;
  for (auto _ : state) {
    scene().rays().intersect(all.data() + first, hits.data(), count);
    benchmark::ClobberMemory();
    first = (first + count) % kRays;
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(intersect)->Arg(16)->Arg(4096);

void occluded(benchmark::State& state) {
  const bdpt::FloatMode mode;
  const auto all = rays(1);
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<std::uint8_t> blocked(count);
  std::size_t first = 0;
  for (auto _ : state) {
    scene().rays().occluded(all.data() + first, blocked.data(), count);
    benchmark::ClobberMemory();
    first = (first + count) % kRays;
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(occluded)->Arg(16)->Arg(4096);

}  // namespace
