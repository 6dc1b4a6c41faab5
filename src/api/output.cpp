#include "api/output.h"

#include "api/desc.h"
#include "render/float_mode.h"

#include <algorithm>
#include <atomic>

namespace bdpt {
Output::Output(const bdpt_output_sink* sink, const Film& film, HostCalls& calls, Executor& executor)
    : film_(film),
      calls_(calls),
      executor_(executor),
      columns_((film.desc().width + kTile - 1) / kTile),
      rows_((film.desc().height + kTile - 1) / kTile) {
  if (!sink) return;
  sink_ = read_struct(sink, "desc.sink");
  require(sink_.tile, "desc.sink.tile");
  batch_.resize(size_t(std::min(kBatch, columns_ * rows_)) * kTile * kTile * 3);
}

bool Output::pass_done(uint64_t passes) {
  is_current_ = false;
  if (!sink_.tile || sink_.every == 0 || passes % sink_.every != 0) return true;
  return send();
}

void Output::finish() {
  if (sink_.tile && !is_current_ && !calls_.failed()) send();
}

bool Output::send() {
  bool sent = false;
  // The host closes what it opened: end is called after a failure, too.
  const auto end = [&](bdpt_result result) {
    if (sink_.end) calls_.run_always("desc.sink.end", [&] { sink_.end(sink_.user, result); });
  };
  try {
    sent = begin() && send_tiles();
  } catch (const Error&) {  // of the executor
    end(BDPT_ERROR_CALLBACK_FAILED);
    throw;
  } catch (...) {
    end(BDPT_ERROR_OUT_OF_MEMORY);
    throw;
  }
  end(sent ? BDPT_OK : BDPT_ERROR_CALLBACK_FAILED);
  is_current_ = true;
  return sent && !calls_.failed();
}

bool Output::begin() {
  if (!sink_.begin) return true;
  return calls_.run("desc.sink.begin", [&] {
    return sink_.begin(sink_.user, uint32_t(film_.desc().width), uint32_t(film_.desc().height), film_.passes());
  });
}

PixelRect Output::tile(int i) const {
  const int x = i % columns_ * kTile, y = i / columns_ * kTile;
  return {x, y, std::min(x + kTile, film_.desc().width), std::min(y + kTile, film_.desc().height)};
}

void Output::resolve(int first, int count) {
  std::atomic<int> done{0};
  executor_.run(uint32_t(count), [&](uint32_t i) {
    const HostFloatMode mode;  // the same on all threads
    const PixelRect rect = tile(first + int(i));
    film_.read(FilmLayer::Color, 0, 0, rect, false, pixels_of(int(i)), size_t(rect.width()) * 3);
    ++done;
  });
  if (done != count)
    fail(ErrorCode::CallbackFailed, "executor: run returned before it had called the body for each index");
}

bool Output::send_tiles() {
  for (int first = 0; first < columns_ * rows_; first += kBatch) {
    const int count = std::min(kBatch, columns_ * rows_ - first);
    resolve(first, count);
    for (int i = 0; i < count; ++i) {
      const PixelRect rect = tile(first + i);
      const bool going = calls_.run("desc.sink.tile", [&] {
        return sink_.tile(sink_.user, uint32_t(rect.x0), uint32_t(rect.y0), uint32_t(rect.x1), uint32_t(rect.y1),
                          pixels_of(i));
      });
      if (!going) return false;
    }
  }
  return true;
}

}  // namespace bdpt
