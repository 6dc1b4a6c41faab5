// Two-way path tracing (Brown 2011): path tracing and light tracing at once, weighted against each other; subpaths are
// joined to the other end's first vertex alone. That happens as they grow, so nothing of a path is kept but its front
// end, whatever its length: his running ratio p_k / p_1 is part of the sums of mis.h, which every walker carries.
#include "transport/plan.h"

namespace bdpt {

namespace {

bool serves(int s, int t) { return s < 2 || t < 2; }

SampleCounts counts(const TransportOptions& options, double) {
  const float n = float(options.light_samples);
  return {.light = n, .connections = n};
}

void connect(Block&) {}

}  // namespace

extern const Plan kTwoWay;
const Plan kTwoWay = {.name = "two-way",
                      .summary = "path tracing and light tracing together, s < 2 or t < 2, nothing stored (Brown)",
                      .serves = serves,
                      .counts = counts,
                      .connect = connect};

}  // namespace bdpt
