// Random numbers.
//
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "sampling/sampler.h"

namespace {

template <bdpt::Four (*draw)(const bdpt::Stream&, std::uint32_t)>
void four(benchmark::State& state) {
  bdpt::Stream stream{0x853c49e6748fea9bull, 0};
  for (auto _ : state) {
    benchmark::DoNotOptimize(draw(stream, stream.index & 31));
    ++stream.index;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(four<bdpt::sobol4>)->Name("sobol4");
BENCHMARK(four<bdpt::independent4>)->Name("independent4");

}  // namespace
