// Every eye vertex meets every light vertex (Pajot et al. 2011), within pools of 64 samples: the yardstick for plans
// that choose among these pairs. The pools are squares of pixels and part of the result: blocks have this size.
#include "transport/plan.h"

namespace bdpt {

namespace {

constexpr uint32_t kPool = 64;

// At the picture's edges pools are smaller. The weights need not know: they must only sum to one.
SampleCounts counts(const TransportOptions& options, double) {
  const float n = float(options.light_samples);
  return {.light = n, .connections = n * float(kPool)};
}

void connect(Block& block) {
  const LightSubpaths& light = block.light();
  const float met = float(light.count());
  block.each_eye_vertex([&](const Vertex& z, uint32_t sample) {
    for (const Vertex& y : light.vertices)
      if (y.is_joinable() && block.allows(y, z)) block.connect(y, z, sample, met, light);
  });
}

}  // namespace

extern const Plan kCombinatorial;
const Plan kCombinatorial = {.name = "combinatorial",
                             .summary = "every pair of eye and light subpaths in pools of 64 (Pajot et al.): slow",
                             .serves = serves_all,
                             .counts = counts,
                             .connect = connect,
                             .block_size = kPool};

}  // namespace bdpt
