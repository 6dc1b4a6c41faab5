#include "api/output.h"

#include "api/desc.h"

#include <algorithm>

namespace bdpt {
namespace {

constexpr int kTile = 64;

}  // namespace

Output::Output(const bdpt_output_sink* sink, const Film& film, HostCalls& calls) : film_(film), calls_(calls) {
  if (!sink) return;
  sink_ = read_struct(sink, "desc.sink");
  require(sink_.tile, "desc.sink.tile");
  tile_.resize(size_t(kTile) * kTile * 3);
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

bool Output::send_tiles() {
  const int width = film_.desc().width, height = film_.desc().height;
  for (int y0 = 0; y0 < height; y0 += kTile)
    for (int x0 = 0; x0 < width; x0 += kTile) {
      const int x1 = std::min(x0 + kTile, width), y1 = std::min(y0 + kTile, height);
      film_.read(FilmLayer::Color, 0, 0, {x0, y0, x1, y1}, false, tile_.data(), size_t(x1 - x0) * 3);
      const bool going = calls_.run("desc.sink.tile", [&] {
        return sink_.tile(sink_.user, uint32_t(x0), uint32_t(y0), uint32_t(x1), uint32_t(y1), tile_.data());
      });
      if (!going) return false;
    }
  return true;
}

}  // namespace bdpt
