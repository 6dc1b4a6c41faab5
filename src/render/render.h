// A render: passes, blocks, tasks, progress, cancel. When and where, never how.
#pragma once

#include "film/film.h"
#include "render/executor.h"
#include "scene/scene.h"
#include "sensor/sensor.h"
#include "transport/block.h"
#include "transport/light_pool.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace bdpt {

struct RenderDesc {
  TransportOptions transport;
  uint64_t seed = 0;
  uint64_t first_pass = 0;
  uint32_t block_size = 0;  // 0 = chosen
};

struct Progress {
  double fraction = 0, seconds = 0;
  uint64_t passes = 0, samples = 0;
};

enum class StopReason { Passes, Time, Noise, Cancelled, Callback };

struct AdvanceDesc {
  uint64_t passes = 0;  // 0 = no such limit; likewise below
  double seconds = 0;
  double noise = 0;
  const std::atomic<bool>* cancel = nullptr;
  // Both are called on the calling thread only; false stops the call.
  std::function<bool(const Progress&)> on_progress;
  std::function<bool(uint64_t passes)> on_pass;  // after each whole pass, with the number of this call
};

struct AdvanceReport {
  StopReason reason = StopReason::Passes;
  uint64_t passes = 0, next_pass = 0;
  double seconds = 0;
};

class Render {
 public:
  // Throws Mismatch (the film holds something else) or InUse.
  Render(std::shared_ptr<const Scene> scene, std::shared_ptr<const Sensor> sensor, std::shared_ptr<Film> film,
         std::shared_ptr<Executor> executor, std::shared_ptr<MemoryMeter> meter, const RenderDesc& desc);
  ~Render();

  // What its blocks are booked to take with the default options.
  static uint64_t bytes_of_blocks(const Executor& executor, const FilmDesc& film);

  // Not to be called from its own callbacks.
  AdvanceReport advance(const AdvanceDesc& desc);
  TransportStats stats() const;       // also while advance() is under way
  TechniqueTable techniques() const;  // of the blocks that are done
  const Engine& engine() const { return *engine_; }
  // For tests, before the first pass: instead of what a pilot would choose.
  void set_strategies(StrategyMap map) { engine_->choose(std::move(map)); }
  uint64_t passes() const { return passes_; }
  double seconds() const { return seconds_; }
  Film& film() { return *film_; }
  const Film& film() const { return *film_; }

  // Benchmarks: every ray traced from now on goes to the recorder, too.
  void record(RayRecorder* recorder) { recorder_ = recorder; }

 private:
  struct Worker;
  struct Call;
  bool run_pass(Call& call);
  bool fill_pool(Call& call);
  bool run_pilot(Call& call);
  bool choose_strategies(Call& call);
  void find_starts();
  void book_blocks();
  void make_pool();
  void restart_pass();
  bool run_tasks(Call& call, uint32_t count, const std::atomic<uint32_t>& done,
                 const std::function<void(uint32_t)>& task);
  bool run_blocks(Call& call, uint32_t count, const std::function<void(Block&, uint32_t)>& task);
  void run_task(Call& call, const std::function<void(Block&)>& task);
  std::unique_ptr<Worker> take_worker();

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const Sensor> sensor_;
  std::shared_ptr<Film> film_;
  std::shared_ptr<Executor> executor_;
  std::shared_ptr<MemoryMeter> meter_;
  RenderDesc desc_;
  Booking booking_, pool_booking_;
  uint64_t worker_share_ = 0;  // bytes that are booked for a worker's block
  std::unique_ptr<Engine> engine_;
  std::vector<PixelRect> blocks_;
  std::vector<uint8_t> blocks_done_;  // of the pass in hand
  uint64_t pass_ = 0;                 // the pass in hand
  std::unique_ptr<LightPool> pool_;   // for plans that need one
  bool pool_filled_ = false;          // for the pass in hand
  mutable std::mutex workers_mutex_;
  std::vector<std::unique_ptr<Worker>> workers_;  // those that are idle
  TransportStats stats_;
  uint64_t passes_ = 0;
  double seconds_ = 0;
  RayRecorder* recorder_ = nullptr;
};

}  // namespace bdpt
