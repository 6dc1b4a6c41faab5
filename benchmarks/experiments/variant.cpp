// SPDX-License-Identifier: Apache-2.0
#include "variant.h"

#include <algorithm>

#include "handles.h"
#include "technique_mask.h"
#include "transport/plan.h"

namespace bdpt_experiments {
Variant bidirectional() { return {.name = "BDPT"}; }
Variant path_tracing() { return {.name = "path tracing", .techniques = "s<=1&t>=2"}; }
Variant eye_only() { return {.name = "eye-only", .techniques = "s<=1&t>=1"}; }
Variant light_tracing() { return {.name = "light tracing", .techniques = "t<=1"}; }
Variant of_plan(const std::string& plan) { return {.name = plan, .plan = plan}; }

Variant independent(Variant variant) {
  variant.sampler = BDPT_SAMPLER_INDEPENDENT;
  return variant;
}

std::string lacks(const Variant& variant) {
  if (!bdpt::find_plan(variant.plan.c_str())) return "the plan " + variant.plan;
  return "";
}

std::uint64_t passes_at_once(const Variant& variant) {
  return variant.pool_passes > 0 ? variant.pool_passes : bdpt::find_plan(variant.plan.c_str())->passes;
}

bdpt_render_desc render_desc(const Variant& variant, std::uint32_t max_edges, std::uint64_t seed) {
  auto desc = bdpt_tool::sized<bdpt_render_desc>();
  desc.max_edges = max_edges;
  desc.seed = seed;
  desc.plan = variant.plan.c_str();
  const bdpt_tool::TechniqueMask mask = bdpt_tool::parse_technique_mask(variant.techniques);
  std::copy(mask.begin(), mask.end(), desc.techniques);
  desc.heuristic = variant.heuristic;
  desc.connections = variant.connections;
  desc.light_samples = variant.light_samples;
  desc.pool_passes = variant.pool_passes;
  desc.pool_pixels = variant.pool_pixels;
  desc.matrix = variant.matrix;
  desc.order = variant.order;
  desc.partners = variant.partners;
  desc.sampler = variant.sampler;
  desc.shadow_roulette = variant.roulette;
  desc.shadow_threshold = variant.roulette_threshold;
  desc.adaptive = variant.adaptive;
  desc.pool_selection = variant.pool_selection;
  desc.correlation_aware = variant.correlation_aware;
  desc.light_start = variant.light_start;
  desc.direct_samples = variant.direct_samples;
  if (variant.direct_samples > 0) desc.light_selection = BDPT_LIGHT_SELECTION_EACH;
  return desc;
}

}  // namespace bdpt_experiments
