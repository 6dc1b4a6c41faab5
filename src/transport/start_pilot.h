// By what light subpaths choose their light in this view (Veach 10.7): the lights that a pilot found to matter.
//
// A light subpath's contribution is c / p, p its light's probability, and the variance of their sum is that of
// sum_l E[c^2 | l] / p_l. It is least for p_l in proportion to the root of E[c^2 | l], not to the mean: a light that
// matters as much as another, but by few of its subpaths, needs more of them. c is taken relative to what it falls on,
// as everywhere in this project: c^2 / (mean^2 + 0.01 M^2).
#pragma once

#include "transport/engine.h"

namespace bdpt {

struct StartPilot {
  Discrete starts;  // over the lights; empty where there is nothing to choose, or nothing was found
  TransportStats stats;
};

// Some thousand samples of Veach's plan, of reserved numbers, all over the film; they measure nothing. Lights that the
// pilot does not know take their part by power, and every light that power reaches keeps a part.
StartPilot pilot_starts(const Engine& engine);

}  // namespace bdpt
