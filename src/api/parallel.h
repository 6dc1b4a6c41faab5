// Work of one call on the context's threads.
#pragma once

#include "render/executor.h"

namespace bdpt {

// Calls body(i) for each i in [0, n), from several threads, and throws what one of them throws.
void run_parallel(Executor& executor, uint32_t n, const std::function<void(uint32_t)>& body);

}  // namespace bdpt
