// The random numbers of a subpath: pure functions of seed, index and dimension, in groups of four. Each vertex of
// either subpath has groups of its own, so that what one vertex draws never shifts the numbers of another.
#pragma once

#include "sampling/hash.h"

#include <cstdint>

namespace bdpt {

inline uint32_t reverse_bits(uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

// A stream of numbers: `scramble` names the sequence, `index` the point in it.
struct Stream {
  uint64_t scramble;
  uint32_t index;
  uint32_t reversed;  // the index with its bits reversed, as Owen scrambling wants it
  Stream(uint64_t scramble_ = 0, uint32_t index_ = 0)
      : scramble(scramble_), index(index_), reversed(reverse_bits(index_)) {}
};

// The same point of another sequence, independent of the first: for a purpose that wants several points of its group.
// Number 0 is the stream itself.
inline Stream another(Stream stream, uint32_t number) {
  if (number > 0) stream.scramble = hash_values(stream.scramble, number);
  return stream;
}

// Group of four for the start of a subpath, and per vertex.
enum class Purpose : uint32_t {
  Start = 0,      // eye: film 2, lens 2. Light: choice of light, position 2
  Distance = 0,   // at a vertex: channel and distance in a medium
  Direction = 1,  // light: first direction 2, how it starts; eye: place in a volume 1
  Partner = 1,    // at a vertex: eye: which light vertices it meets
  Scatter = 2,    // at a vertex: event, direction 2, roulette
  Connect = 3,    // at a vertex: eye: light and point on it (s = 1), of as many streams as wanted. Light: lens (t = 1),
                  // or of a local sensor: place in a volume, or choice of the measurement (t = 0)
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

// A number of [0,1) with its digits reversed, Owen-scrambled: 2^k neighbours from a multiple of 2^k on fall one into
// each 2^k-th. With i / n it makes the first n points of a (0,2) sequence.
double radical_inverse(uint32_t i, uint32_t seed);

// A permutation of [0, n), chosen by seed (Kensler 2013).
uint32_t permute(uint32_t i, uint32_t n, uint32_t seed);

}  // namespace bdpt
