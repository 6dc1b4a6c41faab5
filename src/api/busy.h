// Objects in use by a call that is in the middle of a callback.
#pragma once

#include "base/error.h"

#include <atomic>

namespace bdpt {

class Busy {
 public:
  // Throws Reentrant while a call works on the object.
  void check(const char* object) const {
    if (busy_)
      fail(ErrorCode::Reentrant, "the ", object,
           " is in use by the call that runs this callback: call again when that "
           "call has returned");
  }
  bool is_set() const { return busy_; }

  // Sets the mark for as long as it lives.
  class Mark {
   public:
    explicit Mark(Busy& busy) : busy_(busy) { busy_.busy_ = true; }
    ~Mark() { busy_.busy_ = false; }
    Mark(const Mark&) = delete;
    Mark& operator=(const Mark&) = delete;

   private:
    Busy& busy_;
  };

 private:
  std::atomic<bool> busy_{false};
};

}  // namespace bdpt
