// The light vertex cache: every eye vertex meets m of all light vertices of the pass, whichever subpath and length they
// are of, each alike (Davidovic et al. 2014). Veach's 10.6, many eye subpaths to one light subpath, taken to its end.
//
// Of the V vertices of N light subpaths each is met with the chance m / V, so that a technique takes n = m N / V
// samples for each eye subpath. V is not known before; and weights must not depend on the subpaths that they weigh.
// They take the pilot's V / N, the estimate takes the pass's own.
#include "transport/light_pool.h"
#include "transport/plan.h"

namespace bdpt {

namespace {

constexpr int kConnections = 2;

int connections(const TransportOptions& options) {
  return options.connections > 0 ? options.connections : kConnections;
}

SampleCounts counts(const TransportOptions& options, double light_vertices) {
  const float n = float(options.light_samples);
  return {.light = n, .connections = float(connections(options) / std::max(light_vertices, 1e-3))};
}

void connect(Block& block) {
  const Engine& engine = block.engine();
  const LightPool& pool = block.light_pool();
  const int m = connections(engine.options);
  const uint32_t max_edges = engine.max_edges();
  if (pool.vertices() == 0) return;
  const double vertices = double(pool.vertices());
  const float count = float(m * double(pool.subpaths()) / vertices);
  for (uint32_t sample = 0; sample < block.eye().count(); ++sample)
    for (uint32_t i = block.eye().last[sample]; i != kNoVertex; i = block.eye().vertices[i].previous_index) {
      const Vertex& z = block.eye().vertices[i];
      if (z.specular || is_black(z.throughput)) continue;
      const Four u = block.draw_eye(sample, z.count, Purpose::Partner);
      const double start = join(u[0], u[1]);
      for (int k = 0; k < m; ++k) {  // one in each m-th of the pool
        const uint64_t rank = std::min(uint64_t((k + start) / m * vertices), pool.vertices() - 1);
        const LightPool::Entry e = pool.vertex(rank);
        const Vertex& y = *e.vertex;
        if (y.count + z.count - 1 <= max_edges && engine.allows(y.count, z.count))
          block.connect(y, z, sample, count, *e.subpaths);
      }
      block.flush_if_full();
    }
}

}  // namespace

extern const Plan kPooled;
const Plan kPooled = {.name = "pooled",
                      .summary = "every eye vertex meets some of all light vertices of the pass (light vertex cache)",
                      .serves = serves_all,
                      .counts = counts,
                      .connect = connect,
                      .pooled = true,
                      .default_connections = kConnections};

}  // namespace bdpt
