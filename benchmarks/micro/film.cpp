// Contributions to the film, at scattered positions as light subpaths have them.
//
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "film/film.h"
#include "sampling/sampler.h"

namespace {

constexpr int kSize = 256;
constexpr std::uint32_t kPositions = 4096;

std::unique_ptr<bdpt::Film> make_film(bdpt::FilterType filter) {
  bdpt::FilmDesc desc;
  desc.width = desc.height = kSize;
  desc.filter.type = filter;
  return std::make_unique<bdpt::Film>(desc, std::make_shared<bdpt::MemoryMeter>(0));
}

std::vector<bdpt::FilmPosition> positions() {
  std::vector<bdpt::FilmPosition> all;
  for (std::uint32_t i = 0; i < kPositions; ++i) {
    const bdpt::Four u = bdpt::independent4({11, i}, 0);
    all.push_back({kSize * u[0], kSize * u[1]});
  }
  return all;
}

enum class Image { Eye, Light };

void splat(benchmark::State& state, Image image, bdpt::FilterType filter) {
  const auto film = make_film(filter);
  const auto where = positions();
  std::uint32_t i = 0;
  for (auto _ : state) {
    const bdpt::Rgb value(0.3f, 0.2f, 0.1f);
    if (image == Image::Eye)
      film->add_eye_sample(where[i], value);
    else
      film->add_light_sample(where[i], value);
    i = (i + 1) % kPositions;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(splat, eye_box, Image::Eye, bdpt::FilterType::Box);
BENCHMARK_CAPTURE(splat, eye_gaussian, Image::Eye, bdpt::FilterType::Gaussian);
BENCHMARK_CAPTURE(splat, light_box, Image::Light, bdpt::FilterType::Box);
BENCHMARK_CAPTURE(splat, light_gaussian, Image::Light, bdpt::FilterType::Gaussian);

}  // namespace
