// Matrix bidirectional path tracing (Chaitanya et al. 2018). For each (s,t) a matrix: its rows are the eye subpaths of
// a pool that have t vertices, its columns the light subpaths that have s, both in an order in which neighbours carry
// like amounts of light. Each row meets m columns, stratified over the whole matrix. Techniques that join no inner
// vertices take the diagonal, as everywhere (their 5.1).
//
// A pool is a square of 256 pixels in several passes at once, so that rows of one pixel stand near each other: only
// then can stratification lower the pixel's own variance. It stays in a core's cache, and its size is part of the
// result.
//
// Or one matrix for all lengths (their section 7): V columns, of any length, M to a row, M N / V samples of each.
//
// Of N light subpaths C have s vertices; each is met by a row with the chance m / C. The estimate counts m N / C
// samples; the weights count m, for running sums cannot know s on the eye's side.
#include "transport/plan.h"
#include "transport/subpath_order.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

namespace {

void prefetch(const Vertex* v) {
  for (size_t line = 0; line < sizeof(Vertex); line += 64) __builtin_prefetch(reinterpret_cast<const char*>(v) + line);
}

SampleCounts counts(const TransportOptions& options, double) {
  return {.light = float(options.light_samples), .connections = float(options.connections)};
}

// Which columns of a matrix its rows take: m each.
struct Points {
  Partners partners;
  uint64_t seed;
  uint64_t rows, columns;
  uint32_t m;

  // The k-th of a row, which are numbered in order; each column alike over all seeds.
  size_t column(uint32_t row, uint32_t k) const {
    const uint64_t i = uint64_t(row) * m + k;
    return std::min(size_t(place(i) * double(columns)), size_t(columns - 1));
  }

 private:
  // (i / n, place(i)) is a (0,2) sequence's first points: any neighbouring rows have their columns spread out; or one
  // column in each n-th, dealt at random.
  double place(uint64_t i) const {
    if (partners == Partners::Sobol) return radical_inverse(uint32_t(i), uint32_t(seed));
    const uint32_t n = uint32_t(std::min<uint64_t>(rows * m, ~0u));
    const uint64_t h = mix64(seed ^ mix64(i));
    return (double(permute(uint32_t(i % n), n, uint32_t(seed))) + double(h >> 11) * 0x1p-53) / n;
  }
};

// One matrix for all lengths: as many columns to a row as make, in the mean, as many connections as a matrix for each
// (s,t) would. Most of its pairs may be too long, or masked.
uint32_t columns_to_a_row(const Block& block, const OrderedVertices& rows, const OrderedVertices& columns) {
  const Engine& engine = block.engine();
  const auto lengths = [](const std::vector<Vertex>& vertices, const std::vector<OrderedVertex>& list) {
    std::vector<double> n;
    for (const OrderedVertex& o : list) {
      const uint32_t count = vertices[o.vertex].count;
      if (n.size() <= count) n.resize(count + 1);
      ++n[count];
    }
    return n;
  };
  const std::vector<double> eye = lengths(block.eye().vertices, rows[0]),
                            light = lengths(block.light().vertices, columns[0]);
  double wanted = 0, pairs = 0;
  for (uint32_t t = 2; t < eye.size(); ++t)
    for (uint32_t s = 2; s < light.size(); ++s) {
      if (light[s] == 0 || !block.allows(s, t)) continue;
      wanted += eye[t] * engine.options.connections;
      pairs += eye[t] * light[s];
    }
  const double n = double(columns[0].size());
  return pairs > 0 ? uint32_t(std::clamp(std::round(wanted * n / pairs), 1.0, n)) : 0;
}

void connect(Block& block) {
  const Engine& engine = block.engine();
  const TransportOptions& options = engine.options;
  const LightSubpaths& light = block.light();
  const Lengths lengths = options.matrix == Matrix::AllLengths ? Lengths::Together : Lengths::Apart;
  OrderedVertices rows, columns;
  order_subpaths(block.eye(), engine.scene.info(), options.order, lengths, rows);
  order_subpaths(light, engine.scene.info(), options.order, lengths, columns);
  const uint32_t m = lengths == Lengths::Apart ? uint32_t(options.connections) : columns_to_a_row(block, rows, columns);
  block.note_memory((block.eye().vertices.size() + light.vertices.size()) * kOrderBytes);
  std::vector<Points> matrices;
  std::vector<uint32_t> place(block.eye().vertices.size());
  for (uint32_t t = 0; t < rows.size(); ++t) {
    for (uint32_t s = 0; s < columns.size(); ++s)
      matrices.push_back({options.partners, hash_values(block.seed(), s, t), rows[t].size(), columns[s].size(), m});
    for (uint32_t row = 0; row < rows[t].size(); ++row) place[rows[t][row].vertex] = row;
  }
  // In the order of the samples, not of the rows: each reads its own vertices once, and its rays start together.
  struct Partner {
    const Vertex* y;
    float count;
  };
  std::vector<Partner> partners;
  block.each_eye_vertex([&](const Vertex& z, uint32_t sample) {
    const uint32_t row = place[size_t(&z - block.eye().vertices.data())];
    const uint32_t t = lengths == Lengths::Apart ? z.count : 0;
    partners.clear();
    for (uint32_t s = 0; s < columns.size(); ++s) {
      if (columns[s].empty() || (s > 0 && !block.allows(s, z.count))) continue;
      const Points& matrix = matrices[t * columns.size() + s];
      const float count = float(m * double(light.count()) / double(matrix.columns));
      for (uint32_t k = 0; k < m; ++k) {
        const Vertex* y = &light.vertices[columns[s][matrix.column(row, k)].vertex];
        prefetch(y);
        partners.push_back({y, count});
      }
    }
    for (const Partner& p : partners)
      if (block.allows(*p.y, z)) block.connect(*p.y, z, sample, p.count, light);
  });
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
                      .resizable = true,
                      .passes = 8};

}  // namespace bdpt
