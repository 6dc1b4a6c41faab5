// Measurements whose values are known: form factors, uniform skies, fluxes, charts of unequal density.
#include "baking.h"

namespace bdpt::bake_closed_form_test {

using namespace baking;
using scenes::Builder;

// The mean over many seeds of plane `plane` of a sensor of one measurement.
Estimate value_of(const ScenePointer& scene, const SensorPointer& sensor, const TransportOptions& options, int plane,
                  int seeds = 32, uint64_t passes = 64) {
  Estimate e;
  for (int seed = 0; seed < seeds; ++seed) {
    const Picture p = render(scene, sensor, options, passes, uint64_t(seed));
    e.add(double(read(*p.film, FilmLayer::Color, 0, 0, plane)[0]));
    EXPECT_EQ(p.film->rejected(), 0u);
  }
  return e;
}

void expect_within(const Estimate& e, double value, double relative, const std::string& what) {
  expect_value(e, value, 64, what, 1e-5 * value);
  EXPECT_LT(e.standard_error(), relative * value) << what;
}

// Direct light alone. Seeds are independent, whatever the points of one seed are.
Way way_of_direct(const char* name, const std::function<bool(int, int)>& allows) {
  TransportOptions options = options_for(mask_of(allows), 1);
  options.sampler = SamplerType::Sobol;
  return {name, options};
}
std::vector<Way> ways_of_direct() {
  return {way_of_direct("s = 0", [](int s, int) { return s == 0; }),
          way_of_direct("s = 1", [](int s, int) { return s == 1; }),
          way_of_direct("all", [](int, int) { return true; })};
}

// Form factor of a rectangle parallel to a point's plane, its corner above the point.
double corner_form_factor(double a, double b, double h) {
  const double x = a / h, y = b / h, u = std::sqrt(1 + x * x), v = std::sqrt(1 + y * y);
  return (x / u * std::atan(y / u) + y / v * std::atan(x / v)) / (2 * M_PI);
}

TEST(BakeClosedForm, FormFactorsOfARectangleAndADisk) {
  Builder rectangle;
  rectangle.add(
      scenes::quad(Vec3(-0.3f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, 0.4f), Vec3(-0.3f, 0.6f, 0.4f)),
      scenes::emitter(Rgb(3)));
  double factor = 0;
  for (double x : {0.3, 0.5})
    for (double z : {0.2, 0.4}) factor += corner_form_factor(x, z, 0.6);
  Builder disk;
  disk.add(scenes::disk(Vec3(0, 0.6f, 0), Vec3(0, -1, 0), 0.4f, 256), scenes::emitter(Rgb(3)));
  const SensorPointer point = points({{Vec3(0), Vec3(0, 1, 0)}},
                                     {OutputDesc{OutputKind::Irradiance}, OutputDesc{OutputKind::IrradianceOverPi}});
  for (const Way& way : ways_of_direct()) {
    const uint64_t passes = way.name == "s = 0" ? 8192 : 1024;
    expect_within(value_of(rectangle.build(), point, way.options, 0, 32, passes), 3 * M_PI * factor, 2e-3,
                  "rectangle by " + way.name);
    expect_within(value_of(rectangle.build(), point, way.options, 1, 32, passes), 3 * factor, 2e-3,
                  "rectangle, over pi, by " + way.name);
    expect_within(value_of(disk.build(), point, way.options, 0, 32, passes), 3 * M_PI * 0.16 / (0.16 + 0.36), 2e-3,
                  "disk by " + way.name);
  }
}

// A point that sees all of a sky of radiance 2, or the half of it above y = 0.
TEST(BakeClosedForm, SphericalHarmonicsOfAUniformSky) {
  Builder b;
  b.environment(Rgb(2));
  const ScenePointer scene = b.build();
  const std::vector<OutputDesc> outputs = {OutputDesc{OutputKind::RadianceSh2}, OutputDesc{OutputKind::IrradianceSh2},
                                           OutputDesc{OutputKind::Fluence}};
  const SensorPointer free = points({{Vec3(0)}}, outputs), held = points({{Vec3(0), Vec3(0, 1, 0)}}, outputs);
  double half[9] = {};  // INT Y_lm over the hemisphere, by its midpoints
  constexpr int n = 1000;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double y = (i + 0.5) / n, r = std::sqrt(1 - y * y), phi = 2 * M_PI * (j + 0.5) / n;
      float sh[9];
      real_sh(Vec3(float(r * std::cos(phi)), float(y), float(r * std::sin(phi))), 9, sh);
      for (int k = 0; k < 9; ++k) half[k] += double(sh[k]) * 2 * M_PI / (double(n) * n);
    }
  for (const Way& way : ways_of_direct()) {
    for (int k = 0; k < 9; ++k) {
      const double band = k == 0 ? M_PI : k < 4 ? 2 * M_PI / 3 : M_PI / 4;
      const double whole = k == 0 ? 2 * 4 * M_PI * 0.28209479 : 0;
      const std::string what = "plane " + std::to_string(k) + " by " + way.name;
      const auto expect = [&](const SensorPointer& sensor, int plane, double value) {
        const Estimate e = value_of(scene, sensor, way.options, plane, 32, 1024);
        expect_value(e, value, 128, what, 2e-5);
        EXPECT_LT(e.standard_error(), 0.02 * 2 * band) << what;
      };
      expect(free, k, whole);
      expect(free, 9 + k, whole * band);
      expect(held, k, 2 * half[k]);
      expect(held, 9 + k, 2 * half[k] * band);
    }
    expect_within(value_of(scene, free, way.options, 18, 32, 1024), 8 * M_PI, 2e-3, "fluence by " + way.name);
    expect_within(value_of(scene, held, way.options, 18, 32, 1024), 4 * M_PI, 2e-3, "half fluence by " + way.name);
  }
}

// A lamp over a floor: what falls on it by texels is what leaves the lamp toward it, and does not depend on how the
// floor is laid out in the atlas.
scenes::MeshData floor_quads() {
  scenes::MeshData m;
  for (int i = 0; i < 4; ++i) {
    const float x = i % 2 ? 0.0f : -1.0f, z = i / 2 ? 0.0f : -1.0f;
    m.add_quad(Vec3(x, 0, z + 1), Vec3(x + 1, 0, z + 1), Vec3(x + 1, 0, z), Vec3(x, 0, z));
  }
  return m;
}

// Four charts of unequal density, turned by unequal angles.
scenes::MeshData turned_floor() {
  scenes::MeshData m = floor_quads();
  const float sizes[] = {0.42f, 0.2f, 0.3f, 0.11f}, turns[] = {0.3f, 1.1f, 2.2f, 4};
  for (size_t i = 0; i < 4; ++i) {
    const Vec2 center(i % 2 ? 0.75f : 0.27f, i / 2 ? 0.75f : 0.27f);
    for (const Vec2& c : {Vec2(-0.5f, -0.5f), Vec2(0.5f, -0.5f), Vec2(0.5f, 0.5f), Vec2(-0.5f, 0.5f)}) {
      const float cs = std::cos(turns[i]), sn = std::sin(turns[i]);
      m.lightmap_uv.push_back(center + Vec2(cs * c.x - sn * c.y, sn * c.x + cs * c.y) * sizes[i]);
    }
  }
  return m;
}

constexpr float kLamp = 3;
scenes::MeshData lamp() {
  return scenes::quad(Vec3(-0.3f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, 0.4f),
                      Vec3(-0.3f, 0.6f, 0.4f));
}
// From the lamp to the floor: E integrated over it by the closed form.
double flux_on_floor() {
  double flux = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = -1 + 2 * (i + 0.5) / n, z = -1 + 2 * (j + 0.5) / n;
      double factor = 0;
      for (const double side : {-1.0, 1.0})
        for (const double end : {-1.0, 1.0}) {
          const double a = (side < 0 ? -0.3 : 0.5) - x, b = (end < 0 ? -0.2 : 0.4) - z;
          factor +=
              side * end * (a < 0 ? -1 : 1) * (b < 0 ? -1 : 1) * corner_form_factor(std::fabs(a), std::fabs(b), 0.6);
        }
      flux += kLamp * M_PI * factor * 4 / (double(n) * n);
    }
  return flux;
}

// Of direct light alone.
std::vector<Way> ways_of_flux() {
  return {Way{"t = 0", options_for(mask_of([](int, int t) { return t == 0; }), 1)},
          Way{"s = 1", options_for(mask_of([](int s, int) { return s == 1; }), 1)}, Way{"all", options_for({}, 1)}};
}
void expect_flux(const ScenePointer& scene, const std::shared_ptr<const Lightmap>& sensor, double flux) {
  for (const Way& way : ways_of_flux()) {
    Estimate e;
    for (int seed = 0; seed < 24; ++seed) {
      const std::vector<float> map = read(*render(scene, sensor, way.options, 160, uint64_t(seed)).film);
      double sum = 0;
      for (int y = 0; y < sensor->height(); ++y)
        for (int x = 0; x < sensor->width(); ++x)
          sum += double(sensor->texels().area(x, y)) * double(map[3 * size_t(y * sensor->width() + x)]);
      e.add(sum);
    }
    expect_value(e, flux, 6, way.name, 2e-5 * flux);
    EXPECT_LT(e.standard_error(), 2e-3 * flux) << way.name;
  }
}

TEST(BakeClosedForm, FluxOnAFloorHoweverItIsUnwrapped) {
  const double flux = flux_on_floor();
  for (const bool turned : {false, true}) {
    Builder b;
    b.add(turned ? turned_floor() : scenes::unwrapped(floor_quads(), 2, 0), scenes::diffuse(0.0f));
    b.add(lamp(), scenes::emitter(Rgb(kLamp)));
    const ScenePointer scene = b.build();
    const auto sensor = lightmap(scene, 24);
    EXPECT_NEAR(sensor->texels().report().area, 4, 1e-5);
    expect_flux(scene, sensor, flux);
  }
}

// The floor's quarters as instances of one sheet, of which each is stretched otherwise and two are mirrored; by charts
// of unlike density, one of them turned. Texels have the area of what they cover in the world.
TEST(BakeClosedForm, FluxOnMirroredAndStretchedInstances) {
  Builder b;
  scenes::MeshData sheet =
      scenes::unwrapped(scenes::quad(Vec3(0, 0, 0.25f), Vec3(0.5f, 0, 0.25f), Vec3(0.5f, 0, 0), Vec3(0, 0, 0)), 1, 0);
  const int shape = b.next_shape();
  const Material black = scenes::diffuse(0.0f);
  b.add(sheet, black, Transform{{2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0}});               // x > 0, z > 0
  b.add_instance(shape, shape, Transform{{-2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 4, 0}});     // x < 0, z > 0, mirrored
  b.add_instance(shape, shape, Transform{{2, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, -4, 0}});  // x > 0, z < 0, mirrored
  b.add_instance(shape, shape, Transform{{0, 0, -4, 0, 0, 1, 0, 0, -2, 0, 0, 0}});    // x < 0, z < 0, turned, mirrored
  b.add(lamp(), scenes::emitter(Rgb(kLamp)));
  const ScenePointer scene = b.build();
  std::vector<LightmapInstance> instances;
  for (uint32_t i = 0; i < 4; ++i) {
    instances.push_back(placed(i));
    instances[i].scale = {i == 1 ? 0.25f : 0.45f, i == 2 ? 0.3f : 0.45f};
    instances[i].offset = {i % 2 ? 0.53f : 0.02f, i / 2 ? 0.51f : 0.03f};
  }
  const auto sensor = lightmap(scene, 24, instances);
  EXPECT_NEAR(sensor->texels().report().area, 4, 1e-5);
  EXPECT_EQ(sensor->texels().report().shared, 0u);
  EXPECT_NEAR(sensor->texels().area(5, 19), 1 / (0.45 * 0.45 * 24 * 24), 1e-6);  // whole, of the first
  EXPECT_NEAR(sensor->texels().area(15, 19), 1 / (0.25 * 0.45 * 24 * 24), 1e-6);
  expect_flux(scene, sensor, flux_on_floor());
  // Their backs are dark.
  for (LightmapInstance& i : instances) i.flip = true;
  const SensorPointer backs = lightmap(scene, 24, instances);
  for (const Way& way : ways_of_flux())
    for (const float v : read(*render(scene, backs, way.options, 16, 1).film)) ASSERT_EQ(v, 0) << way.name;
}

// Triangles without area, in the atlas or in the world, measure nothing, and change nothing for those beside them.
TEST(BakeClosedForm, TrianglesWithoutAreaAreNotMeasured) {
  Builder b;
  scenes::MeshData m = scenes::unwrapped(floor_quads(), 2, 0);
  const auto add = [&](const std::array<Vec3, 3>& p, const std::array<Vec2, 3>& uv) {
    const auto first = uint32_t(m.positions.size());
    m.positions.insert(m.positions.end(), p.begin(), p.end());
    m.lightmap_uv.insert(m.lightmap_uv.end(), uv.begin(), uv.end());
    m.triangles.push_back({first, first + 1, first + 2});
  };
  // Far below, where no light comes; a line and a point in the atlas.
  const std::array<Vec3, 3> below = {Vec3(0, -1, 0), Vec3(0.1f, -1, 0), Vec3(0, -1, 0.1f)};
  add(below, {Vec2(0.1f, 0.1f), Vec2(0.5f, 0.5f), Vec2(0.9f, 0.9f)});
  add(below, {Vec2(0.3f, 0.3f), Vec2(0.3f, 0.3f), Vec2(0.3f, 0.3f)});
  // A line in the world, over a quarter of the atlas.
  add({Vec3(0, -1, 0), Vec3(0, -1, 0.5f), Vec3(0, -1, 1)}, {Vec2(0, 0), Vec2(0.5f, 0), Vec2(0, 0.5f)});
  b.add(m, scenes::diffuse(0.0f));
  b.add(lamp(), scenes::emitter(Rgb(kLamp)));
  const ScenePointer scene = b.build();
  const auto sensor = lightmap(scene, 24);
  EXPECT_EQ(sensor->texels().report().unmapped, 2u);
  EXPECT_NEAR(sensor->texels().report().area, 4, 1e-5);
  EXPECT_EQ(sensor->texels().report().texels, 576u);
  expect_flux(scene, sensor, flux_on_floor());
}

// A texel that covers nothing but a line of the world is not measured.
TEST(BakeClosedForm, ATexelOfALineIsNone) {
  Builder b;
  scenes::MeshData m = scenes::quad(Vec3(0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0));
  m.lightmap_uv = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  b.add(m, scenes::diffuse(0.0f));
  b.environment(Rgb(1));
  const auto sensor = lightmap(b.build(), 4);
  EXPECT_EQ(sensor->count(), 0u);
  EXPECT_EQ(sensor->number(1, 1), -1);
  EXPECT_EQ(sensor->texels().area(1, 1), 0);
}

// Charts that lie on one another: the mean by area, in every technique. One sheet sees the sky, the other, twice as
// large, is in a closed box.
TEST(BakeClosedForm, OverlappingChartsMeasureTheMeanByArea) {
  Builder b;
  const auto sheet = [](float y, float side) {
    return scenes::unwrapped(
        scenes::quad(Vec3(-side, y, side), Vec3(side, y, side), Vec3(side, y, -side), Vec3(-side, y, -side)), 1, 0);
  };
  b.add(sheet(0, 0.5f), scenes::diffuse(0.5f));
  b.add(sheet(-2, std::sqrt(0.5f)), scenes::diffuse(0.5f));
  b.add(scenes::box(Vec3(-1, -3, -1), Vec3(1, -1, 1), false), scenes::diffuse(0.5f));
  b.environment(Rgb(1));
  const ScenePointer scene = b.build();
  const auto sensor = lightmap(scene, 4, {placed(0), placed(1)});
  EXPECT_EQ(sensor->texels().report().shared, 16u);
  EXPECT_NEAR(sensor->texels().coverage(1, 2), 2, 1e-5);
  EXPECT_NEAR(sensor->texels().area(1, 2), 3.0 / 16, 1e-6);
  for (const Way& way : ways_of_flux()) {
    Estimate mean;
    for (int seed = 0; seed < 24; ++seed)
      mean.add(mean_of(*render(scene, sensor, way.options, 1024, uint64_t(seed)).film));
    expect_value(mean, M_PI / 3, 6, way.name, 1e-5);
    EXPECT_LT(mean.standard_error(), 0.02 * M_PI) << way.name;
  }
}

// What a point on a floor sees under a roof, 1 x 0.8 at height 0.6: without light, and whatever takes part of it.
TEST(BakeClosedForm, OpennessUnderARoof) {
  Builder b;
  Material roof = scenes::diffuse(0.5f);
  roof.one_sided = true;
  b.add(
      scenes::quad(Vec3(-0.5f, 0.6f, -0.4f), Vec3(-0.5f, 0.6f, 0.4f), Vec3(0.5f, 0.6f, 0.4f), Vec3(0.5f, 0.6f, -0.4f)),
      roof);  // its front looks up
  b.environment(Rgb(1));
  const ScenePointer scene = b.build();
  const double factor = 4 * corner_form_factor(0.5, 0.4, 0.6);
  OutputDesc near{OutputKind::Openness};
  near.reach = 0.59f;
  const std::vector<OutputDesc> outputs = {OutputDesc{OutputKind::Openness},   near,
                                           OutputDesc{OutputKind::BentNormal}, OutputDesc{OutputKind::OpennessSh1},
                                           OutputDesc{OutputKind::Irradiance}, OutputDesc{OutputKind::Fronts}};
  const SensorPointer point = points({{Vec3(0), Vec3(0, 1, 0)}}, outputs);
  // The solid angle of the roof, and the integrals of w cos and of Y_1 over it, by its midpoints.
  double angle = 0, up = 0;
  constexpr int n = 800;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = (i + 0.5) / n - 0.5, z = 0.8 * ((j + 0.5) / n - 0.5), d2 = x * x + z * z + 0.36;
      const double dw = 0.8 / (double(n) * n) * 0.6 / (d2 * std::sqrt(d2)), y = 0.6 / std::sqrt(d2);
      angle += dw, up += dw * y * y;
    }
  // Rays are cast for it where no technique needs them, and where there is no light.
  const TransportOptions light_alone = way_of_direct("", [](int, int t) { return t <= 1; }).options,
                         all = way_of_direct("", [](int, int) { return true; }).options;
  Builder dark;
  dark.add(
      scenes::quad(Vec3(-0.5f, 0.6f, -0.4f), Vec3(-0.5f, 0.6f, 0.4f), Vec3(0.5f, 0.6f, 0.4f), Vec3(0.5f, 0.6f, -0.4f)),
      roof);
  expect_within(value_of(scene, point, light_alone, 0, 32, 1024), 1 - factor, 3e-3, "by light subpaths");
  expect_within(value_of(dark.build(), point, all, 0, 32, 1024), 1 - factor, 3e-3, "in the dark");
  for (const char* plan : {"one-to-one", "two-way"}) {
    const TransportOptions options = with_plan(all, plan);
    const auto expect = [&](int plane, double value) {
      expect_within(value_of(scene, point, options, plane, 32, 2048), value, 3e-3,
                    std::string(plan) + ", plane " + std::to_string(plane));
    };
    expect(0, 1 - factor);
    expect(1, 1);
    expect(3, 0.28209479 * (2 * M_PI - angle));
    expect(4, 0.48860251 * (M_PI - M_PI * factor));  // y
    expect(7, M_PI * (1 - factor));                  // the sky's light
    Estimate bent[3], fronts;
    for (int seed = 0; seed < 16; ++seed) {
      const Picture p = render(scene, point, options, 2048, uint64_t(seed));
      const std::vector<float> w = read(*p.film, FilmLayer::Color, 0, 0, 2);
      for (size_t c = 0; c < 3; ++c) bent[c].add(double(w[c]));
      fronts.add(double(read(*p.film, FilmLayer::Color, 0, 0, 8)[0]));
    }
    expect_value(bent[0], 0, 8, "bent normal, x", 1e-5);
    expect_within(bent[1], 2 * M_PI / 3 - up, 3e-3, "bent normal, y");
    expect_value(bent[2], 0, 8, "bent normal, z", 1e-5);
    // Half of the rays by the cosine, half evenly.
    expect_within(fronts, 1 - 0.5 * factor - 0.5 * angle / (2 * M_PI), 3e-3, "fronts");
  }
}

// A lamp over a point, and a plane half way up that hides the half of it: E unshadowed is the whole lamp's, and the
// mask the part of its form factor that is seen. Another lamp, of another group, counts where it is asked for alone.
TEST(BakeClosedForm, UnshadowedLightAndTheMaskOfAHalfPlane) {
  Builder b;
  const auto lamp_at = [](float y, float z0, float z1) {
    return scenes::quad(Vec3(-0.4f, y, z0), Vec3(0.6f, y, z0), Vec3(0.6f, y, z1), Vec3(-0.4f, y, z1));
  };
  Material second = scenes::emitter(Rgb(5));
  second.emission_group = 1;
  b.add(lamp_at(1, -0.5f, 0.3f), scenes::emitter(Rgb(3)));
  b.add(lamp_at(2, -0.5f, 0.3f), second);  // all of it behind the first one's back
  // From the point, its edge hides x < 0.1 of the first lamp.
  b.add(scenes::quad(Vec3(-9, 0.5f, -9), Vec3(0.05f, 0.5f, -9), Vec3(0.05f, 0.5f, 9), Vec3(-9, 0.5f, 9)),
        scenes::diffuse(0.5f));
  const ScenePointer scene = b.build();
  const auto factor = [](double x0, double x1, double y) {
    const auto corner = [&](double x, double z) {
      return (x < 0 ? -1 : 1) * (z < 0 ? -1 : 1) * corner_form_factor(std::fabs(x), std::fabs(z), y);
    };
    return corner(x1, 0.3) - corner(x0, 0.3) - corner(x1, -0.5) + corner(x0, -0.5);
  };
  OutputDesc unshadowed{OutputKind::Unshadowed}, direct{OutputKind::Irradiance};
  unshadowed.groups = direct.groups = 1, direct.indirect = false;
  OutputDesc behind = unshadowed, all = unshadowed;
  behind.groups = 2, all.groups = ~0ull;
  const SensorPointer point = points({{Vec3(0), Vec3(0, 1, 0)}}, {unshadowed, direct, behind, all});
  std::vector<Way> ways = ways_of_direct();
  ways.push_back(way_of_direct("t = 0", [](int, int t) { return t == 0; }));  // finds nothing here
  for (const char* plan : {"two-way", "pooled", "matrix"}) ways.push_back({plan, with_plan(ways[2].options, plan)});
  for (const auto selection : {LightSelection::Tree, LightSelection::Each}) {
    ways.push_back(ways[2]);
    ways.back().name = "selection";
    TransportOptions& o = ways.back().options;
    o.light_selection = selection, o.direct_samples = 2, o.direct_candidates = 3;
  }
  for (const Way& way : ways) {
    expect_within(value_of(scene, point, way.options, 0, 32, 1024), 3 * M_PI * factor(-0.4, 0.6, 1), 2e-3, way.name);
    expect_within(value_of(scene, point, way.options, 2, 32, 1024), 5 * M_PI * factor(-0.4, 0.6, 2), 2e-3, way.name);
    expect_within(value_of(scene, point, way.options, 3, 32, 1024),
                  M_PI * (3 * factor(-0.4, 0.6, 1) + 5 * factor(-0.4, 0.6, 2)), 2e-3, way.name);
    if (way.name == "t = 0") continue;
    const uint64_t passes = way.name == "s = 0" ? 8192 : 1024;
    expect_within(value_of(scene, point, way.options, 1, 32, passes), 3 * M_PI * factor(0.1, 0.6, 1), 5e-3, way.name);
  }
}

// Where nothing is in the way, the two are the same; with a sky, too, and by texels whose normals are not flat.
TEST(BakeClosedForm, UnshadowedIsShadowedInTheOpen) {
  Builder b;
  scenes::MeshData floor =
      scenes::unwrapped(scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1)), 1, 0);
  for (const float x : {-0.3f, 0.3f, 0.3f, -0.3f}) floor.normals.push_back(unit(Vec3(x, 1, 0.1f)));
  b.add(floor, scenes::diffuse(0.5f));
  b.add(
      scenes::quad(Vec3(-0.3f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, 0.4f), Vec3(-0.3f, 0.6f, 0.4f)),
      scenes::emitter(Rgb(3)));
  b.point(Vec3(0.8f, 0.5f, 0.2f), Rgb(0.3f));
  const ScenePointer scene = b.build();
  OutputDesc unshadowed{OutputKind::Unshadowed}, direct{OutputKind::Irradiance};
  direct.indirect = false;
  const SensorPointer map = lightmap(scene, 4, {placed(0)}, {unshadowed, direct});
  const SensorPointer flat = points({{Vec3(0, 0.01f, 0), Vec3(0, 1, 0)}}, {unshadowed, direct});
  for (const SensorPointer& sensor : {map, flat})
    for (const char* plan : {"one-to-one", "two-way"}) {
      // By direct lighting alone the samples are the same: each texel's values are, but for rounding.
      const TransportOptions same = with_plan(options_for(only(1, 1), 1), plan);
      const Picture p = render(scene, sensor, same, 64, 1);
      const std::vector<float> a = read(*p.film), c = read(*p.film, FilmLayer::Color, 0, 0, 1);
      for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_NEAR(a[i], c[i], 2e-5 * double(a[i])) << plan << ", " << i;
        EXPECT_TRUE(a[i] == 0 || a[i] > 0.1f) << a[i];
      }
    }
  Builder sky;
  sky.environment(Rgb(2));
  const SensorPointer free = points({{Vec3(0), Vec3(0, 1, 0)}}, {unshadowed, direct});
  for (const Way& way : ways_of_direct())
    expect_within(value_of(sky.build(), free, way.options, 0, 32, 1024), 2 * M_PI, 2e-3, "sky by " + way.name);
}

// Two rooms, each 2 x 1 x 2 times a size, and a wall between them of twice `wall`. All walls of the left one emit
// radiance 1; those of the right one, black, are mapped. slit: its width, from floor to ceiling; 0 = none.
struct TwoRooms {
  ScenePointer scene;
  std::shared_ptr<const Lightmap> sensor;
};
TwoRooms two_rooms(float size, float wall, float slit) {
  Builder b;
  const Vec3 right(2 * size, size, size), left(-2 * size, 0, -size);
  b.add(scenes::unwrapped(scenes::box(Vec3(wall, 0, -size), right, true, 63 - 1), 3, 0), scenes::diffuse(0.0f));
  b.add(scenes::box(left, Vec3(-wall, size, size), true, 63 - 2), scenes::emitter(Rgb(1)));
  b.add(scenes::box(Vec3(-wall, 0, -size), Vec3(wall, size, -slit / 2), false), scenes::diffuse(0.0f));
  b.add(scenes::box(Vec3(-wall, 0, slit / 2), Vec3(wall, size, size), false), scenes::diffuse(0.0f));
  const ScenePointer scene = b.build();
  return {scene, lightmap(scene, 60)};
}

TEST(BakeClosedForm, NothingLeaksThroughAWall) {
  const TwoRooms rooms = two_rooms(1, 0.05f, 0);
  for (const Way& way : ways(4)) {
    const Picture p = render(rooms.scene, rooms.sensor, way.options, 8, 1);
    for (const float v : read(*p.film)) ASSERT_EQ(v, 0) << way.name;
  }
}

TEST(BakeClosedForm, ASlitOfAMillimetreLetsThroughWhatItShould) {
  const TwoRooms rooms = two_rooms(0.05f, 0.001f, 0.001f);
  // The form factor of the slit's two ends, and the flux from one to the other; its sides are black.
  const double x = 0.001 / 0.002, y = 0.05 / 0.002, u = std::sqrt(1 + x * x), v = std::sqrt(1 + y * y);
  const double factor = 2 / (M_PI * x * y) *
                        (0.5 * std::log(u * u * v * v / (1 + x * x + y * y)) + x * v * std::atan(x / v) +
                         y * u * std::atan(y / u) - x * std::atan(x) - y * std::atan(y));
  const double flux = M_PI * 0.001 * 0.05 * factor;
  for (const char* plan : {"one-to-one", "matrix"}) {
    Estimate e;
    std::vector<double> sums(16);
    in_parallel(sums.size(), [&](size_t seed) {
      const std::vector<float> map =
          read(*render(rooms.scene, rooms.sensor, with_plan(options_for({}, 1), plan), 128, uint64_t(seed)).film);
      for (int j = 0; j < 60; ++j)
        for (int i = 0; i < 60; ++i)
          sums[seed] += double(rooms.sensor->texels().area(i, j)) * double(map[3 * size_t(j * 60 + i)]);
    });
    for (double sum : sums) e.add(sum);
    expect_value(e, flux, 2, plan);
    EXPECT_LT(e.standard_error(), 0.03 * flux) << plan;
  }
}

}  // namespace bdpt::bake_closed_form_test
