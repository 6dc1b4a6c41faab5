// Instruction sets: of the ray queries, which Embree brings for each, and of the library's own code.
#pragma once

namespace bdpt {

enum class Isa { Best, Sse42, Avx2, Avx512, Neon };

// The widest this machine has.
Isa best_isa();
bool is_available(Isa isa);
// Of the code that this is part of; Sse42 for all that has no AVX2.
Isa code_isa();
// What the environment variable BDPT_ISA asks for and is not to be had; NULL if nothing is amiss.
const char* refused_code_isa();

}  // namespace bdpt
