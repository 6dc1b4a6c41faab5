// The image on its way to the host, tile by tile.
#pragma once

#include "api/host_calls.h"
#include "film/film.h"
#include "render/executor.h"

#include <vector>

namespace bdpt {

class Output {
 public:
  // sink may be NULL. Throws where it is not complete.
  Output(const bdpt_output_sink* sink, const Film& film, HostCalls& calls, Executor& executor);

  // After each whole pass, with the number of this call; false when a callback asked to stop.
  bool pass_done(uint64_t passes);
  // At the end of the call. An image that has just been sent is not sent again.
  void finish();

 private:
  static constexpr int kTile = 64, kBatch = 64;

  bool send();
  bool begin();
  bool send_tiles();
  // Tile number i, in rows.
  PixelRect tile(int i) const;
  float* pixels_of(int in_batch) { return batch_.data() + size_t(in_batch) * kTile * kTile * 3; }
  void resolve(int first, int count);

  bdpt_output_sink sink_{};
  const Film& film_;
  HostCalls& calls_;
  Executor& executor_;
  int columns_, rows_;
  std::vector<float> batch_;  // of tiles, resolved together by all threads
  bool is_current_ = false;   // whether the host has the image of the passes so far
};

}  // namespace bdpt
