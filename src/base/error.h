// The one exception of the library and the list of what can go wrong. src/api turns it into result codes.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace bdpt {

enum class ErrorCode {
  InvalidArgument,
  InvalidId,
  OutOfMemory,
  MemoryLimit,
  Unsupported,
  Abi,
  Io,
  Format,
  Mismatch,
  InUse,
  Reentrant,
  CallbackFailed,
  Internal,
};

class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

// fail(ErrorCode::Io, "cannot open ", path): throws with the parts joined.
template <class... Parts>
[[noreturn]] void fail(ErrorCode code, const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw Error(code, text.str());
}

}  // namespace bdpt
