// What the system says of this process's memory, in bytes; zero where it does not say.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace bdpt_benchmark {

std::uint64_t resident_now();   // VmRSS, after the heap has given back what is free
std::uint64_t resident_peak();  // VmHWM
// Lets the peak count from now on. False where the system cannot; the peak is then that of the process's life.
bool reset_resident_peak();

}  // namespace bdpt_benchmark
