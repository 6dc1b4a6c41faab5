// From exceptions to result codes: nothing thrown leaves the library, and every failure leaves a text.
#pragma once

#include "base/error.h"
#include "bdpt.h"

#include <concepts>
#include <utility>

namespace bdpt {

// The text of bdpt_last_error() for this thread: "function: text". Cut where it is too long; never allocates.
void set_last_error(const char* function, const char* text) noexcept;

// The code for the exception in flight; leaves its text. Called inside a catch block only.
bdpt_result result_of_exception(const char* function) noexcept;

// Runs the body of an entry point. The body returns nothing, or a result that is no failure.
template <class Body>
bdpt_result guard(const char* function, Body&& body) noexcept {
  try {
    if constexpr (std::same_as<decltype(body()), bdpt_result>) {
      return body();
    } else {
      body();
      return BDPT_OK;
    }
  } catch (...) {
    return result_of_exception(function);
  }
}

// For outputs: nothing is there until the call has succeeded.
template <class T>
void reset_output(T* output) noexcept {
  if (output) *output = {};
}

// Throws where a pointer that must be given is NULL.
template <class T>
T& require(T* pointer, const char* name) {
  if (!pointer) fail(ErrorCode::InvalidArgument, name, " is NULL: pass a valid pointer");
  return *pointer;
}

}  // namespace bdpt
