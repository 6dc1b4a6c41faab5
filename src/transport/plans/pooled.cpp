// The light vertex cache: every eye vertex meets m of all light vertices of the pass, whichever subpath and length they
// are of, each alike or by importance (Davidovic et al. 2014). Veach's 10.6, many eye subpaths to one light subpath,
// taken to its end.
//
// Of the V vertices of N light subpaths each is met with the chance m / V, so that a technique takes n = m N / V
// samples for each eye subpath. V is not known before; and weights must not depend on the subpaths that they weigh.
// They take the pilot's V / N, the estimate takes the pass's own. With a choice by importance the estimate divides by
// the probability of the vertex that was chosen, and the weights stay as they are, for the same reason: that
// probability depends on all subpaths of the pass, so another technique of the path cannot know it.
#include "transport/light_pool.h"
#include "transport/plan.h"

namespace bdpt {

namespace {

SampleCounts counts(const TransportOptions& options, double light_vertices) {
  const float n = float(options.light_samples);
  return {.light = n, .connections = float(options.connections / std::max(light_vertices, 1e-3))};
}

void connect(Block& block) {
  const LightPool& pool = block.light_pool();
  if (pool.vertices() == 0) return;
  const int m = block.engine().options.connections;
  block.each_eye_vertex([&](const Vertex& z, uint32_t sample) {
    const Four u = block.draw_eye(sample, z.count, Purpose::Partner);
    const double start = join(u[0], u[1]);
    for (int k = 0; k < m; ++k) {  // one in each m-th of all probability
      double one_in;
      const LightPool::Entry y = pool.choose((k + start) / m, one_in);
      if (!block.allows(*y.vertex, z)) continue;
      block.connect(*y.vertex, z, sample, float(m * double(pool.subpaths()) / one_in), *y.subpaths);
    }
  });
}

}  // namespace

extern const Plan kPooled;
const Plan kPooled = {.name = "pooled",
                      .summary = "every eye vertex meets some of all light vertices of the pass (light vertex cache)",
                      .serves = serves_all,
                      .counts = counts,
                      .connect = connect,
                      .pooled = true,
                      .default_connections = 2};

}  // namespace bdpt
