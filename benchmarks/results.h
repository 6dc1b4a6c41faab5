// The figures of the table; docs/performance.md defines each.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt_benchmark {

// Shares of all thread-seconds of a render; they add up to one.
struct StageShares {
  double start = 0;
  double extend = 0;  // without the ray queries
  double rays = 0;    // the ray queries of extend
  double connect = 0;
  double shadow = 0;
  double accumulate = 0;
  double rest = 0;  // end of pass, idle threads
};

struct IntegratorResult {
  std::string name;
  double samples_per_second = 0;
  double eye_rays_per_second = 0, light_rays_per_second = 0, shadow_rays_per_second = 0;
  StageShares stages;
  std::uint64_t replayed_rays = 0;
  double replay_ratio = 0;  // seconds of the render over seconds of the replay
  double cost = 0;          // of a sample, in samples of path tracing
  double image_mean = 0;
  double relative_variance = 0;  // at variance_passes samples per pixel
  double variance_seconds = 0;   // for as many
  double efficiency = 0;         // 1 / (relative_variance variance_seconds)
  double scaling = 0;            // seconds on one thread over seconds on all
  double replay_scaling = 0;     // the same of the replay
};

// Bytes.
struct MemoryResult {
  std::uint64_t context_peak = 0;    // all that the library books, film included
  std::uint64_t process_peak = 0;    // VmHWM while building and rendering
  std::uint64_t process_before = 0;  // VmRSS before the scene was read
  std::uint64_t film = 0;
  std::uint64_t embree = 0;  // Embree's structures
  std::uint64_t arrays = 0;  // the scene's meshes and textures
  double used = 0;           // the larger peak, without what was there before and without the film
  double allowed = 0;        // 1.3 (embree + arrays) + 64 MiB
};

struct SceneResult {
  std::string name;
  std::uint32_t width = 0, height = 0;
  std::uint64_t triangles = 0;
  MemoryResult memory;
  std::vector<IntegratorResult> integrators;
};

// The machine and the library, as one line of text each.
struct Setting {
  std::string processor, isa, embree, version;
  std::uint32_t cores = 0, threads = 0;
  bool quick = false;
};

struct Results {
  Setting setting;
  std::vector<SceneResult> scenes;
};

}  // namespace bdpt_benchmark
