// SPDX-License-Identifier: Apache-2.0
#include "variant.h"

#include <algorithm>

#include "handles.h"
#include "technique_mask.h"
#include "transport/plan.h"

namespace bdpt_experiments {
namespace {

// Where the library takes shadow rays' roulette, this is the one place to say so.
bool set_roulette(bdpt_render_desc&, Roulette roulette) { return roulette == Roulette::None; }

// Several samples of direct lighting, where the library's description has them.
template <class Desc>
bool set_direct_samples(Desc& desc, std::uint32_t samples) {
  if (samples == 0) return true;
  if constexpr (requires { desc.direct_samples, desc.light_selection; }) {
    desc.direct_samples = samples;
    desc.light_selection = 3;  // each light
    return true;
  }
  return false;
}

}  // namespace

Variant bidirectional() { return {.name = "BDPT"}; }
Variant path_tracing() { return {.name = "path tracing", .techniques = "s<=1&t>=2"}; }
Variant light_tracing() { return {.name = "light tracing", .techniques = "t<=1"}; }
Variant of_plan(const std::string& plan) { return {.name = plan, .plan = plan}; }

Variant independent(Variant variant) {
  variant.sampler = BDPT_SAMPLER_INDEPENDENT;
  return variant;
}

std::string lacks(const Variant& variant) {
  if (!bdpt::find_plan(variant.plan.c_str())) return "the plan " + variant.plan;
  auto desc = bdpt_tool::sized<bdpt_render_desc>();
  if (!set_roulette(desc, variant.roulette)) return "Russian roulette on shadow rays";
  if (!set_direct_samples(desc, variant.direct_samples)) return "several samples of each light at a vertex";
  return "";
}

std::uint64_t passes_at_once(const Variant& variant) { return bdpt::find_plan(variant.plan.c_str())->passes; }

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
  desc.order = variant.order;
  desc.sampler = variant.sampler;
  set_roulette(desc, variant.roulette);
  set_direct_samples(desc, variant.direct_samples);
  return desc;
}

}  // namespace bdpt_experiments
