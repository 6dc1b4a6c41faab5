// What a render did, counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace bdpt {

struct TransportStats {
  uint64_t samples = 0, eye_rays = 0, light_rays = 0, shadow_rays = 0, shadow_rays_blocked = 0, connections = 0;
  uint64_t rejected = 0;
  uint64_t shadow_rays_skipped = 0;      // by roulette
  uint64_t mutations = 0, accepted = 0;  // of Markov chains
  // Thread-seconds by stage.
  double start = 0, extend = 0, extend_rays = 0, connect = 0, shadow = 0, accumulate = 0;

  uint64_t rays() const { return eye_rays + light_rays + shadow_rays; }
  void operator+=(const TransportStats& o) {
    samples += o.samples, eye_rays += o.eye_rays, light_rays += o.light_rays, shadow_rays += o.shadow_rays;
    shadow_rays_blocked += o.shadow_rays_blocked, connections += o.connections, rejected += o.rejected;
    mutations += o.mutations, accepted += o.accepted;
    start += o.start, extend += o.extend, extend_rays += o.extend_rays, connect += o.connect, shadow += o.shadow;
    accumulate += o.accumulate, shadow_rays_skipped += o.shadow_rays_skipped;
  }
};

// What one technique (s,t) did.
struct TechniqueStats {
  uint64_t contributions = 0;  // that were not black, before visibility
  uint64_t shadow_rays = 0, shadow_rays_blocked = 0, shadow_rays_skipped = 0;
  double sum = 0, squares = 0;  // of the norms of contributions that arrived

  void operator+=(const TechniqueStats& o) {
    contributions += o.contributions, shadow_rays += o.shadow_rays, shadow_rays_blocked += o.shadow_rays_blocked;
    shadow_rays_skipped += o.shadow_rays_skipped, sum += o.sum, squares += o.squares;
  }
};

// 31 stands for 31 and more.
class TechniqueTable {
 public:
  TechniqueStats& at(uint32_t s, uint32_t t) { return stats_[cap(s) * 32 + cap(t)]; }
  const TechniqueStats& at(uint32_t s, uint32_t t) const { return stats_[cap(s) * 32 + cap(t)]; }
  void operator+=(const TechniqueTable& o) {
    for (size_t i = 0; i < stats_.size(); ++i) stats_[i] += o.stats_[i];
  }

 private:
  static size_t cap(uint32_t i) { return i < 31 ? i : 31; }
  std::array<TechniqueStats, 32 * 32> stats_;
};

}  // namespace bdpt
