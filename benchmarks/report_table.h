// The results as one Markdown table.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "results.h"

namespace bdpt_benchmark {

std::string table(const Results& results);

}  // namespace bdpt_benchmark
