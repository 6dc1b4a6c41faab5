// Orders of subpaths in which neighbours carry like amounts of light, for plans that stratify over them.
#pragma once

#include "transport/block.h"

namespace bdpt {

// A vertex that can be joined, of subpath `sample` of its side.
struct OrderedVertex {
  uint32_t vertex, sample;
};

// Those of each number of vertices n, in order: result[n]. n = s or t. Or all together: result[0].
using OrderedVertices = std::vector<std::vector<OrderedVertex>>;
enum class Lengths { Apart, Together };

// Metric: by the sum of the squares of a subpath's edges (Chaitanya et al. 2018, section 4.2). Hilbert: by the place of
// the last vertex on a Hilbert curve through the scene. None: by the subpaths' numbers.
void order_subpaths(const EyeSubpaths& subpaths, const SceneInfo& scene, Order order, Lengths lengths,
                    OrderedVertices& result);
void order_subpaths(const LightSubpaths& subpaths, const SceneInfo& scene, Order order, Lengths lengths,
                    OrderedVertices& result);

// Bytes that order_subpaths takes for each vertex, and leaves in its result.
inline constexpr size_t kOrderBytes = 64;

// The place of a cell of a grid of 2^21 to a side on the Hilbert curve (Skilling 2004).
uint64_t hilbert_index(uint32_t x, uint32_t y, uint32_t z);

}  // namespace bdpt
