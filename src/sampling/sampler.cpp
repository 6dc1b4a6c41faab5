#include "sampling/sampler.h"

#include <array>

namespace bdpt {

namespace {

// Owen scrambling of a number whose bits are reversed: the hash of Laine and Karras with Vegdahl's constants.
inline uint32_t scramble_reversed(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

inline float to_unit(uint32_t x) { return float(x >> 8) * 0x1p-24f; }

// Direction numbers of the first four Sobol dimensions (Joe and Kuo 2008), bits reversed, as bytes' combinations, of
// an index whose bits are reversed, too: table[byte position][byte value][dimension].
struct SobolTable {
  alignas(16) uint32_t table[4][256][4];
};

constexpr uint32_t reverse_constexpr(uint32_t x) {
  uint32_t r = 0;
  for (int i = 0; i < 32; ++i) r |= ((x >> i) & 1u) << (31 - i);
  return r;
}

constexpr SobolTable make_table() {
  uint32_t v[4][32] = {};
  for (int i = 0; i < 32; ++i) v[0][i] = 1u << (31 - i);
  constexpr int degree[4] = {0, 1, 2, 3};
  constexpr uint32_t coefficients[4] = {0, 0, 1, 1};
  constexpr uint32_t m[4][3] = {{}, {1}, {1, 3}, {1, 3, 1}};
  for (int d = 1; d < 4; ++d) {
    const int s = degree[d];
    for (int i = 0; i < 32; ++i) {
      if (i < s) {
        v[d][i] = m[d][i] << (31 - i);
      } else {
        v[d][i] = v[d][i - s] ^ (v[d][i - s] >> s);
        for (int k = 1; k < s; ++k)
          if ((coefficients[d] >> (s - 1 - k)) & 1u) v[d][i] ^= v[d][i - k];
      }
    }
  }
  SobolTable t{};
  for (int d = 0; d < 4; ++d)
    for (int byte = 0; byte < 4; ++byte)
      for (int value = 0; value < 256; ++value) {
        uint32_t x = 0;
        for (int bit = 0; bit < 8; ++bit)
          if ((value >> bit) & 1) x ^= v[d][31 - (8 * byte + bit)];
        t.table[byte][value][d] = reverse_constexpr(x);
      }
  return t;
}

const SobolTable kSobol = make_table();

}  // namespace

Four sobol4(const Stream& stream, uint32_t group) {
  // Three hashes side by side, for the permutation of the points and a scramble of each dimension.
  const uint64_t base = stream.scramble + uint64_t(group) * 0x9e3779b97f4a7c15ull;
  const uint64_t key = mix64(base), key2 = mix64(base ^ 0xd6e8feb86659fd93ull),
                 key3 = mix64(base ^ 0xa0761d6478bd642full);
  const uint32_t shuffled = scramble_reversed(stream.reversed, uint32_t(key));
  const uint32_t seeds[4] = {uint32_t(key >> 32), uint32_t(key2), uint32_t(key2 >> 32), uint32_t(key3)};
  Four r;
  for (int d = 0; d < 4; ++d) {
    uint32_t x = kSobol.table[0][shuffled & 255][d] ^ kSobol.table[1][(shuffled >> 8) & 255][d] ^
                 kSobol.table[2][(shuffled >> 16) & 255][d] ^ kSobol.table[3][shuffled >> 24][d];
    r.u[d] = to_unit(reverse_bits(scramble_reversed(x, seeds[d])));
  }
  return r;
}

Four independent4(const Stream& stream, uint32_t group) {
  const uint64_t a = mix64(stream.scramble ^ mix64((uint64_t(stream.index) << 32) | group));
  const uint64_t b = mix64(a ^ 0xd1b54a32d192ed03ull);
  return {{to_unit(uint32_t(a)), to_unit(uint32_t(a >> 32)), to_unit(uint32_t(b)), to_unit(uint32_t(b >> 32))}};
}

double radical_inverse(uint32_t i, uint32_t seed) { return double(reverse_bits(scramble_reversed(i, seed))) * 0x1p-32; }

uint32_t permute(uint32_t i, uint32_t n, uint32_t seed) {
  uint32_t w = n - 1;
  w |= w >> 1, w |= w >> 2, w |= w >> 4, w |= w >> 8, w |= w >> 16;
  do {
    i ^= seed;
    i *= 0xe170893du;
    i ^= seed >> 16;
    i ^= (i & w) >> 4;
    i ^= seed >> 8;
    i *= 0x0929eb3fu;
    i ^= seed >> 23;
    i ^= (i & w) >> 1;
    i *= 1 | seed >> 27;
    i *= 0x6935fa69u;
    i ^= (i & w) >> 11;
    i *= 0x74dcb303u;
    i ^= (i & w) >> 2;
    i *= 0x9e501cc3u;
    i ^= (i & w) >> 2;
    i *= 0xc860a3dfu;
    i &= w;
    i ^= i >> 5;
  } while (i >= n);
  return (i + seed) % n;
}

}  // namespace bdpt
