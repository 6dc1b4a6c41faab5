// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <atomic>
#include <csignal>

namespace bdpt_tool {
namespace {

std::atomic<bdpt_cancel*> active_token{nullptr};

extern "C" void on_interrupt(int) { bdpt_cancel_request(active_token.load()); }

void install(void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() : token_(make<Cancel>("cannot make a cancel token", bdpt_cancel_create)) {
  active_token = token_.get();
  // SA_RESETHAND gives the signal its deadly meaning back after the first time.
  install(on_interrupt, static_cast<int>(SA_RESETHAND) | SA_RESTART);
}

InterruptGuard::~InterruptGuard() {
  install(SIG_DFL, 0);
  active_token = nullptr;
}

}  // namespace bdpt_tool
