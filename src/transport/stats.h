// What a render did, counted.
#pragma once

#include <cstdint>

namespace bdpt {

struct TransportStats {
  uint64_t samples = 0, eye_rays = 0, light_rays = 0, shadow_rays = 0, shadow_rays_blocked = 0, connections = 0;
  uint64_t rejected = 0;
  uint64_t mutations = 0, accepted = 0;  // of Markov chains
  // Thread-seconds by stage.
  double start = 0, extend = 0, extend_rays = 0, connect = 0, shadow = 0, accumulate = 0;

  void operator+=(const TransportStats& o) {
    samples += o.samples, eye_rays += o.eye_rays, light_rays += o.light_rays, shadow_rays += o.shadow_rays;
    shadow_rays_blocked += o.shadow_rays_blocked, connections += o.connections, rejected += o.rejected;
    mutations += o.mutations, accepted += o.accepted;
    start += o.start, extend += o.extend, extend_rays += o.extend_rays, connect += o.connect, shadow += o.shadow;
    accumulate += o.accumulate;
  }
};

}  // namespace bdpt
