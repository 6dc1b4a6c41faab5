// Veach's own plan (10.1): an eye subpath and its light subpath, every prefix with every suffix. With several light
// subpaths to an eye subpath (10.6 turned round) each of them is met.
#include "transport/plan.h"

namespace bdpt {

namespace {

SampleCounts counts(const TransportOptions& options, double) {
  const float n = float(options.light_samples);
  return {.light = n, .connections = n};
}

void connect(Block& block) {
  const Engine& engine = block.engine();
  const EyeSubpaths& eye = block.eye();
  const LightSubpaths& light = block.light();
  const uint32_t n = uint32_t(engine.options.light_samples), max_edges = engine.max_edges();
  if (light.count() == 0) return;
  for (uint32_t sample = 0; sample < eye.count(); ++sample) {
    // From the subpaths' ends to their starts, along the links each vertex has to the one before.
    for (uint32_t i = eye.last[sample]; i != kNoVertex; i = eye.vertices[i].previous_index) {
      const Vertex& z = eye.vertices[i];
      if (z.specular || is_black(z.throughput)) continue;
      for (uint32_t l = sample * n; l < (sample + 1) * n; ++l)
        for (uint32_t j = light.last[l]; j != kNoVertex; j = light.vertices[j].previous_index) {
          const Vertex& y = light.vertices[j];
          if (!y.specular && y.count + z.count - 1 <= max_edges && engine.allows(y.count, z.count))
            block.connect(y, z, sample, float(n), light);
        }
    }
    block.flush_if_full();
  }
}

}  // namespace

extern const Plan kOneToOne;
const Plan kOneToOne = {.name = "one-to-one",
                        .summary = "bidirectional path tracing: an eye subpath meets its own light subpath (Veach)",
                        .serves = serves_all,
                        .counts = counts,
                        .connect = connect};

}  // namespace bdpt
