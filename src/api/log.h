// The host's log.
#pragma once

#include "api/host_calls.h"
#include "render/float_mode.h"

#include <sstream>

namespace bdpt {

class Log {
 public:
  Log() = default;  // silent
  Log(const bdpt_log& log, FinalCall drop) : write_(log.write), user_(log.user), drop_(std::move(drop)) {}

  template <class... Parts>
  void info(const Parts&... parts) const noexcept {
    write(BDPT_LOG_INFO, parts...);
  }
  template <class... Parts>
  void warning(const Parts&... parts) const noexcept {
    write(BDPT_LOG_WARNING, parts...);
  }

 private:
  // A text that cannot be made, for lack of memory, is no reason to fail.
  template <class... Parts>
  void write(bdpt_log_level level, const Parts&... parts) const noexcept {
    if (!write_) return;
    try {
      std::ostringstream text;
      (text << ... << parts);
      const HostFloatMode mode;
      write_(user_, level, text.str().c_str());
    } catch (...) {
    }
  }

  void (*write_)(void*, bdpt_log_level, const char*) = nullptr;
  void* user_ = nullptr;
  FinalCall drop_;
};

}  // namespace bdpt
