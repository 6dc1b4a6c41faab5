#include "api/parallel.h"

#include "base/error.h"
#include "render/float_mode.h"

#include <atomic>
#include <exception>
#include <mutex>

namespace bdpt {

void run_parallel(Executor& executor, uint32_t n, const std::function<void(uint32_t)>& body) {
  std::atomic<uint32_t> done{0};
  std::mutex mutex;
  std::exception_ptr thrown;
  executor.run(n, [&](uint32_t i) {  // the host's threads must see no exception
    try {
      const FloatMode mode;
      body(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!thrown) thrown = std::current_exception();
    }
    ++done;
  });
  if (thrown) std::rethrow_exception(thrown);
  if (done != n) fail(ErrorCode::CallbackFailed, "executor: run returned before it had called the body for each index");
}

}  // namespace bdpt
