#include "render/executor.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace bdpt {

namespace {

class Pool final : public Executor {
 public:
  explicit Pool(uint32_t threads)
      : threads_(std::min(threads ? threads : ~0u, uint32_t(tbb::info::default_concurrency()))),
        arena_(int(threads_)) {}
  uint32_t worker_count() const override { return threads_; }
  void run(uint32_t n, const std::function<void(uint32_t)>& body) override {
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<uint32_t>(0, n, 1),
          [&](const tbb::blocked_range<uint32_t>& range) {
            for (uint32_t i = range.begin(); i != range.end(); ++i) body(i);
          },
          tbb::simple_partitioner());
    });
  }
  void isolate(const std::function<void()>& body) override { arena_.execute(body); }

 private:
  uint32_t threads_;
  tbb::task_arena arena_;
};

class Host final : public Executor {
 public:
  explicit Host(HostExecutor host) : host_(std::move(host)), alone_(1) {}
  ~Host() override {
    if (host_.drop) host_.drop();
  }
  uint32_t worker_count() const override { return host_.worker_count; }
  void run(uint32_t n, const std::function<void(uint32_t)>& body) override {
    const auto call = [](void* user, uint32_t i) { (*static_cast<const std::function<void(uint32_t)>*>(user))(i); };
    host_.run(host_.user, n, call, const_cast<std::function<void(uint32_t)>*>(&body));
  }
  // An arena of one has room for the caller only, so that no thread is started for what Embree does in parallel.
  void isolate(const std::function<void()>& body) override { alone_.execute(body); }

 private:
  HostExecutor host_;
  tbb::task_arena alone_;
};

}  // namespace

std::shared_ptr<Executor> make_pool(uint32_t threads) { return std::make_shared<Pool>(threads); }
std::shared_ptr<Executor> make_host_executor(HostExecutor host) { return std::make_shared<Host>(std::move(host)); }

}  // namespace bdpt
