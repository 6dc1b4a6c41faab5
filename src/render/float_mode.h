// Denormals count as zero while this lives: Embree asks for it, and every thread must agree for results to be the same.
// The caller's mode is put back.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace bdpt {

class FloatMode {
 public:
#if defined(__SSE2__)
  FloatMode() : saved_(_mm_getcsr()) { _mm_setcsr((saved_ & ~0x6000u) | 0x8040u); }  // round to nearest, FTZ, DAZ
  ~FloatMode() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
#endif
};

}  // namespace bdpt
