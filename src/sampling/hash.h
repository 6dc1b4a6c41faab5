// Hashes: of numbers, for streams of random numbers; of bytes, for telling scenes and options apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace bdpt {

// A bijection of 64-bit numbers that mixes well (the finaliser of SplitMix64, variant 13 of Stafford).
inline uint64_t mix64(uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ull;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

inline uint64_t hash_combine(uint64_t h, uint64_t v) {
  return mix64(h * 0x9e3779b97f4a7c15ull + v + 0x632be59bd9b4e019ull);
}

template <class... Values>
uint64_t hash_values(Values... values) {
  uint64_t h = 0x2545f4914f6cdd1dull;
  ((h = hash_combine(h, uint64_t(values))), ...);
  return h;
}

inline uint64_t hash_bytes(const void* data, size_t size, uint64_t h = 0x6a09e667f3bcc909ull) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  const auto word = [&](size_t i) {
    uint64_t w;
    std::memcpy(&w, bytes + 8 * i, 8);
    return w;
  };
  if (size >= 256) {  // four at a time, which do not wait for one another
    uint64_t lanes[] = {h, h + 1, h + 2, h + 3};
    for (; size >= 32; size -= 32, bytes += 32)
      for (size_t i = 0; i < 4; ++i) lanes[i] = hash_combine(lanes[i], word(i));
    for (size_t i = 0; i < 4; ++i) h = hash_combine(h, lanes[i]);
  }
  for (; size >= 8; size -= 8, bytes += 8) h = hash_combine(h, word(0));
  uint64_t tail = 0;
  if (size) std::memcpy(&tail, bytes, size);
  return hash_combine(hash_combine(h, tail), size);
}

}  // namespace bdpt
