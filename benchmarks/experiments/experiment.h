// The experiments, as one table: experiments.cpp.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "report.h"

namespace bdpt_experiments {

struct Experiment {
  const char* id;
  const char* paper;
  const char* title;
  const char* claim;
  void (*run)(Report& report);
};

std::span<const Experiment> experiments();

}  // namespace bdpt_experiments
