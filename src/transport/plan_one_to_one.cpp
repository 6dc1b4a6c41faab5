#include "transport/plan.h"

namespace bdpt {

void plan_one_to_one(Block& block) {
  const Engine& engine = block.engine();
  const SubpathPool& pool = block.pool();
  const uint32_t max_edges = engine.options.max_edges > 0 ? uint32_t(engine.options.max_edges) : ~0u;
  for (uint32_t sample = 0; sample < pool.samples(); ++sample) {
    // The plan runs from the subpaths' ends to their starts, along the links each vertex has to the one before.
    for (uint32_t i = pool.last_eye[sample]; i != kNoVertex; i = pool.eye[i].previous_index) {
      const Vertex& z = pool.eye[i];
      if (z.specular || is_black(z.throughput)) continue;
      if (z.count <= max_edges && engine.allows(1, z.count)) block.connect_to_light(z, sample);
      for (uint32_t j = pool.last_light[sample]; j != kNoVertex; j = pool.light[j].previous_index) {
        const Vertex& y = pool.light[j];
        if (!y.specular && y.count + z.count - 1 <= max_edges && engine.allows(y.count, z.count))
          block.connect(y, z, sample);
      }
    }
    for (uint32_t j = pool.last_light[sample]; j != kNoVertex; j = pool.light[j].previous_index) {
      const Vertex& y = pool.light[j];
      if (!y.specular && y.count <= max_edges && engine.allows(y.count, 1)) block.connect_to_sensor(y, sample);
    }
    if (pool.has_light[sample] && engine.allows(1, 1)) block.connect_start_to_sensor(sample);
    block.flush_if_full();
  }
}

}  // namespace bdpt
