// Veach's own plan (10.1): an eye subpath and its light subpath, every prefix with every suffix. With several light
// subpaths to an eye subpath (10.6 turned round) each of them is met.
#include "transport/plan.h"

namespace bdpt {

namespace {

SampleCounts counts(const TransportOptions& options, double) {
  const float n = float(options.light_samples);
  return {.light = n, .connections = n};
}

}  // namespace

void connect_own(Block& block) {
  const LightSubpaths& light = block.light();
  if (light.count() == 0) return;
  const uint32_t n = uint32_t(block.engine().options.light_samples);
  block.each_eye_vertex([&](const Vertex& z, uint32_t sample) {
    for (uint32_t l = sample * n; l < (sample + 1) * n; ++l)
      for (uint32_t j = light.last[l]; j != kNoVertex; j = light.vertices[j].previous_index) {
        const Vertex& y = light.vertices[j];
        if (y.is_joinable() && block.takes(y.count, z.count, sample)) block.connect(y, z, sample, float(n), light);
      }
  });
}

extern const Plan kOneToOne;
const Plan kOneToOne = {.name = "one-to-one",
                        .summary = "bidirectional path tracing: an eye subpath meets its own light subpath (Veach)",
                        .serves = serves_all,
                        .counts = counts,
                        .connect = connect_own};

}  // namespace bdpt
