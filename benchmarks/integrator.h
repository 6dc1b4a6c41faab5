// What is compared: the same engine with different sets of techniques.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "transport/options.h"

namespace bdpt_benchmark {

struct Integrator {
  std::string name;
  bdpt::TransportOptions options;
};

// Path tracing first, for the others' costs are told in its samples; all techniques last, for the others' means are
// told in its mean.
std::vector<Integrator> integrators();

}  // namespace bdpt_benchmark
