// Scenes whose pictures are known in closed form.
#include "rendering.h"

namespace bdpt::transport_closed_form_test {

using namespace rendering;
using scenes::Builder;
using scenes::Viewpoint;

const TechniqueMask kPath = mask_of([](int s, int) { return s <= 1; });
const TechniqueMask kLight = mask_of([](int s, int t) { return s >= 2 && t == 1; });

struct Case {
  std::string name;
  TransportOptions options;
};
// Hits alone, direct lighting alone, and everything.
std::vector<Case> ways_of_direct_light() {
  return {{"s = 0", options_for(mask_of([](int s, int) { return s == 0; }), 2)},
          {"s = 1", options_for(mask_of([](int s, int) { return s == 1; }), 2)},
          {"all", options_for({}, 2)}};
}

// --- Direct light on a floor y = 0; the camera looks straight down on the origin, from beneath the light ---

Viewpoint down(float height = 0.5f) { return {Vec3(0, height, 0), Vec3(0), 2}; }
scenes::MeshData floor_quad() { return scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1)); }

void expect_floor(const Builder& builder, double radiance, const std::vector<Case>& cases, const std::string& what) {
  const ScenePointer scene = builder.build();
  const SensorPointer camera = scenes::camera(down(), 8, 8);
  for (const Case& c : cases) {
    Effort effort;
    effort.passes = c.name == "s = 0" ? 200 : 40;
    const BlockMeans m = block_means(scene, camera, c.options, effort);
    expect_value(m.whole(), radiance, cases.size(), what + " by " + c.name, 2e-4 * radiance);
  }
}

// Form factor of a rectangle parallel to a point's plane, its corner above the point.
double corner_form_factor(double a, double b, double h) {
  const double x = a / h, y = b / h, u = std::sqrt(1 + x * x), v = std::sqrt(1 + y * y);
  return (x / u * std::atan(y / u) + y / v * std::atan(x / v)) / (2 * M_PI);
}

TEST(TransportClosedForm, RectangleLightOnADiffuseFloor) {
  Builder b;
  b.add(floor_quad(), scenes::diffuse(0.5f));
  b.add(
      scenes::quad(Vec3(-0.3f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, 0.4f), Vec3(-0.3f, 0.6f, 0.4f)),
      scenes::emitter(Rgb(3)));
  double factor = 0;
  for (double x : {0.3, 0.5})
    for (double z : {0.2, 0.4}) factor += corner_form_factor(x, z, 0.6);
  expect_floor(b, 0.5 * 3 * factor, ways_of_direct_light(), "rectangle");
}

TEST(TransportClosedForm, DiskLightOfManyTrianglesOnADiffuseFloor) {
  Builder b;
  b.add(floor_quad(), scenes::diffuse(0.5f));
  b.add(scenes::disk(Vec3(0, 0.6f, 0), Vec3(0, -1, 0), 0.4f, 64), scenes::emitter(Rgb(3)));
  const double factor = 0.16 / (0.16 + 0.36);
  expect_floor(b, 0.5 * 3 * factor, ways_of_direct_light(), "disk");
}

TEST(TransportClosedForm, SphereLightOnADiffuseFloor) {
  Builder b;
  b.add(floor_quad(), scenes::diffuse(0.5f));
  b.add_sphere(Vec3(0.6f, 0.9f, 0.2f), 0.3f, scenes::emitter(Rgb(3)));
  const double d2 = 0.36 + 0.81 + 0.04, cosine = 0.9 / std::sqrt(d2);
  expect_floor(b, 0.5 * 3 * 0.09 / d2 * cosine, ways_of_direct_light(), "sphere");
}

TEST(TransportClosedForm, PointAndSpotLightsOnADiffuseFloor) {
  const Vec3 p(0.6f, 0.9f, 0.2f);
  const double d2 = double(length_squared(p)), cosine = p.y / std::sqrt(d2);
  const double full = 0.5 / M_PI * 2 * cosine / d2;
  const auto floor_with = [](const auto& add) {
    Builder b;
    b.add(floor_quad(), scenes::diffuse(0.5f));
    add(b);
    return b;
  };
  const std::vector<Case> cases = {{"s = 1", options_for(kPath, 2)}, {"all", options_for({}, 2)}};
  expect_floor(floor_with([&](Builder& b) { b.point(p, Rgb(2)); }), full, cases, "point");
  // Within the inner cone, half way between the cosines, and outside.
  const double off[] = {10, 180 / M_PI * std::acos(0.5 * (std::cos(M_PI / 9) + std::cos(M_PI * 2 / 9))), 41};
  const double falloff[] = {1, 0.5, 0};
  for (int i = 0; i < 3; ++i) {
    const Vec3 to_origin = unit(-p), side = Frame(to_origin).t;
    const float angle = float(off[i] * M_PI / 180);
    const Vec3 axis = to_origin * std::cos(angle) + side * std::sin(angle);
    const Builder b = floor_with([&](Builder& builder) { builder.spot(p, axis, Rgb(2), 40, 20); });
    if (falloff[i] > 0) {
      expect_floor(b, full * falloff[i], cases, "spot " + std::to_string(i));
    } else {
      EXPECT_EQ(mean_of(*render(b.build(), scenes::camera(down(), 8, 8), options_for({}, 2), 4, 1).film), 0);
    }
  }
}

// The light image's normalisation: light tracing alone, in a wide view, against the floor's radiance at each pixel.
TEST(TransportClosedForm, LightTracingAloneGivesRadiance) {
  const Vec3 p(0.3f, 0.4f, 0.1f);
  Builder b;
  b.add(floor_quad(), scenes::diffuse(0.5f));
  b.point(p, Rgb(2));
  const ScenePointer scene = b.build();
  const Viewpoint view{Vec3(0, 0.8f, 0), Vec3(0), 80};
  const SensorPointer camera = scenes::camera(view, 8, 8);
  // The camera's right is +x, its up -z.
  const double half = 0.8 * std::tan(40 * M_PI / 180);
  std::vector<double> expected;
  constexpr int n = 32;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) {
      double sum = 0;
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const double fx = (x - 1 + (i + 0.5) / n) * half, fz = (y - 1 + (j + 0.5) / n) * half;
          const double dx = fx - p.x, dz = fz - p.z, d2 = dx * dx + dz * dz + p.y * p.y;
          sum += 0.5 / M_PI * 2 * p.y / (d2 * std::sqrt(d2)) / (n * n);
        }
      expected.push_back(sum);
    }
  Effort effort;
  effort.passes = 512;
  effort.side = 4;
  TransportOptions options = options_for(kLight, 2);
  options.sampler = SamplerType::Sobol;
  const BlockMeans m = block_means(scene, camera, options, effort);
  for (size_t i = 0; i < 4; ++i) expect_value(m.values[i], expected[i], 4, "quarter " + std::to_string(i), 3e-4);
}

// --- Furnaces ---

void expect_radiance(const Builder& builder, const Viewpoint& view, double radiance, const TransportOptions& options,
                     uint64_t passes, const std::string& what) {
  Effort effort;
  effort.passes = passes;
  const BlockMeans m = block_means(builder.build(), scenes::camera(view, 16, 16), options, effort);
  for (const Estimate& e : m.values) expect_value(e, radiance, m.values.size(), what, 2e-4 * radiance);
}

TEST(TransportClosedForm, FurnaceOfAClosedBox) {
  Builder b;
  b.add(scenes::box(Vec3(-1), Vec3(1), true), scenes::emitter(Rgb(1), false, 0.5f));
  const Viewpoint view{Vec3(0.2f, 0.1f, 0.5f), Vec3(-0.3f, -0.2f, -1), 60};
  expect_radiance(b, view, 2, options_for(kPath), 4, "path");
  TransportOptions late = options_for();
  expect_radiance(b, view, 2, late, 6, "all");
  late.roulette_start = 1;
  expect_radiance(b, view, 2, late, 12, "all, roulette from the start");
  late.techniques = kPath;
  expect_radiance(b, view, 2, late, 64, "path, roulette from the start");
  late.roulette_start = 12;
  expect_radiance(b, view, 2, late, 6, "all, late roulette");
}

TEST(TransportClosedForm, FurnaceWithinASphere) {
  Builder b;
  b.add_sphere(Vec3(0), 1, scenes::emitter(Rgb(1), true, 0.5f));
  const Viewpoint view{Vec3(0.2f, 0.1f, 0.5f), Vec3(-0.3f, -0.2f, -1), 60};
  expect_radiance(b, view, 2, options_for(mask_of([](int s, int) { return s == 0; })), 4, "s = 0");
  expect_radiance(b, view, 2, options_for(kPath), 8, "path");
  expect_radiance(b, view, 2, options_for(), 8, "all");
}

// What neither absorbs nor emits is invisible before a constant environment.
TEST(TransportClosedForm, LosslessObjectsInAConstantEnvironmentVanish) {
  Material white = scenes::conductor(0, 0);
  white.eta = Rgb(0), white.k = Rgb(3);
  const Viewpoint view{Vec3(0, 0, 1.5f), Vec3(0), 90};
  const std::vector<std::pair<std::string, Material>> materials = {{"diffuse", scenes::diffuse(1)},
                                                                   {"mirror", scenes::mirror()},
                                                                   {"smooth conductor", white},
                                                                   {"glass", scenes::dielectric(1.5f)}};
  for (const auto& [name, material] : materials) {
    Builder b;
    b.add_sphere(Vec3(0), 1, material);
    b.environment(Rgb(2));
    expect_radiance(b, view, 2, options_for(kPath), 4, name + ", path");
    expect_radiance(b, view, 2, options_for(), 4, name + ", all");
  }
}

// The disk from which light of the environment comes covers the lens too, even one far outside of the scene.
TEST(TransportClosedForm, EnvironmentSeenThroughALensOutsideOfTheScene) {
  Builder b;
  b.add_sphere(Vec3(0), 0.2f, scenes::diffuse(1));
  b.environment(Rgb(2));
  Viewpoint view{Vec3(0, 0, 2), Vec3(0), 60};
  view.lens_radius = 0.2f;
  view.focus = 2;
  expect_radiance(b, view, 2, options_for(kPath), 4, "path");
  TransportOptions options = options_for();
  options.heuristic = Heuristic::Balance;  // gives unlikely techniques the most weight
  expect_radiance(b, view, 2, options, 16, "all");
  options.heuristic = Heuristic::Cutoff;  // the plain loop
  options.cutoff = 1e-3f;
  expect_radiance(b, view, 2, options, 16, "all, cutoff");
}

// --- Directly seen light ---

TEST(TransportClosedForm, LightsSeenDirectlyHaveTheirRadiance) {
  const Viewpoint view{Vec3(0, 0, 1), Vec3(0), 60};
  for (const bool sphere : {false, true}) {
    Builder b;
    if (sphere)
      b.add_sphere(Vec3(0, 0, -1), 1.5f, scenes::emitter(Rgb(2)));
    else
      b.add(scenes::quad(Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)), scenes::emitter(Rgb(2)));
    for (float lens : {0.0f, 0.4f}) {
      Viewpoint v = view;
      v.lens_radius = lens;
      const std::string what = (sphere ? "sphere" : "quad") + std::string(lens > 0 ? ", lens" : ", pinhole");
      expect_radiance(b, v, 2, options_for(only(0, 2)), 1, what + ", (0,2)");
      expect_radiance(b, v, 2, options_for(only(1, 1)), 40, what + ", (1,1)");
      expect_radiance(b, v, 2, options_for(), 10, what + ", all");
      if (lens > 0) expect_radiance(b, v, 2, options_for(only(2, 0)), 100, what + ", (2,0)");
    }
  }
}

// The light from behind is dark, unless the light has two sides.
TEST(TransportClosedForm, OneSidedLightIsDarkFromBehind) {
  for (const bool two_sided : {false, true}) {
    Builder b;
    b.add(scenes::quad(Vec3(-1, -1, 0), Vec3(-1, 1, 0), Vec3(1, 1, 0), Vec3(1, -1, 0)),
          scenes::emitter(Rgb(2), two_sided));
    const Viewpoint view{Vec3(0, 0, 1), Vec3(0), 60};
    expect_radiance(b, view, two_sided ? 2 : 0, options_for(), 10, two_sided ? "two-sided" : "one-sided");
  }
}

// An edge twice as far as the focus: a pixel looking at distance e beside it (at the edge's depth) sees the part of
// the lens from which the emitter beyond x = 0 is in line, a segment of the lens' disk.
TEST(TransportClosedForm, ThinLensBlursAnEdgeByTheSegmentOfADisk) {
  Builder b;
  b.add(scenes::quad(Vec3(0, -9, -2), Vec3(9, -9, -2), Vec3(9, 9, -2), Vec3(0, 9, -2)), scenes::emitter(Rgb(2)));
  Viewpoint view{Vec3(0), Vec3(0, 0, -1), 20};
  view.lens_radius = 0.1f;
  view.focus = 1;
  const SensorPointer camera = scenes::camera(view, 16, 16);
  // A ray from the lens at l through the focused point f reaches x = l + 2 (f - l) = 2 f - l: lit where l < 2 f.
  const double half = std::tan(10 * M_PI / 180);
  std::vector<double> expected(8);
  for (int column = 0; column < 8; ++column)
    for (int i = 0; i < 64; ++i) {
      const double h = std::clamp(2 * half * ((column * 2 + (i + 0.5) / 32) / 8 - 1) / 0.1, -1.0, 1.0);
      expected[size_t(column)] += 2 * (1 - (std::acos(h) - h * std::sqrt(1 - h * h)) / M_PI) / 64;
    }
  for (const auto& [mask, passes] : {std::pair(only(0, 2), 40), std::pair(TechniqueMask(), 40)}) {
    Effort effort;
    effort.passes = uint64_t(passes);
    effort.side = 2;
    const BlockMeans m = block_means(b.build(), camera, options_for(mask, 1), effort);
    for (size_t i = 0; i < 64; ++i) {
      const std::string what = "column " + std::to_string(i % 8);
      if (expected[i % 8] < 1e-9 || expected[i % 8] > 2 - 1e-9)
        EXPECT_NEAR(m.values[i].mean(), expected[i % 8], 0.2) << what;
      else
        expect_value(m.values[i], expected[i % 8], 128, what, 1e-3);
    }
  }
}

}  // namespace bdpt::transport_closed_form_test
