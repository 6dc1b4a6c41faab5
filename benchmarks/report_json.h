// The results as one JSON object.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "results.h"

namespace bdpt_benchmark {

std::string json(const Results& results);

}  // namespace bdpt_benchmark
