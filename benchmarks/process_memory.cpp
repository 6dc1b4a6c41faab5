// SPDX-License-Identifier: Apache-2.0
#include "process_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace bdpt_benchmark {
namespace {

std::uint64_t status_field(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.rfind(name + ":", 0) == 0) return 1024 * std::stoull(line.substr(name.size() + 1));
  return 0;
}

}  // namespace

std::uint64_t resident_now() {
  malloc_trim(0);
  return status_field("VmRSS");
}

std::uint64_t resident_peak() { return status_field("VmHWM"); }

bool reset_resident_peak() {
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return bool(file);
}

}  // namespace bdpt_benchmark
