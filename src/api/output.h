// The image on its way to the host, tile by tile.
#pragma once

#include "api/host_calls.h"
#include "film/film.h"

#include <vector>

namespace bdpt {

class Output {
 public:
  // sink may be NULL. Throws where it is not complete.
  Output(const bdpt_output_sink* sink, const Film& film, HostCalls& calls);

  // After each whole pass, with the number of this call; false when a callback asked to stop.
  bool pass_done(uint64_t passes);
  // At the end of the call. An image that has just been sent is not sent again.
  void finish();

 private:
  bool send();
  bool begin();
  bool send_tiles();

  bdpt_output_sink sink_{};
  const Film& film_;
  HostCalls& calls_;
  std::vector<float> tile_;
  bool is_current_ = false;  // whether the host has the image of the passes so far
};

}  // namespace bdpt
