// Each material: its value for two directions, and a sample.
//
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "material/material.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace {

struct Named {
  const char* name;
  bdpt::Material material;
};

// Half a metal below a thin film.
bdpt::Material iridescent(bdpt::Material m) {
  m.metalness = 0.5f;
  m.film = 1, m.film_thickness = 400;
  return m;
}

std::vector<Named> materials() {
  const auto make = [](bdpt::MaterialType type, float alpha_u, float alpha_v) {
    bdpt::Material m;
    m.type = type;
    m.reflectance = bdpt::Rgb(0.5f);
    m.eta = {0.2f, 0.92f, 1.1f};
    m.k = {3.9f, 2.45f, 2.14f};
    m.alpha_u = alpha_u;
    m.alpha_v = alpha_v;
    return m;
  };
  using enum bdpt::MaterialType;
  return {{"diffuse", make(Diffuse, 0, 0)},
          {"mirror", make(Mirror, 0, 0)},
          {"smooth_conductor", make(Conductor, 0, 0)},
          {"rough_conductor", make(Conductor, 0.2f, 0.2f)},
          {"anisotropic_conductor", make(Conductor, 0.1f, 0.3f)},
          {"smooth_dielectric", make(Dielectric, 0, 0)},
          {"rough_dielectric", make(Dielectric, 0.2f, 0.2f)},
          {"coated_diffuse", make(CoatedDiffuse, 0.2f, 0.2f)},
          {"coated_conductor", make(CoatedConductor, 0.2f, 0.2f)},
          {"principled", make(Principled, 0.2f, 0.2f)},
          {"iridescent", iridescent(make(Principled, 0.2f, 0.2f))}};
}

constexpr std::uint32_t kDraws = 1024;

// Numbers are drawn beforehand: they are no part of what is measured.
std::vector<bdpt::Four> draws() {
  std::vector<bdpt::Four> fours;
  for (std::uint32_t i = 0; i < kDraws; ++i) fours.push_back(bdpt::independent4({7, i}, 0));
  return fours;
}

void evaluate(benchmark::State& state, const bdpt::Material& material) {
  std::vector<bdpt::Vec3> a, b;
  for (const bdpt::Four& u : draws()) {
    a.push_back(bdpt::sample_cosine_hemisphere(u[0], u[1]));
    b.push_back(bdpt::sample_cosine_hemisphere(u[2], u[3]));
  }
  std::uint32_t i = 0;
  for ([[maybe_unused]] const auto _ : state) {
    benchmark::DoNotOptimize(bdpt::evaluate(material, material.reflectance, a[i], b[i], bdpt::TransportMode::Radiance));
    i = (i + 1) % kDraws;
  }
  state.SetItemsProcessed(state.iterations());
}

void sample(benchmark::State& state, const bdpt::Material& material) {
  const std::vector<bdpt::Four> fours = draws();
  std::vector<bdpt::Vec3> previous;
  previous.reserve(fours.size());
  for (const bdpt::Four& u : fours) previous.push_back(bdpt::sample_cosine_hemisphere(u[2], u[3]));
  std::uint32_t i = 0;
  for ([[maybe_unused]] const auto _ : state) {
    benchmark::DoNotOptimize(
        bdpt::sample(material, material.reflectance, previous[i], bdpt::TransportMode::Radiance, fours[i].u));
    i = (i + 1) % kDraws;
  }
  state.SetItemsProcessed(state.iterations());
}

const bool registered = [] {
  for (const Named& named : materials()) {
    const auto name = [&](const char* what) { return std::string(what) + "/" + named.name; };
    const bdpt::Material material = named.material;
    if (!material.is_specular())
      benchmark::RegisterBenchmark(name("evaluate").c_str(), [material](auto& state) { evaluate(state, material); });
    benchmark::RegisterBenchmark(name("sample").c_str(), [material](auto& state) { sample(state, material); });
  }
  return true;
}();

}  // namespace
