// The random numbers of a subpath: pure functions of seed, index and dimension, in groups of four. Each vertex of
// either subpath has groups of its own, so that what one vertex draws never shifts the numbers of another.
#pragma once

#include "sampling/hash.h"

#include <cstdint>

namespace bdpt {

// A stream of numbers: `scramble` names the sequence, `index` the point in it.
struct Stream {
  uint64_t scramble = 0;
  uint32_t index = 0;
};

// Group of four for the start of a subpath, and per vertex.
enum class Purpose : uint32_t {
  Start = 0,      // eye: film 2, lens 2. Light: choice of light, position 2
  Direction = 1,  // light: first direction 2
  Scatter = 2,    // at a vertex: event, direction 2, roulette
  Connect = 3,    // at a vertex: eye: light and point on it (s = 1). Light: lens (t = 1)
};
inline uint32_t dimension_group(int vertex, Purpose purpose) { return uint32_t(vertex) * 4 + uint32_t(purpose); }

struct Four {
  float u[4];
  const float& operator[](int i) const { return u[i]; }
};

// Four coordinates of an Owen-scrambled Sobol point (Burley 2020), shuffled anew for each group.
Four sobol4(const Stream& stream, uint32_t group);
// Four independent numbers.
Four independent4(const Stream& stream, uint32_t group);

// A permutation of [0, n), chosen by seed (Kensler 2013).
uint32_t permute(uint32_t i, uint32_t n, uint32_t seed);

}  // namespace bdpt
