// Ctrl-C: the first one asks the library to stop, the second one ends the program at once.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "handles.h"

namespace bdpt_tool {

// While it lives, the interrupt signal cancels its token. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bdpt_cancel* token() const { return token_.get(); }
  bool interrupted() const { return bdpt_cancel_is_requested(token_.get()) != 0; }

 private:
  Cancel token_;
};

}  // namespace bdpt_tool
