// SPDX-License-Identifier: Apache-2.0
#include "ray_log.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>

#include "render/float_mode.h"

namespace bdpt_benchmark {
namespace {

constexpr std::size_t kChunk = 4096;

std::size_t chunks(const std::vector<bdpt::Ray>& rays) { return (rays.size() + kChunk - 1) / kChunk; }

}  // namespace

void RayLog::record(const bdpt::Ray* rays, std::size_t count, bool shadow) {
  const std::lock_guard lock(mutex_);
  std::vector<bdpt::Ray>& log = shadow ? shadow_ : closest_;
  log.insert(log.end(), rays, rays + count);
}

double RayLog::replay(const bdpt::Scene& scene, bdpt::Executor& executor) const {
  const std::size_t closest_chunks = chunks(closest_);
  const auto begin = std::chrono::steady_clock::now();
  executor.run(static_cast<std::uint32_t>(closest_chunks + chunks(shadow_)), [&](std::uint32_t i) {
    const bdpt::FloatMode mode;
    const bool shadow = i >= closest_chunks;
    const std::vector<bdpt::Ray>& rays = shadow ? shadow_ : closest_;
    const std::size_t first = (shadow ? i - closest_chunks : i) * kChunk;
    const std::size_t count = std::min(kChunk, rays.size() - first);
    if (shadow) {
      std::array<std::uint8_t, kChunk> blocked;
      scene.rays().occluded(rays.data() + first, blocked.data(), count);
    } else {
      thread_local std::vector<bdpt::Hit> hits(kChunk);
      scene.rays().intersect(rays.data() + first, hits.data(), count);
    }
  });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace bdpt_benchmark
