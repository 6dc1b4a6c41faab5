// What the engine may be asked to do otherwise.
#pragma once

#include "light/direct_lighting.h"

#include <array>
#include <cstdint>

namespace bdpt {

enum class Heuristic { Power, Balance, Cutoff, Maximum, Average, None };
// Roulette of shadow rays.
enum class Roulette { None, Fixed, Efficiency };
// Of the image plane.
enum class Adaptive { None, TwoStages };
// By what light subpaths choose their light: importance is what a pilot found a light to matter in this view.
enum class StartBy { Power, Uniform, Importance };
enum class SamplerType { Sobol, Independent, Stratified };

// Which techniques (s,t) take part: bit t of row s, 31 standing for 31 and more.
struct TechniqueMask {
  std::array<uint32_t, 32> rows;
  TechniqueMask() { rows.fill(~0u); }
  bool allows(int s, int t) const { return rows[s < 31 ? s : 31] >> (t < 31 ? t : 31) & 1u; }
  bool operator==(const TechniqueMask&) const = default;
};

struct Plan;  // plan.h

// By what the matrix plan puts subpaths in order, and how it chooses partners in that order.
enum class Order { Metric, Hilbert, None };
enum class Partners { Sobol, LatinHypercube };
// A matrix for each technique (s,t), or one for all.
enum class Matrix { PerTechnique, AllLengths };

// How the pooled plan chooses among the light vertices of a pass.
enum class PoolSelection { Uniform, Importance };

struct TransportOptions {
  const Plan* plan = nullptr;  // nullptr = one to one
  int connections = 0;    // light vertices that an eye vertex meets, where the plan lets choose; 0 = its own number
  int light_samples = 1;  // light subpaths for each eye subpath
  int pool_passes = 0;    // passes that the plan takes at once, where it does; 0 = its own number
  int pool_pixels = 0;    // pixels of a pool's square, where the plan lets choose; 0 = its own number
  Matrix matrix = Matrix::PerTechnique;
  Order order = Order::Metric;
  Partners partners = Partners::Sobol;
  PoolSelection pool_selection = PoolSelection::Uniform;
  int chain_pixels = 0;      // mmlt: pixels whose mutations one chain makes, in each pass; 0 = its own number
  int chain_candidates = 0;  // mmlt: samples of Veach's plan for each chain; 0 = its own number
  int max_edges = 0;         // longest path k; 0 = no limit
  TechniqueMask techniques;
  Heuristic heuristic = Heuristic::Power;
  float beta = 2;
  float cutoff = 0;
  bool correlation_aware = false;  // correlation.h
  SamplerType sampler = SamplerType::Sobol;
  int strata = 4;
  StartBy light_start = StartBy::Power;
  LightSelection light_selection = LightSelection::Power;  // of direct lighting alone
  int direct_samples = 1;     // light vertices of direct lighting at each eye vertex; where lights take turns, of each
  int direct_candidates = 1;  // of so many, each of them is chosen by its contribution
  int roulette_start = 4;
  Roulette shadow_roulette = Roulette::None;
  float shadow_threshold = 0;  // Fixed: delta, in units of a pixel's value
  Adaptive adaptive = Adaptive::None;
  uint64_t hash() const;
};

}  // namespace bdpt
