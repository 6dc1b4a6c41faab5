// What is compared: a plan, its techniques, and the options that differ.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "bdpt.h"

namespace bdpt_experiments {

struct Variant {
  std::string name;  // as the page calls it
  std::string plan = "one-to-one";
  std::string techniques = "all";  // in the syntax of bdpt render --techniques
  bdpt_heuristic heuristic = BDPT_HEURISTIC_POWER;
  std::uint32_t connections = 0, light_samples = 0;
  std::uint32_t pool_passes = 0, pool_pixels = 0;
  bdpt_matrix_kind matrix = BDPT_MATRIX_PER_TECHNIQUE;
  bdpt_order order = BDPT_ORDER_METRIC;
  bdpt_partners partners = BDPT_PARTNERS_SOBOL;
  bdpt_sampler sampler = BDPT_SAMPLER_SOBOL;
  bdpt_shadow_roulette roulette = BDPT_SHADOW_ROULETTE_NONE;
  float roulette_threshold = 0;
  bdpt_adaptive adaptive = BDPT_ADAPTIVE_NONE;
  bdpt_pool_selection pool_selection = BDPT_POOL_SELECTION_UNIFORM;
  bool correlation_aware = false;
  bdpt_light_start light_start = BDPT_LIGHT_START_POWER;
  std::uint32_t direct_samples = 0;  // points on each light at each eye vertex; 0 = one point on one light
};

Variant bidirectional();
Variant path_tracing();
Variant light_tracing();
// Of a lightmap: path tracing from the texel, with direct lighting at it.
Variant eye_only();
Variant of_plan(const std::string& plan);
// The same with independent random points, as most papers have them, instead of Sobol's.
Variant independent(Variant variant);

// What this build of the library lacks for the variant; empty when it lacks nothing.
std::string lacks(const Variant& variant);

// Passes that the variant takes at once; their number must be a multiple of it.
std::uint64_t passes_at_once(const Variant& variant);

// The variant must lack nothing, and must outlive the description.
bdpt_render_desc render_desc(const Variant& variant, std::uint32_t max_edges, std::uint64_t seed);

}  // namespace bdpt_experiments
