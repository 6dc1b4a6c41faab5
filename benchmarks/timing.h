// What the benchmarks measure time with.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <memory>
#include <vector>

#include "render/executor.h"

namespace bdpt_benchmark {

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// Of all threads of this process.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Runs everything on the thread that calls.
inline std::shared_ptr<bdpt::Executor> this_thread() {
  bdpt::HostExecutor host;
  host.run = [](void*, std::uint32_t n, void (*body)(void*, std::uint32_t), void* user) {
    for (std::uint32_t i = 0; i < n; ++i) body(user, i);
  };
  return bdpt::make_host_executor(host);
}

}  // namespace bdpt_benchmark
