#include "base/isa.h"

#if defined(BDPT_DISPATCH)
// Of src/dispatch; tests that look inside are linked without it.
extern "C" __attribute__((weak)) const char* bdpt_refused_isa(void);
#endif

namespace bdpt {

Isa best_isa() {
#if defined(__x86_64__) || defined(__i386__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    return Isa::Avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Isa::Avx2;
  return Isa::Sse42;
#else
  return Isa::Neon;
#endif
}

bool is_available(Isa isa) {
  if (isa == Isa::Best) return true;
  return (isa == Isa::Neon) == (best_isa() == Isa::Neon) && int(isa) <= int(best_isa());
}

Isa code_isa() {
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
  return Isa::Avx512;
#elif defined(__AVX2__) && defined(__FMA__)
  return Isa::Avx2;
#elif defined(__x86_64__) || defined(__i386__)
  return Isa::Sse42;
#else
  return Isa::Neon;
#endif
}

const char* refused_code_isa() {
#if defined(BDPT_DISPATCH)
  return bdpt_refused_isa ? bdpt_refused_isa() : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace bdpt
