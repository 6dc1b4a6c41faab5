// Tables and sentences that many rows share.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "contest.h"
#include "report.h"

namespace bdpt_experiments {

// A line for each contestant: samples per pixel, seconds, its mean over the first one's, relative variance, and its
// efficiency over the last one's.
Table contest_table(const std::string& title, const std::vector<Contestant>& contestants);

// Relative variance over seconds, a series for each contestant.
Plot convergence(const std::string& title, const std::vector<Contestant>& contestants);

// The contestant of that name; nullptr if it was left out.
const Contestant* find(const std::vector<Contestant>& contestants, const std::string& name);

// "BDPT, 24 samples a pixel".
std::string label(const Contestant& contestant);

// Whether the ratio is above or below a limit by more than two standard errors of its logarithm.
bool above(const Estimate& ratio, double limit);
bool below(const Estimate& ratio, double limit);

}  // namespace bdpt_experiments
