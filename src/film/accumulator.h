// A sum of floats that is exact enough to be associative: 128-bit fixed point in steps of 2^-48. Any order of additions
// gives the same bits, which ordered float sums would give for any number of threads, but not for merged ranges.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>

namespace bdpt {

__extension__ typedef __int128 Int128;

struct Accumulator {
  uint64_t low = 0;
  int64_t high = 0;

  static constexpr int kFractionBits = 48;
  // Larger contributions are rejected: with 2^95 steps each, 2^31 of them cannot overflow.
  static constexpr float kMaximum = 0x1p47f;

  // The contribution in steps, rounded toward zero below 2^-48. |v| <= kMaximum.
  static Int128 steps(float v) {
    const float scaled = v * 281474976710656.0f;  // 2^48, exact
    if (std::fabs(scaled) < 9.2e18f) return static_cast<int64_t>(scaled);
    int exponent;
    const float mantissa = std::frexp(scaled, &exponent);  // scaled = mantissa 2^exponent, 24 bits
    return static_cast<Int128>(static_cast<int64_t>(mantissa * 16777216.0f)) << (exponent - 24);
  }

  // Safe against other adders; the two words may disagree while additions are under way, never after them.
  void add_shared(Int128 v) {
    const uint64_t v_low = static_cast<uint64_t>(v);
    int64_t v_high = static_cast<int64_t>(v >> 64);
    if (v_low != 0) {
      const uint64_t old = std::atomic_ref<uint64_t>(low).fetch_add(v_low, std::memory_order_relaxed);
      if (old + v_low < old) ++v_high;
    }
    if (v_high != 0) std::atomic_ref<int64_t>(high).fetch_add(v_high, std::memory_order_relaxed);
  }

  static Accumulator of(float v) {
    const Int128 n = steps(v);
    return {static_cast<uint64_t>(n), static_cast<int64_t>(n >> 64)};
  }

  Int128 whole() const { return (static_cast<Int128>(high) << 64) | low; }
  void add(const Accumulator& o) {
    const Int128 sum = whole() + o.whole();
    low = static_cast<uint64_t>(sum), high = static_cast<int64_t>(sum >> 64);
  }

  // Nearly all sums fit into one word, and then nothing else is slow about reading a film: false where this does not,
  // or no longer.
  bool add_to(int64_t& word) const {
    const int64_t own = static_cast<int64_t>(low);
    return high == own >> 63 && !__builtin_add_overflow(word, own, &word);
  }
  static double value_of(int64_t word) { return static_cast<double>(word) * 0x1p-48; }
  double value() const {
    int64_t word = 0;
    return add_to(word) ? value_of(word) : static_cast<double>(whole()) * 0x1p-48;
  }
};

}  // namespace bdpt
