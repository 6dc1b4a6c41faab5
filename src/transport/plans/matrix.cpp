// Matrix bidirectional path tracing (Chaitanya et al. 2018). For each (s,t) a matrix: its rows are the eye subpaths of
// a pool that have t vertices, its columns the light subpaths that have s, both in an order in which neighbours carry
// like amounts of light. Each row meets m columns, stratified over the whole matrix. Techniques that join no inner
// vertices take the diagonal, as everywhere (their 5.1).
//
// A pool is a square of 256 pixels in several passes at once, so that rows of one pixel stand near each other: only
// then can stratification lower the pixel's own variance. It stays in a core's cache, and its size is part of the
// result.
//
// Of N light subpaths C have s vertices; each is met by a row with the chance m / C. The estimate counts m N / C
// samples; the weights count m, for running sums cannot know s on the eye's side.
#include "transport/plan.h"
#include "transport/subpath_order.h"

namespace bdpt {

namespace {

SampleCounts counts(const TransportOptions& options, double) {
  return {.light = float(options.light_samples), .connections = float(options.connections)};
}

// Points of a matrix: point i of n, its row in order, has its column at u(i) in [0,1), each alike over all seeds.
class Columns {
 public:
  Columns(Partners partners, uint64_t seed, uint32_t n) : partners_(partners), seed_(seed), n_(n) {}
  double operator()(uint32_t i) const {
    // (i / n, u) is a (0,2) sequence's first points: any neighbouring rows have their columns spread out.
    if (partners_ == Partners::Sobol) return sobol4(Stream(seed_, i), 0)[0];
    const uint64_t h = mix64(seed_ ^ mix64(i));  // one in each n-th
    return (double(permute(i, n_, uint32_t(seed_))) + double(h >> 11) * 0x1p-53) / n_;
  }

 private:
  Partners partners_;
  uint64_t seed_;
  uint32_t n_;
};

void join(Block& block, const std::vector<OrderedVertex>& rows, const std::vector<OrderedVertex>& columns,
          uint64_t seed) {
  const TransportOptions& options = block.engine().options;
  const int m = options.connections;
  const double subpaths = double(block.light().count()), n = double(columns.size());
  const float count = float(m * subpaths / n);
  const Columns column(options.partners, seed, uint32_t(rows.size()) * uint32_t(m));
  for (uint32_t row = 0; row < rows.size(); ++row) {
    const Vertex& z = block.eye().vertices[rows[row].vertex];
    for (int k = 0; k < m; ++k) {
      const size_t c = std::min(size_t(column(row * uint32_t(m) + uint32_t(k)) * n), columns.size() - 1);
      block.connect(block.light().vertices[columns[c].vertex], z, rows[row].sample, count, block.light());
    }
    block.flush_if_full();
  }
}

void connect(Block& block) {
  const Engine& engine = block.engine();
  const SceneInfo& scene = engine.scene.info();
  OrderedVertices rows, columns;
  order_subpaths(block.eye(), scene, engine.options.order, rows);
  order_subpaths(block.light(), scene, engine.options.order, columns);
  for (uint32_t t = 2; t < rows.size(); ++t)
    for (uint32_t s = 2; s < columns.size(); ++s) {
      if (rows[t].empty() || columns[s].empty() || s + t - 1 > engine.max_edges() || !block.strategy().allows(s, t))
        continue;
      join(block, rows[t], columns[s], hash_values(block.seed(), s, t));
    }
}

}  // namespace

extern const Plan kMatrix;
const Plan kMatrix = {.name = "matrix",
                      .summary = "each eye vertex meets a light vertex of each length, stratified (Chaitanya et al.)",
                      .serves = serves_all,
                      .counts = counts,
                      .connect = connect,
                      .default_connections = 1,
                      .block_size = 256,
                      .passes = 8};

}  // namespace bdpt
