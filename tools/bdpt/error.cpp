// SPDX-License-Identifier: Apache-2.0
#include "error.h"

#include <cstdio>

namespace bdpt_tool {

const char kExitCodeHelp[] =
    "Exit codes: 0 success; 1 out of memory or a fault of the library; 2 wrong command line; 3 an input file is "
    "missing, "
    "damaged or not understood; 4 an output file cannot be written; 5 films or images do not fit each other; 130 "
    "interrupted by Ctrl-C, what was finished has been written.";

std::string Location::prefix() const {
  if (file.empty()) return "";
  return line > 0 ? file + ":" + std::to_string(line) + ": " : file + ": ";
}

void Diagnostics::warn(const std::string& text) {
  std::lock_guard lock(mutex_);
  if (texts_.insert(text).second && print_) std::fprintf(stderr, "bdpt: warning: %s\n", text.c_str());
}

std::size_t Diagnostics::count() const {
  std::lock_guard lock(mutex_);
  return texts_.size();
}

std::set<std::string> Diagnostics::texts() const {
  std::lock_guard lock(mutex_);
  return texts_;
}

}  // namespace bdpt_tool
