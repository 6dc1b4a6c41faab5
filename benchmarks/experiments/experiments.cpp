// SPDX-License-Identifier: Apache-2.0
#include "experiment.h"

#include "rows/rows.h"

namespace bdpt_experiments {
namespace {

const Experiment kExperiments[] = {
    {"veach-10.3", "Veach (1997), 10.5", "The room with the glass egg",
     "In the same time bidirectional path tracing (25 samples a pixel) shows far less noise than path tracing (56).",
     veach_egg_room},
    {"veach-10.7", "Veach (1997), 10.7", "A lit patch that shrinks",
     "The variance of path tracing grows without bound as the directly lit part of the ceiling shrinks; that of "
     "bidirectional path tracing hardly changes.",
     veach_shrinking_patch},
    {"adamsen-14", "Adamsen (2009), 8", "Cornell box, light down and turned up",
     "Light down: bidirectional path tracing is a little noisier in the same time. Light up: it is unchanged, and path "
     "tracing far worse.",
     adamsen_light_up},
};

}  // namespace

std::span<const Experiment> experiments() { return kExperiments; }

}  // namespace bdpt_experiments
