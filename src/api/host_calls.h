// Calling back into the host: callbacks that run during one call, and those that must run once at the end.
#pragma once

#include "api/result.h"

#include <atomic>
#include <cstdint>
#include <thread>
#include <utility>

namespace bdpt {

// A release or drop callback: called exactly once, when this goes, whatever happened in between.
class FinalCall {
 public:
  using Drop = void (*)(void* user);
  using Release = void (*)(void* user, const void* data);

  FinalCall() = default;
  FinalCall(Drop drop, void* user) : drop_(drop), user_(user) {}
  FinalCall(Release release, void* user, const void* data) : release_(release), user_(user), data_(data) {}
  FinalCall(FinalCall&& o) noexcept
      : drop_(std::exchange(o.drop_, nullptr)),
        release_(std::exchange(o.release_, nullptr)),
        user_(o.user_),
        data_(o.data_) {}
  FinalCall& operator=(FinalCall&&) = delete;
  ~FinalCall() {
    // The contract forbids to throw, but a destructor must survive it.
    try {
      if (drop_) drop_(user_);
      if (release_) release_(user_, data_);
    } catch (...) {
    }
  }

 private:
  Drop drop_ = nullptr;
  Release release_ = nullptr;
  void* user_ = nullptr;
  const void* data_ = nullptr;
};

// The callbacks of one call: run on the calling thread only, one at a time, until one of them asks to stop.
class HostCalls {
 public:
  // Calls call(), which returns the callback's value; false once any callback has asked to stop. From another thread,
  // or from inside a callback, it calls nothing.
  template <class Call>
  bool run(const char* name, Call&& call) noexcept {
    if (failed_ || inside_ || std::this_thread::get_id() != thread_) return !failed_;
    inside_ = true;
    try {
      const int32_t value = call();
      if (value != 0) stop(name, value);
    } catch (...) {
      name_ = name;
      failed_ = thrown_ = true;
    }
    inside_ = false;
    return !failed_;
  }
  // Calls call(), which returns nothing, even after a failure.
  template <class Call>
  void run_always(const char* name, Call&& call) noexcept {
    const bool failed = failed_.exchange(false);
    run(name, [&] {
      call();
      return 0;
    });
    if (failed) failed_ = true;
  }
  bool failed() const { return failed_; }
  // Throws CallbackFailed if a callback asked to stop.
  void check() const {
    if (thrown_) fail(ErrorCode::CallbackFailed, name_, " threw an exception: a callback must return a value instead");
    if (failed_) fail(ErrorCode::CallbackFailed, name_, " returned ", value_, ", which stops the call");
  }

 private:
  void stop(const char* name, int32_t value) {
    name_ = name;
    value_ = value;
    failed_ = true;
  }

  std::thread::id thread_ = std::this_thread::get_id();
  std::atomic<bool> inside_{false}, failed_{false};
  bool thrown_ = false;
  const char* name_ = "";
  int32_t value_ = 0;
};

}  // namespace bdpt
