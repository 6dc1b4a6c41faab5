// Where work runs: on the library's own threads, or on the host's.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace bdpt {

class Executor {
 public:
  virtual ~Executor() = default;
  virtual uint32_t worker_count() const = 0;
  // Calls body(i) for each i in [0, n), from any threads, and returns when all are done. body must not throw.
  virtual void run(uint32_t n, const std::function<void(uint32_t)>& body) = 0;
  // Runs body where tasks that Embree starts stay on this executor's threads.
  virtual void isolate(const std::function<void()>& body) = 0;
};

// Own threads, the caller's included; threads = 0 takes one per core, and more than that are not had.
std::shared_ptr<Executor> make_pool(uint32_t threads);

// The host's threads.
struct HostExecutor {
  uint32_t worker_count = 1;
  void (*run)(void* user, uint32_t n, void (*body)(void* body_user, uint32_t i), void* body_user) = nullptr;
  void* user = nullptr;
  std::function<void()> drop;
};
std::shared_ptr<Executor> make_host_executor(HostExecutor host);

}  // namespace bdpt
