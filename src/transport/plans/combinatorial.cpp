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
  const Engine& engine = block.engine();
  const LightSubpaths& light = block.light();
  const uint32_t max_edges = engine.max_edges();
  const float met = float(light.count());
  for (uint32_t sample = 0; sample < block.eye().count(); ++sample)
    for (uint32_t i = block.eye().last[sample]; i != kNoVertex; i = block.eye().vertices[i].previous_index) {
      const Vertex& z = block.eye().vertices[i];
      if (z.specular || is_black(z.throughput)) continue;
      for (const Vertex& y : light.vertices)
        if (!y.specular && y.count + z.count - 1 <= max_edges && engine.allows(y.count, z.count))
          block.connect(y, z, sample, met, light);
      block.flush_if_full();
    }
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
