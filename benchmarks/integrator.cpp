// SPDX-License-Identifier: Apache-2.0
#include "integrator.h"

#include "transport/plan.h"

namespace bdpt_benchmark {
namespace {

constexpr int kMaxEdges = 6;

template <class Allows>
Integrator make(const char* name, Allows allows, const char* plan = "one-to-one") {
  Integrator integrator;
  integrator.name = name;
  integrator.options.max_edges = kMaxEdges;
  integrator.options.plan = bdpt::find_plan(plan);
  for (unsigned s = 0; s < 32; ++s) {
    integrator.options.techniques.rows[s] = 0;
    for (unsigned t = 0; t < 32; ++t)
      if (allows(s, t)) integrator.options.techniques.rows[s] |= 1u << t;
  }
  return integrator;
}

}  // namespace

std::vector<Integrator> integrators() {
  const auto all = [](unsigned, unsigned) { return true; };
  return {make("path", [](unsigned s, unsigned t) { return s <= 1 && t >= 2; }),
          make("light", [](unsigned, unsigned t) { return t <= 1; }),
          make("two-way", all, "two-way"),
          make("pooled", all, "pooled"),
          make("matrix", all, "matrix"),
          make("bdpt", all)};
}

}  // namespace bdpt_benchmark
