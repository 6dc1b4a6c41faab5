// Modes of floating-point arithmetic, each while its object lives; the mode before is put back.
//
// FloatMode is that of all work on blocks: denormals count as zero, as Embree asks for, and every thread must agree for
// results to be the same.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace bdpt {

#if defined(__SSE2__)
class FloatMode {
 public:
  FloatMode() : saved_(_mm_getcsr()) { _mm_setcsr((saved_ & ~0x6000u) | 0x8040u); }  // round to nearest, FTZ, DAZ
  ~FloatMode() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
};

// What the host's functions may rely on, in whatever language they are: the mode in which programs start.
class HostFloatMode {
 public:
  HostFloatMode() : saved_(_mm_getcsr()) { _mm_setcsr(0x1f80u); }
  ~HostFloatMode() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
};
#else
class [[maybe_unused]] FloatMode {};
class [[maybe_unused]] HostFloatMode {};
#endif

}  // namespace bdpt
