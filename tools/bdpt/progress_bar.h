// A line on the terminal that tells how far a render is. Silent when stderr is no terminal.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "bdpt.h"

namespace bdpt_tool {

class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // To be passed to the library with the bar as the user pointer.
  static std::int32_t callback(void* user, const bdpt_progress* progress);

 private:
  void draw(const bdpt_progress& progress);

  bool terminal_;
  std::size_t drawn_ = 0;  // characters on the line
};

}  // namespace bdpt_tool
