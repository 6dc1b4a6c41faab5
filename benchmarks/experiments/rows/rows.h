// The functions of the table in experiments.cpp, a file for each paper.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report.h"

namespace bdpt_experiments {

void veach_egg_room(Report& report);
void veach_shrinking_patch(Report& report);
void veach_roulette(Report& report);

void adamsen_light_up(Report& report);
void adamsen_glass_sphere(Report& report);

}  // namespace bdpt_experiments
