// What many lights cost: one hall, one view, the same power over the same ceiling, shared out to few lamps or to many;
// by path tracing and bidirectionally, for each way of choosing a light. Variance times time says what a picture costs.
//
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "render/render.h"
#include "scenes.h"
#include "this_thread.h"
#include "timing.h"
#include "variance.h"

namespace bdpt {
namespace {

constexpr int kWidth = 96, kHeight = 64, kMaxEdges = 5;
constexpr uint64_t kPasses = 4;

using bdpt_benchmark::processor_seconds;
using bdpt_benchmark::this_thread;

std::shared_ptr<const Scene> hall(int lamps) {
  scenes::Builder b;
  const Vec3 low(-5, 0, -5), high(5, 3, 5);
  b.add(scenes::box(low, high, true), scenes::diffuse(0.6f));
  for (int i = 0; i < 9; ++i) {
    const Vec3 at(float(i % 3) * 2.5f - 2.5f, 0, float(i / 3) * 2.5f - 3);
    b.add(scenes::box(at - Vec3(0.3f, 0, 0.3f), at + Vec3(0.3f, 0.5f + 0.2f * float(i % 4), 0.3f), false),
          scenes::diffuse(Rgb(0.7f, 0.5f, 0.3f)));
  }
  const float side = std::sqrt(0.5f / float(lamps)) / 2;  // half a square metre in all
  for (int i = 0; i < lamps; ++i) {
    // Evenly spread, however many (Roberts's sequence).
    const auto place = [&](double step) {
      double whole;
      return float(std::modf(0.5 + i * step, &whole));
    };
    const float x = 9.5f * place(0.7548776662466927) - 4.75f, z = 9.5f * place(0.5698402909980532) - 4.75f;
    const float y = 2.9f - 0.3f * place(0.6180339887498949);
    b.add(scenes::quad(Vec3(x - side, y, z - side), Vec3(x + side, y, z - side), Vec3(x + side, y, z + side),
                       Vec3(x - side, y, z + side)),
          scenes::emitter(Rgb(20)));
  }
  return b.build();
}

struct Method {
  std::string name;
  bool path;
  LightSelection selection;
  int samples = 1, candidates = 1;
};

struct Case {
  Method method;
  int lamps;
  std::shared_ptr<const Scene> scene;
  double seconds = 0, build = 0;
  bdpt_benchmark::ImageVariance variance;
  double cost() const { return seconds * variance.relative(); }
};

void run(Case& c, const std::shared_ptr<const Sensor>& camera, uint64_t seed) {
  FilmDesc film;
  film.width = kWidth, film.height = kHeight;
  RenderDesc desc;
  desc.seed = seed;
  desc.transport.max_edges = kMaxEdges;
  if (c.method.path) desc.transport.techniques.rows.fill(0);
  for (size_t s = 0; c.method.path && s < 2; ++s) desc.transport.techniques.rows[s] = ~3u;
  desc.transport.light_selection = c.method.selection;
  desc.transport.direct_samples = c.method.samples;
  desc.transport.direct_candidates = c.method.candidates;
  double begin = processor_seconds();
  const auto picture = std::make_shared<Film>(film, nullptr);
  Render render(c.scene, camera, picture, this_thread(), nullptr, desc);
  c.build += processor_seconds() - begin;
  AdvanceDesc advance;
  advance.passes = kPasses;
  begin = processor_seconds();
  render.advance(advance);
  c.seconds += processor_seconds() - begin;
  std::vector<float> pixels(size_t(3) * kWidth * kHeight), grey;
  picture->read(FilmLayer::Color, 0, 0, {0, 0, kWidth, kHeight}, false, pixels.data(), size_t(kWidth) * 3);
  for (size_t i = 0; i < pixels.size(); i += 3) grey.push_back((pixels[i] + pixels[i + 1] + pixels[i + 2]) / 3);
  c.variance.add(grey);
}

}  // namespace
}  // namespace bdpt

int main(int argc, char** argv) {
  using namespace bdpt;
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 16;
  const std::string only = argc > 2 ? argv[2] : "";
  if (seeds < 2) return std::fprintf(stderr, "usage: bdpt_many_lights [SEEDS (2 or more) [METHOD]]\n"), 2;
  const auto camera =
      scenes::camera({.from = Vec3(4.5f, 2.4f, 4.5f), .to = Vec3(0.5f, 0, 0.5f), .field_of_view = 40}, kWidth, kHeight);
  const Method methods[] = {{"path, power", true, LightSelection::Power},
                            {"path, tree", true, LightSelection::Tree},
                            {"path, tree, 4 candidates", true, LightSelection::Tree, 1, 4},
                            {"path, tree, 4 samples", true, LightSelection::Tree, 4, 1},
                            {"bdpt, power", false, LightSelection::Power},
                            {"bdpt, tree", false, LightSelection::Tree},
                            {"bdpt, tree, 4 candidates", false, LightSelection::Tree, 1, 4},
                            {"bdpt, tree, 4 samples", false, LightSelection::Tree, 4, 1}};
  const int lamps[] = {10, 100, 1000, 10000};
  std::vector<Case> cases;
  for (int n : lamps) {
    const auto scene = hall(n);
    for (const Method& m : methods)
      if (m.name.find(only) != std::string::npos) cases.push_back({m, n, scene, 0, 0, {}});
  }
  for (int seed = 0; seed <= seeds; ++seed)  // by turns; the first warms up
    for (Case& c : cases) {
      run(c, camera, uint64_t(seed));
      if (seed == 0) c = {c.method, c.lamps, c.scene, 0, 0, {}};
    }

  std::map<std::string, double> few;  // cost with ten lamps and the same method
  std::printf(
      "| method | lights | us per sample | mean | relative variance | variance x time, to 10 lights | ms to begin |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n");
  const double samples = double(seeds) * kPasses * kWidth * kHeight;
  for (const Method& m : methods)
    for (const Case& c : cases) {
      if (c.method.name != m.name) continue;
      if (c.lamps == lamps[0]) few[m.name] = c.cost();
      std::printf("| %s | %d | %.2f | %.4f | %.4f | %.2f | %.1f |\n", m.name.c_str(), c.lamps,
                  1e6 * c.seconds / samples, c.variance.image_mean(), c.variance.relative(), c.cost() / few[m.name],
                  1e3 * c.build / seeds);
    }
  return 0;
}
