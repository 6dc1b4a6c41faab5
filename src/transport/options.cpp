#include "transport/options.h"

#include "sampling/hash.h"
#include "transport/plan.h"

#include <cstring>

namespace bdpt {

uint64_t TransportOptions::hash() const {
  uint64_t h = hash_values(max_edges, int(heuristic), int(sampler), sampler == SamplerType::Stratified ? strata : 0,
                           int(light_start), roulette_start);
  h = hash_bytes(techniques.rows.data(), sizeof(techniques.rows), h);
  const float numbers[] = {heuristic == Heuristic::Power ? beta : 0, heuristic == Heuristic::Cutoff ? cutoff : 0};
  h = hash_bytes(numbers, sizeof(numbers), h);
  if (plan && plan != kPlans[0]) h = hash_bytes(plan->name, std::strlen(plan->name), h);
  if (connections != 0 || light_samples != 1 || pool_passes != 0)
    h = hash_values(h, connections, light_samples, pool_passes);
  if (order != Order::Metric || partners != Partners::Sobol) h = hash_values(h, int(order), int(partners));
  if (pool_pixels != 0 || matrix != Matrix::PerTechnique) {
    constexpr uint64_t pool = 0x6c6f6f70;  // unlike any numbers above
    h = hash_values(h, pool, pool_pixels, int(matrix));
  }
  if (shadow_roulette != Roulette::None) {
    h = hash_values(h, int(shadow_roulette));
    if (shadow_roulette == Roulette::Fixed) h = hash_bytes(&shadow_threshold, sizeof(shadow_threshold), h);
  }
  if (pool_selection != PoolSelection::Uniform) {
    constexpr uint64_t pool = 0x6c6f6f70;  // unlike any numbers above
    h = hash_values(h, pool, int(pool_selection));
  }
  if (correlation_aware) {
    constexpr uint64_t correlation = 0x6c6572726f63;
    h = hash_values(h, correlation);
  }
  if (chain_pixels != 0 || chain_candidates != 0) h = hash_values(h, chain_pixels, chain_candidates);
  if (light_selection != LightSelection::Power || direct_samples != 1 || direct_candidates != 1) {
    constexpr uint64_t direct = 0x746365726964;  // unlike any numbers above
    h = hash_values(h, direct, int(light_selection), direct_samples, direct_candidates);
  }
  if (adaptive != Adaptive::None) {
    constexpr uint64_t own = 0x6576697470616461;
    h = hash_values(h, own, int(adaptive));
  }
  return h;
}

}  // namespace bdpt
