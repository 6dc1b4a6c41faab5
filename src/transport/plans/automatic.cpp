// Each tile of the image has its own strategy: path tracing, two-way, one-to-one with n light subpaths for each eye
// subpath, or matrix, by the efficiency that a pilot tells (strategy_pilot.h). Light subpaths are the image's, not a
// tile's: a splat is weighted by the strategy of the tile in which it lands.
#include "transport/plan.h"

namespace bdpt {

namespace {

bool serves_eye(int s, int t) { return s < 2 && t >= 1; }
SampleCounts counts(const TransportOptions& options, double) {
  const float n = float(options.light_samples);
  return {.light = n, .connections = n};
}
SampleCounts no_light(const TransportOptions&, double) { return {.light = 0, .connections = 0}; }
// Not reached: each tile's strategy has a plan of its own that joins.
void connect_nothing(Block&) {}

}  // namespace

extern const Plan kPath;
const Plan kPath = {.name = "path",
                    .summary = "path tracing, as a strategy",
                    .serves = serves_eye,
                    .counts = no_light,
                    .connect = connect_nothing};

extern const Plan kAutomatic;
const Plan kAutomatic = {.name = "automatic",
                         .summary = "path, two-way, one-to-one or matrix by tiles, as a pilot advises",
                         .serves = serves_all,
                         .counts = counts,
                         .connect = connect_nothing,
                         .block_size = Tiles::kSide * Tiles::kSide,
                         .passes = 8,
                         .chooses = true};

}  // namespace bdpt
