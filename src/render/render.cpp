#include "render/render.h"

#include "render/float_mode.h"
#include "sampling/hash.h"
#include "transport/block.h"
#include "transport/image_pilot.h"
#include "transport/plan.h"
#include "transport/stage_timer.h"
#include "transport/start_pilot.h"
#include "transport/strategy_pilot.h"

#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

namespace bdpt {

namespace {

constexpr uint32_t kDefaultBlock = 256;
constexpr double kProgressInterval = 0.1;
constexpr double kPoolReserve = 1.3;        // vectors grow in steps, and passes differ from the pilot
constexpr uint64_t kBytesPerSample = 4096;  // of a block's buffers, for the memory limit: some ten vertices a side

// The lowest pass from `first` on that the film does not hold.
uint64_t next_free_pass(const Film& film, uint64_t first) {
  for (const PassRange& r : film.ranges())
    if (first >= r.begin && first < r.end) first = r.end;
  return first;
}

std::vector<PixelRect> make_blocks(const PixelRect& bounds, uint32_t samples) {
  const int side = std::max(1, int(std::lround(std::sqrt(double(samples)))));
  std::vector<PixelRect> blocks;
  for (int y = bounds.y0; y < bounds.y1; y += side)
    for (int x = bounds.x0; x < bounds.x1; x += side)
      blocks.push_back({x, y, std::min(x + side, bounds.x1), std::min(y + side, bounds.y1)});
  return blocks;
}

void check_whole_pools(const Engine& engine, const char* field, uint64_t passes) {
  const uint64_t n = engine.pool_passes;
  if (passes % n != 0)
    fail(ErrorCode::InvalidArgument, field, ": is ", passes, ", but the plan ", engine.plan.name, " takes ", n,
         " passes at once: give a multiple of ", n);
}

bool is_film_of(const FilmDesc& film, const Sensor& sensor) {
  const FilmPlanes planes(sensor);
  return sensor.is_local() == film.one_image && planes.planes == film.planes && planes.counts == film.counts &&
         planes.unfiltered == film.unfiltered && planes.coverages == film.coverages;
}

void check_outputs(const Sensor& sensor, const TransportOptions& options) {
  if (!sensor.is_plain() && !sensor.is_local() && options.plan && options.plan->chains)
    fail(ErrorCode::InvalidArgument, "plan: '", options.plan->name,
         "' measures the picture alone: choose another, or give the camera no outputs");
}

void check_local(const Scene& scene, const Sensor& sensor, const TransportOptions& options) {
  if (!sensor.is_local()) return;
  if (sensor.is_volume() && scene.has_interiors())
    fail(ErrorCode::Unsupported,
         "the sensor has balls, and the scene media or priorities: measure at points without a radius");
  if (options.plan && options.plan->chains)
    fail(ErrorCode::InvalidArgument, "plan: '", options.plan->name,
         "' measures pixels of cameras alone: choose another for this sensor");
  if (options.adaptive != Adaptive::None)
    fail(ErrorCode::InvalidArgument, "adaptive: it spreads samples over the pixels of cameras alone: leave it 0");
}

}  // namespace

// What advance() knows of its own call.
struct Render::Call {
  const AdvanceDesc& desc;
  double begin = seconds_now();
  std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> stop{false};  // no further block
  bool callback_stopped = false;
  uint64_t passes = 0;
  std::atomic<uint64_t> samples{0};
  std::atomic<uint32_t> blocks_done{0};
  uint32_t blocks = 1;
  uint64_t pool_passes = 1;
  double last_progress = seconds_now();
  double fraction = 0;
  double relative_error = -1;
  std::mutex mutex;
  std::exception_ptr error;

  explicit Call(const AdvanceDesc& d) : desc(d) {}
  bool cancelled() const { return desc.cancel && desc.cancel->load(std::memory_order_relaxed); }
  double seconds() const { return seconds_now() - begin; }

  void report() {
    if (!desc.on_progress || callback_stopped) return;
    double f = 0;
    const double done = double(passes) + double(pool_passes) * double(blocks_done) / blocks;
    if (desc.passes > 0) f = std::max(f, done / double(desc.passes));
    if (desc.seconds > 0) f = std::max(f, seconds() / desc.seconds);
    if (desc.noise > 0 && relative_error > 0) f = std::max(f, std::pow(desc.noise / relative_error, 2));
    fraction = std::max(fraction, std::min(f, 1.0));
    last_progress = seconds_now();
    if (!desc.on_progress({fraction, seconds(), passes, samples})) {
      callback_stopped = true;
      stop = true;
    }
  }
  void report_now_and_then() {
    if (std::this_thread::get_id() == caller && seconds_now() - last_progress > kProgressInterval) report();
  }
};

struct Render::Worker {
  explicit Worker(const Engine& engine) : block(engine) {}
  Block block;
  Booking more;  // than its share of the render's booking
};

Render::Render(std::shared_ptr<const Scene> scene, std::shared_ptr<const Sensor> sensor, std::shared_ptr<Film> film,
               std::shared_ptr<Executor> executor, std::shared_ptr<MemoryMeter> meter, const RenderDesc& desc)
    : scene_(std::move(scene)),
      sensor_(std::move(sensor)),
      film_(std::move(film)),
      executor_(std::move(executor)),
      meter_(std::move(meter)),
      desc_(desc) {
  if (sensor_->width() != film_->desc().width || sensor_->height() != film_->desc().height)
    fail(ErrorCode::Mismatch, "film: it is ", film_->desc().width, " x ", film_->desc().height, ", the sensor ",
         sensor_->width(), " x ", sensor_->height());
  if (!is_film_of(film_->desc(), *sensor_))
    fail(ErrorCode::Mismatch, "film: it was created for another kind of sensor, or for other outputs");
  check_local(*scene_, *sensor_, desc.transport);
  check_outputs(*sensor_, desc.transport);
  if (!film_->acquire()) fail(ErrorCode::InUse, "film: another render fills it; destroy that first");
  try {
    engine_ = std::make_unique<Engine>(*scene_, *sensor_, *film_, desc.transport, desc.seed);
    const uint64_t n = engine_->pool_passes;
    check_whole_pools(*engine_, "first_pass", desc.first_pass);
    film_->begin(engine_->recipe());
    const uint32_t own = engine_->pool_pixels, wanted = desc.block_size ? desc.block_size : kDefaultBlock;
    blocks_ = make_blocks(engine_->bounds, own ? own : wanted);
    blocks_done_.assign(blocks_.size(), 0);
    const uint64_t block_samples = uint64_t(blocks_[0].x1 - blocks_[0].x0) * uint64_t(blocks_[0].y1 - blocks_[0].y0);
    const uint64_t each = desc.transport.adaptive == Adaptive::TwoStages ? SampleRates::kMost : 1;
    const uint64_t in_flight = engine_->plan.in_flight ? engine_->plan.in_flight : block_samples * n * each;
    worker_share_ = in_flight * kBytesPerSample;
    book_blocks();
    if (engine_->options.light_start == StartBy::Importance) find_starts();
    if (engine_->plan.pooled) make_pool();
    pass_ = next_free_pass(*film_, desc.first_pass);
  } catch (...) {
    film_->release();
    throw;
  }
}

void Render::find_starts() {
  const FloatMode mode;
  StartPilot pilot = pilot_starts(*engine_);
  stats_ += pilot.stats;
  engine_->starts = std::move(pilot.starts);
}

// What the blocks in hand take. Pools of a size that was asked for are not split behind the host's back: their size is
// part of the result.
void Render::book_blocks() {
  const uint64_t workers = executor_->worker_count(), pools = std::min<uint64_t>(workers, blocks_.size());
  const uint64_t blocks = pools * worker_share_, tree = engine_->direct_lighting.memory();
  if (engine_->plan.resizable && meter_ && meter_->limit() > 0) {
    const uint64_t used = meter_->used() + tree, left = meter_->limit() > used ? meter_->limit() - used : 0;
    const uint64_t fits = left / (workers * engine_->pool_passes * kBytesPerSample);
    const uint64_t side = uint64_t(std::sqrt(double(fits)));
    if (blocks > left)
      fail(ErrorCode::MemoryLimit, "pool_pixels: pools of ", engine_->pool_pixels, " pixels in ", engine_->pool_passes,
           " passes, one for each of ", pools, " workers, need ", blocks, " bytes, and ", left,
           " are left of the context's memory_limit: give ",
           side >= 4 ? "at most " + std::to_string(side * side) + ", or " : std::string(),
           "fewer pool_passes, or a context with fewer threads");
  }
  booking_ = Booking(meter_, blocks + tree, "the render's blocks and tree of lights");
}

uint64_t Render::bytes_of_blocks(const Executor& executor, const FilmDesc& film) {
  const uint64_t side = uint64_t(std::lround(std::sqrt(double(kDefaultBlock))));
  const uint64_t width = uint64_t(film.width), height = uint64_t(film.height);
  const uint64_t blocks = ((width + side - 1) / side) * ((height + side - 1) / side);
  const uint64_t samples = std::min(side, width) * std::min(side, height);
  return std::min<uint64_t>(executor.worker_count(), blocks) * samples * kBytesPerSample;
}

void Render::make_pool() {
  const FloatMode mode;
  const LightPilot pilot = pilot_light(*engine_);
  stats_ += pilot.stats;
  engine_->set_counts(pilot.joinable);
  const double bytes = pilot.vertices * kPoolReserve *
                           (sizeof(Vertex) + 8 + LightPool::bytes_of_choice(engine_->options.pool_selection)) +
                       sizeof(LightStart) + sizeof(Stream) + 4;
  pool_booking_ =
      Booking(meter_, uint64_t(double(engine_->light_per_pass()) * bytes), "the plan's pool of light subpaths");
  pool_ = std::make_unique<LightPool>();
}

Render::~Render() {
  film_->discard_pass();
  film_->release();
}

TransportStats Render::stats() const {
  const std::lock_guard lock(workers_mutex_);
  return stats_;
}

TechniqueTable Render::techniques() const {
  TechniqueTable sum;
  const std::lock_guard lock(workers_mutex_);
  for (const std::unique_ptr<Worker>& worker : workers_) sum += worker->block.techniques();
  return sum;
}

std::unique_ptr<Render::Worker> Render::take_worker() {
  const std::lock_guard lock(workers_mutex_);
  if (workers_.empty()) return std::make_unique<Worker>(*engine_);
  std::unique_ptr<Worker> worker = std::move(workers_.back());
  workers_.pop_back();
  return worker;
}

// Gives a task a worker's block, unless the call is to stop; keeps its statistics, or what it threw.
void Render::run_task(Call& call, const std::function<void(Block&)>& task) {
  if (call.stop || call.cancelled()) return;
  try {
    const FloatMode mode;
    std::unique_ptr<Worker> worker = take_worker();
    task(worker->block);
    // Long paths may need more than was booked for them.
    const uint64_t bytes = worker->block.memory();
    if (bytes > worker_share_ + worker->more.bytes()) {
      worker->more = Booking();
      worker->more = Booking(meter_, bytes - worker_share_, "a block of the render");
    }
    const TransportStats stats = worker->block.take_stats();
    call.samples += stats.samples;
    const std::lock_guard lock(workers_mutex_);
    stats_ += stats;
    workers_.push_back(std::move(worker));
  } catch (...) {
    const std::lock_guard lock(call.mutex);
    if (!call.error) call.error = std::current_exception();
    call.stop = true;
  }
  call.report_now_and_then();
}

// The pass starts anew, without what is in hand.
void Render::restart_pass() {
  film_->discard_pass();
  pool_filled_ = false;
  std::fill(blocks_done_.begin(), blocks_done_.end(), 0);
}

// Runs tasks; true when all are done, false when the call was told to stop.
bool Render::run_tasks(Call& call, uint32_t count, const std::atomic<uint32_t>& done,
                       const std::function<void(uint32_t)>& task) {
  executor_->run(count, task);
  if (call.error) {  // something may have been counted in part
    restart_pass();
    std::rethrow_exception(call.error);
  }
  if (done == count) return true;
  if (!call.stop && !call.cancelled())
    fail(ErrorCode::CallbackFailed, "executor: run returned before it had called the body for each index");
  return false;
}

// The same for tasks that need a block each and leave nothing behind when the call is told to stop.
bool Render::run_blocks(Call& call, uint32_t count, const std::function<void(Block&, uint32_t)>& task) {
  std::atomic<uint32_t> done{0};
  return run_tasks(call, count, done, [&](uint32_t i) {
    run_task(call, [&](Block& block) {
      task(block, i);
      ++done;
    });
  });
}

bool Render::fill_pool(Call& call) {
  pool_->begin(engine_->light_per_pass());
  const bool filled =
      run_blocks(call, pool_->pieces(), [&](Block& block, uint32_t i) { pool_->fill(block, pass_, i); });
  if (!filled) {
    restart_pass();
    return false;
  }
  pool_->finish(engine_->options.pool_selection);
  return pool_filled_ = true;
}

// The strategies of tiles.
bool Render::choose_strategies(Call& call) {
  StrategyPilot pilot(*engine_);
  if (!run_blocks(call, pilot.tasks(), [&](Block& block, uint32_t i) { block.stats() += pilot.run(i); })) return false;
  engine_->choose(pilot.choose());
  return true;
}

// The thresholds of the shadow rays' roulette, and the rates of samples.
bool Render::run_pilot(Call& call) {
  ImagePilot pilot(*engine_);
  if (!run_blocks(call, pilot.pool_tasks(), [&](Block& block, uint32_t i) { pilot.fill_pool(block, i); })) return false;
  pilot.finish_pool();
  if (!run_blocks(call, pilot.row_tasks(), [&](Block& block, uint32_t i) { pilot.run_row(block, i); })) return false;
  const std::vector<RegionMeasure> measures = pilot.measures();
  if (engine_->options.shadow_roulette == Roulette::Efficiency) engine_->roulette.set_efficient(pilot.grid(), measures);
  if (engine_->options.adaptive == Adaptive::TwoStages)
    engine_->set_rates(pilot.grid(), pilot.eye_measures(), measures);
  return true;
}

// True when the pass in hand is whole.
bool Render::run_pass(Call& call) {
  if (engine_->plan.chooses && !engine_->map && !choose_strategies(call)) return false;
  if (engine_->wants_pilot() && !run_pilot(call)) return false;
  call.blocks = uint32_t(blocks_.size());
  call.pool_passes = engine_->pool_passes;
  uint32_t done = 0;
  for (uint8_t b : blocks_done_) done += b;
  call.blocks_done = done;
  film_->set_partial(true);
  if (pool_ && !pool_filled_ && !fill_pool(call)) return false;
  const bool whole = run_tasks(call, uint32_t(blocks_.size()), call.blocks_done, [&](uint32_t i) {
    if (blocks_done_[i]) return;
    run_task(call, [&](Block& block) {
      block.run(pass_, blocks_[i], pool_.get());
      blocks_done_[i] = 1;
      ++call.blocks_done;
    });
  });
  if (!whole) {
    film_->set_partial(call.blocks_done > 0 || pool_filled_);
    return false;
  }
  const int height = film_->desc().height, bands = std::min(height, 64);
  executor_->run(uint32_t(bands), [&](uint32_t band) {
    film_->end_pass(pass_, int(band) * height / bands, (int(band) + 1) * height / bands);
  });
  film_->commit_pass(pass_);
  std::fill(blocks_done_.begin(), blocks_done_.end(), 0);
  pool_filled_ = false;
  const uint64_t n = engine_->pool_passes;
  pass_ = next_free_pass(*film_, pass_ + n);
  passes_ += n;
  call.passes += n;
  call.blocks_done = 0;
  return true;
}

AdvanceReport Render::advance(const AdvanceDesc& desc) {
  check_whole_pools(*engine_, "passes", desc.passes);
  Call call(desc);
  engine_->recorder = recorder_;
  AdvanceReport report;
  uint64_t next_check = film_->passes() + 1;
  call.report();
  while (true) {
    if (call.callback_stopped)
      report.reason = StopReason::Callback;
    else if (call.cancelled())
      report.reason = StopReason::Cancelled;
    else if (run_pass(call)) {
      if (desc.on_pass && !desc.on_pass(call.passes)) {
        report.reason = StopReason::Callback;
        break;
      }
      if (desc.noise > 0 && film_->passes() >= next_check) {
        call.relative_error = film_->relative_error();
        next_check = film_->passes() + 1 + film_->passes() / 16;
        if (call.relative_error >= 0 && call.relative_error <= desc.noise) {
          report.reason = StopReason::Noise;
          break;
        }
      }
      if (desc.passes > 0 && call.passes >= desc.passes) {
        report.reason = StopReason::Passes;
        break;
      }
      if (desc.seconds > 0 && call.seconds() >= desc.seconds) {
        report.reason = StopReason::Time;
        break;
      }
      call.report_now_and_then();
      continue;
    } else {
      report.reason = call.callback_stopped ? StopReason::Callback : StopReason::Cancelled;
    }
    break;
  }
  const bool finished = report.reason != StopReason::Cancelled && report.reason != StopReason::Callback;
  if (finished) {
    call.fraction = 1;
    call.report();
  }
  report.passes = call.passes;
  report.next_pass = pass_;
  report.seconds = call.seconds();
  seconds_ += report.seconds;
  return report;
}

}  // namespace bdpt
