// An executor for benchmarks that count the time of one thread.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "render/executor.h"

namespace bdpt_benchmark {

// Runs everything on the thread that calls.
inline std::shared_ptr<bdpt::Executor> this_thread() {
  bdpt::HostExecutor host;
  host.run = [](void*, std::uint32_t n, void (*body)(void*, std::uint32_t), void* user) {
    for (std::uint32_t i = 0; i < n; ++i) body(user, i);
  };
  return bdpt::make_host_executor(host);
}

}  // namespace bdpt_benchmark
