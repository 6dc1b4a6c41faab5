// Outputs of cameras: what eye subpaths meet first in closed form, parts of the picture that add up, and films that
// hold them.
#include "base/error.h"
#include "rendering.h"
#include "temp_folder.h"
#include "transport/plan.h"

#include <algorithm>
#include <random>

namespace bdpt::camera_outputs_test {

using namespace rendering;
using scenes::Builder;

// --- Cameras ---

OutputPlanes seen(Seen what, bool unfiltered = false) {
  OutputPlanes o;
  o.kind = 0;
  o.seen = what;
  o.unfiltered = unfiltered;
  return o;
}
OutputPlanes light(bool direct, bool indirect, uint64_t groups = ~0ull, bool unfiltered = false) {
  OutputPlanes o = seen(Seen::Light, unfiltered);
  o.direct = direct, o.indirect = indirect, o.groups = groups;
  o.direct_edges = 2;
  return o;
}

SensorPointer camera(CameraDesc desc, const std::vector<OutputPlanes>& outputs) {
  int planes = 1, coverages = 0;
  for (OutputPlanes o : outputs) {
    if (is_coverage(o.seen))
      o.first = coverages++, o.count = 0;
    else
      o.first = planes++;
    desc.outputs.push_back(o);
  }
  return make_camera(desc);
}
SensorPointer camera(const scenes::Viewpoint& view, int width, int height, const std::vector<OutputPlanes>& outputs) {
  return camera(scenes::camera_desc(view, width, height), outputs);
}

std::vector<float> plane(const Picture& picture, int number) {
  return read(*picture.film, FilmLayer::Color, 0, 0, number);
}

Picture render_outputs(const Builder& builder, const SensorPointer& sensor, uint64_t passes = 16,
                       const TechniqueMask& mask = {}) {
  TransportOptions options = options_for(mask, 3);
  options.sampler = SamplerType::Sobol;
  return render(builder.build(), sensor, options, passes, 1);
}

const scenes::Viewpoint kSlanting{Vec3(0.4f, 1.3f, 2.1f), Vec3(0.1f, 0, 0.2f), 40};

Builder floor_of(const MaterialDesc& material) {
  Builder b;
  b.add(scenes::quad(Vec3(-50, 0, 50), Vec3(50, 0, 50), Vec3(50, 0, -50), Vec3(-50, 0, -50)), material);
  b.point(Vec3(0, 3, 0), Rgb(1));
  return b;
}

// --- What is met first ---

TEST(CameraOutputs, AFloorIsWhereEachPixelSeesIt) {
  constexpr int kWidth = 24, kHeight = 16;
  const auto all = {seen(Seen::Position), seen(Seen::Depth), seen(Seen::Normal)};
  const SensorPointer sensor = camera(kSlanting, kWidth, kHeight, all);
  const CameraDesc desc = scenes::camera_desc(kSlanting, kWidth, kHeight);
  const Picture picture = render_outputs(floor_of(scenes::diffuse(0.5f)), sensor);
  const std::vector<float> position = plane(picture, 1), depth = plane(picture, 2), normal = plane(picture, 3);
  const Vec3 ahead = unit(kSlanting.to - kSlanting.from);
  const PixelRect bounds{0, 0, kWidth, kHeight};
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float* p = &position[3 * size_t(y * kWidth + x)];
      const float* d = &depth[3 * size_t(y * kWidth + x)];
      const float* n = &normal[3 * size_t(y * kWidth + x)];
      const Vec3 mean(p[0], p[1], p[2]);
      EXPECT_NEAR(p[1], 0, 1e-5);
      EXPECT_NEAR(d[0], dot(mean - kSlanting.from, ahead), 1e-4 * d[0]);  // linear: the depth of the mean
      EXPECT_GE(d[1], d[0] * d[0] * 0.99999f);
      EXPECT_LE(d[1], d[0] * d[0] * 1.05f);
      EXPECT_EQ(d[2], 1);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(n[c], c == 1, 1e-6);
      // The mean of points seen through a pixel is seen through it.
      SensorPoint z0;
      const float lens[2] = {0.5f, 0.5f};
      ASSERT_TRUE(sensor->sample_toward(mean, lens, bounds, z0));
      EXPECT_NEAR(z0.film.x, float(x) + 0.5f, 0.5f);
      EXPECT_NEAR(z0.film.y, float(y) + 0.5f, 0.5f);
    }
}

TEST(CameraOutputs, NormalsLookAtTheCameraFromBothSides) {
  scenes::Viewpoint below = kSlanting;
  below.from.y = -below.from.y;
  const Picture picture = render_outputs(floor_of(scenes::diffuse(0.5f)), camera(below, 8, 8, {seen(Seen::Normal)}), 4);
  const std::vector<float> normal = plane(picture, 1);
  for (size_t i = 0; i < 64; ++i) EXPECT_NEAR(normal[3 * i + 1], -1, 1e-6);
}

TEST(CameraOutputs, DepthIsAlongTheAxisAndNoneWhereNothingIs) {
  Builder b;
  b.add(scenes::quad(Vec3(-9, -9, -2), Vec3(0, -9, -2), Vec3(0, 9, -2), Vec3(-9, 9, -2)), scenes::diffuse(0.5f));
  b.environment(Rgb(1));
  scenes::Viewpoint view{Vec3(0), Vec3(0, 0, -1), 90};
  for (float radius : {0.0f, 0.1f}) {
    view.lens_radius = radius, view.focus = 2;
    const Picture picture = render_outputs(b, camera(view, 8, 8, {seen(Seen::Depth), seen(Seen::Albedo)}));
    const std::vector<float> depth = plane(picture, 1), albedo = plane(picture, 2);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const float* d = &depth[3 * size_t(8 * y + x)];
        const bool there = x < 4;
        EXPECT_NEAR(d[0], there ? 2 : 0, 1e-5) << radius << ' ' << x << ' ' << y;
        EXPECT_NEAR(d[1], there ? 4 : 0, 2e-5);
        EXPECT_EQ(d[2], there ? 1 : 0);
        EXPECT_NEAR(albedo[3 * size_t(8 * y + x)], there ? 0.5f : 0, 1e-6);
      }
  }
}

TEST(CameraOutputs, DepthIsFromWhereTheCameraIsThen) {
  Builder b;
  b.add(scenes::quad(Vec3(-9, -9, -2), Vec3(9, -9, -2), Vec3(9, 9, -2), Vec3(-9, 9, -2)), scenes::diffuse(0.5f));
  b.point(Vec3(0), Rgb(1));
  CameraDesc desc = scenes::camera_desc({Vec3(0), Vec3(0, 0, -1), 60}, 8, 8);
  desc.end = desc.transform;
  desc.end.m[11] = 1;  // a unit back
  desc.moves = true;
  const std::vector<float> depth = plane(render_outputs(b, camera(desc, {seen(Seen::Depth)}), 64), 1);
  double mean = 0, square = 0;
  for (size_t i = 0; i < 64; ++i) mean += double(depth[3 * i]) / 64, square += double(depth[3 * i + 1]) / 64;
  const double samples = 64 * 64;
  EXPECT_NEAR(mean, 2.5, 5 / std::sqrt(12 * samples));
  EXPECT_NEAR(square, 6.25 + 1.0 / 12, 5 * std::sqrt(2.09 / samples));  // variance of d²: 6.25 / 3 + 1 / 180
}

TEST(CameraOutputs, AlbedoIsThePartOfLightThatIsSentOn) {
  struct Case {
    const char* name;
    MaterialDesc material;
    Rgb albedo;
    float tolerance;
  };
  const Case cases[] = {
      {"diffuse", scenes::diffuse(Rgb(0.7f, 0.2f, 0.1f)), Rgb(0.7f, 0.2f, 0.1f), 1e-6f},
      {"black lamp", scenes::emitter(Rgb(3)), Rgb(0), 0},
      {"mirror", scenes::mirror(0.9f), Rgb(0.9f), 1e-6f},
      {"glass", scenes::dielectric(1.5f), Rgb(1), 1e-6f},
      {"rough glass", scenes::dielectric(1.5f, 0.3f), Rgb(1), 0.1f},  // 64 samples of what is not constant
  };
  for (const Case& c : cases) {
    const Picture picture = render_outputs(floor_of(c.material), camera(kSlanting, 4, 4, {seen(Seen::Albedo)}), 64);
    const std::vector<float> albedo = plane(picture, 1);
    for (size_t i = 0; i < 16; ++i)
      for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(albedo[3 * i + k], (&c.albedo.r)[k], c.tolerance) << c.name;
  }
}

TEST(CameraOutputs, SurfacesAreMetThroughWhatIsNotThere) {
  const auto depth_through = [](Opacity::Mode mode, float opacity) {
    MaterialDesc screen = scenes::diffuse(0.5f);
    screen.opacity.mode = mode;
    screen.opacity.value = opacity;
    Builder b;
    b.add(scenes::quad(Vec3(-9, -9, -1), Vec3(9, -9, -1), Vec3(9, 9, -1), Vec3(-9, 9, -1)), screen);
    b.add(scenes::quad(Vec3(-9, -9, -2), Vec3(9, -9, -2), Vec3(9, 9, -2), Vec3(-9, 9, -2)), scenes::diffuse(0.5f));
    b.point(Vec3(0), Rgb(1));
    const Picture p = render_outputs(b, camera({Vec3(0), Vec3(0, 0, -1), 40}, 16, 16, {seen(Seen::Depth)}), 16);
    double sum = 0;
    const std::vector<float> depth = plane(p, 1);
    for (size_t i = 0; i < 256; ++i) sum += double(depth[3 * i]) / 256;
    return sum;
  };
  EXPECT_NEAR(depth_through(Opacity::Mode::Opaque, 0.3f), 1, 1e-5);
  EXPECT_NEAR(depth_through(Opacity::Mode::Mask, 0.3f), 2, 1e-5);
  // 4096 samples: five standard errors.
  EXPECT_NEAR(depth_through(Opacity::Mode::Blend, 0.3f), 1.7, 5 * std::sqrt(0.21 / 4096));
}

TEST(CameraOutputs, WhatIsMetDependsOnNoTechnique) {
  const Builder room = scenes::room({});
  const SensorPointer sensor = camera(scenes::room_view(), 16, 12, {seen(Seen::Normal), seen(Seen::Albedo)});
  const Picture all = render_outputs(room, sensor, 4);
  const Picture from_lights = render_outputs(room, sensor, 4, mask_of([](int, int t) { return t <= 1; }));
  for (int number : {1, 2}) EXPECT_EQ(plane(all, number), plane(from_lights, number));
  EXPECT_NE(plane(all, 0), plane(from_lights, 0));
}

// --- Parts of the picture ---

// Lamps of the groups 0 and 5, and a sky of 63.
Builder grouped_room() {
  Builder b;
  b.add(scenes::box(Vec3(-1), Vec3(1), true, 31), scenes::diffuse(Rgb(0.7f, 0.5f, 0.3f)));
  MaterialDesc lamp = scenes::emitter(Rgb(4, 3, 2), true, 0.3f);
  b.add(scenes::quad(Vec3(-0.4f, 0.9f, -0.4f), Vec3(0.4f, 0.9f, -0.4f), Vec3(0.4f, 0.9f, 0), Vec3(-0.4f, 0.9f, 0)),
        lamp);
  lamp.emission_group = 5;
  b.add_sphere(Vec3(0.5f, -0.4f, -0.4f), 0.2f, lamp);
  b.add_sphere(Vec3(-0.4f, -0.5f, 0), 0.35f, scenes::dielectric(1.5f));
  b.environment(Rgb(0.5f, 0.7f, 0.9f), 63);
  return b;
}

void expect_sum(const Picture& picture, const std::vector<int>& parts, const std::string& what) {
  const std::vector<float> all = plane(picture, 0);
  std::vector<double> sum(all.size());
  for (int part : parts) {
    const std::vector<float> values = plane(picture, part);
    EXPECT_GT(*std::max_element(values.begin(), values.end()), 0) << what << ", plane " << part;
    for (size_t i = 0; i < sum.size(); ++i) sum[i] += double(values[i]);
  }
  for (size_t i = 0; i < sum.size(); ++i)
    ASSERT_NEAR(sum[i], double(all[i]), 2e-6 + 4e-6 * double(all[i])) << what << i;
}

TEST(CameraOutputs, PathsAndGroupsAddUpToThePictureInAllPlans) {
  const std::vector<OutputPlanes> parts{light(true, false),
                                        light(false, true),
                                        light(true, true, 1),
                                        light(true, true, 1ull << 5),
                                        light(true, true, 1ull << 63),
                                        light(true, false, ~0ull, true),
                                        light(false, true, ~0ull, true)};
  const SensorPointer sensor = camera(scenes::room_view_through_lens(), 16, 12, parts);
  const ScenePointer scene = grouped_room().build();
  for (size_t i = 0; plan_at(i); ++i) {
    if (plan_at(i)->chains) continue;
    TransportOptions options = options_for({}, 5);
    options.plan = plan_at(i);
    const Picture picture = render(scene, sensor, options, 16, 7);
    const std::string what = plan_at(i)->name;
    expect_sum(picture, {1, 2}, what + ": direct and indirect, ");
    expect_sum(picture, {3, 4, 5}, what + ": groups, ");
    expect_sum(picture, {6, 7}, what + ": direct and indirect, unfiltered, ");
  }
}

TEST(CameraOutputs, DirectIsLightOfTwoEdgesAtMost) {
  const SensorPointer sensor = camera(scenes::room_view_through_lens(), 16, 12, {light(true, false)});
  const ScenePointer scene = grouped_room().build();
  const auto picture = [&](int max_edges, const SensorPointer& s) {
    return render(scene, s, options_for({}, max_edges), 8, 3);
  };
  const std::vector<float> direct = plane(picture(2, sensor), 1);
  EXPECT_EQ(direct, plane(picture(2, sensor), 0));
  EXPECT_NE(direct, plane(picture(1, sensor), 0));
}

TEST(CameraOutputs, ThePictureIsTheSameToTheBitWithThem) {
  const auto outputs = {seen(Seen::Albedo), light(true, false), seen(Seen::Instance)};
  const CameraDesc desc = scenes::camera_desc(scenes::room_view_through_lens(), 16, 12);
  const ScenePointer scene = scenes::room({.points = true, .environment = true}).build();
  for (FilterType filter : {FilterType::Box, FilterType::Gaussian})
    for (bool by_weights : {false, true}) {
      const auto picture = [&](const SensorPointer& sensor) {
        FilmDesc film = film_for(*sensor);
        film.filter.type = filter;
        film.normalize_by_weights = by_weights;
        film.pyramid_edges = 2;
        RenderDesc render_desc;
        render_desc.transport = options_for({}, 4);
        return render(scene, sensor, film, render_desc, 4);
      };
      const Picture with = picture(camera(desc, outputs)), without = picture(camera(desc, {}));
      EXPECT_EQ(plane(with, 0), plane(without, 0));
      for (FilmLayer layer : {FilmLayer::Eye, FilmLayer::Light, FilmLayer::Variance})
        EXPECT_EQ(read(*with.film, layer), read(*without.film, layer));
      EXPECT_EQ(read(*with.film, FilmLayer::Technique, 1, 2), read(*without.film, FilmLayer::Technique, 1, 2));
    }
}

// --- Filters ---

TEST(CameraOutputs, UnfilteredPlanesMixNoPixels) {
  // Two walls that meet where two pixels do.
  Builder b;
  b.add(scenes::quad(Vec3(-9, -9, -1), Vec3(0, -9, -1), Vec3(0, 9, -1), Vec3(-9, 9, -1)), scenes::diffuse(0.8f));
  b.add(scenes::quad(Vec3(0, -9, -1), Vec3(9, -9, -1), Vec3(9, 9, -1), Vec3(0, 9, -1)), scenes::diffuse(0.2f));
  b.point(Vec3(0), Rgb(1));
  const SensorPointer sensor =
      camera({Vec3(0), Vec3(0, 0, -1), 60}, 8, 8, {seen(Seen::Albedo), seen(Seen::Albedo, true)});
  FilmDesc film = film_for(*sensor);
  film.filter.type = FilterType::Gaussian;
  film.filter.radius = 2;
  for (bool by_weights : {false, true}) {
    film.normalize_by_weights = by_weights;
    RenderDesc desc;
    desc.transport = options_for({}, 3);
    const Picture picture = render(b.build(), sensor, film, desc, 8);
    const std::vector<float> filtered = plane(picture, 1), unfiltered = plane(picture, 2);
    for (size_t x = 0; x < 8; ++x) {
      const float* u = &unfiltered[3 * (8 * 4 + x)];
      EXPECT_NEAR(u[0], x < 4 ? 0.8f : 0.2f, 1e-6) << x;
    }
    EXPECT_LT(filtered[3 * (8 * 4 + 3)], 0.75f);
    EXPECT_GT(filtered[3 * (8 * 4 + 4)], 0.25f);
  }
}

// What falls into a pixel's neighbours is not in it, whether eye or light subpaths bring it there.
TEST(CameraOutputs, UnfilteredLightStaysInItsPixel) {
  Builder b;
  b.add(scenes::quad(Vec3(-9, -9, -1), Vec3(0, -9, -1), Vec3(0, 9, -1), Vec3(-9, 9, -1)), scenes::diffuse(0));
  b.add(scenes::quad(Vec3(0, -9, -1), Vec3(9, -9, -1), Vec3(9, 9, -1), Vec3(0, 9, -1)), scenes::diffuse(0.8f));
  b.point(Vec3(0), Rgb(1));
  const SensorPointer sensor =
      camera({Vec3(0), Vec3(0, 0, -1), 60}, 8, 8, {light(true, true, ~0ull, true), light(true, true)});
  FilmDesc film = film_for(*sensor);
  film.filter.type = FilterType::Gaussian;
  film.filter.radius = 2;
  for (bool from_lights : {false, true}) {
    RenderDesc desc;
    desc.transport = options_for(mask_of([&](int, int t) { return (t <= 1) == from_lights; }), 3);
    const Picture picture = render(b.build(), sensor, film, desc, 64);
    const std::vector<float> unfiltered = plane(picture, 1), filtered = plane(picture, 2);
    EXPECT_EQ(filtered, plane(picture, 0));
    for (size_t i = 0; i < 64; ++i) {
      const bool is_black = i % 8 < 4;
      EXPECT_EQ(unfiltered[3 * i] == 0, is_black) << from_lights << ' ' << i;
      if (i % 8 == 3) {
        EXPECT_GT(filtered[3 * i], 0) << from_lights << ' ' << i;
      }
    }
  }
}

TEST(CameraOutputs, InABoxOfOnePixelNothingIsFilteredAnyway) {
  const SensorPointer sensor = camera(scenes::room_view_through_lens(), 16, 12, {light(true, true, ~0ull, true)});
  for (Adaptive adaptive : {Adaptive::None, Adaptive::TwoStages}) {
    TransportOptions options = options_for({}, 4);
    options.adaptive = adaptive;
    const Picture picture = render(scenes::room({}).build(), sensor, options, 8, 5);
    EXPECT_EQ(plane(picture, 0), plane(picture, 1));
  }
}

TEST(CameraOutputs, SamplesAreCounted) {
  const SensorPointer sensor = camera(scenes::room_view(), 32, 32, {seen(Seen::Depth)});
  TransportOptions options = options_for({}, 3);
  const ScenePointer scene = scenes::room({}).build();
  for (float v : read(*render(scene, sensor, options, 8, 5).film, FilmLayer::Samples)) EXPECT_EQ(v, 8);
  options.adaptive = Adaptive::TwoStages;
  const Picture adaptive = render(scene, sensor, options, 8, 5);
  const std::vector<float> samples = read(*adaptive.film, FilmLayer::Samples);
  double sum = 0;
  for (float v : samples) sum += double(v);
  EXPECT_EQ(sum, 3 * double(adaptive.stats.samples));
  EXPECT_NE(*std::min_element(samples.begin(), samples.end()), *std::max_element(samples.begin(), samples.end()));
}

// --- Coverage ---

TEST(CameraOutputs, PixelsKeepTheSameIdsInAnyOrder) {
  std::vector<uint64_t> samples;
  for (uint64_t id = 1; id <= 20; ++id) samples.insert(samples.end(), size_t(id), id);
  std::mt19937 random(5);
  PixelCoverage first;
  for (int round = 0; round < 20; ++round) {
    std::shuffle(samples.begin(), samples.end(), random);
    PixelCoverage parts[3], whole;
    for (size_t i = 0; i < samples.size(); ++i) parts[i % 3].add(samples[i], 1);
    for (int part : {2, 0, 1}) whole.add(parts[part]);
    uint64_t kept = 0;
    for (const CoverageSlot& slot : whole.slots) {
      EXPECT_EQ(slot.samples, slot.id);  // all of them
      kept += slot.samples;
    }
    EXPECT_EQ(kept + whole.lost, samples.size());
    if (round == 0) first = whole;
    EXPECT_EQ(0, std::memcmp(&first, &whole, sizeof(whole)));
  }
}

// --- Films ---

TEST(CameraOutputs, FilmsAreSavedAndMerged) {
  const SensorPointer sensor =
      camera(scenes::room_view_through_lens(), 16, 12,
             {seen(Seen::Normal, true), light(false, true), seen(Seen::Instance), seen(Seen::Material)});
  const ScenePointer scene = scenes::room({}).build();
  const auto part = [&](uint64_t first, uint64_t passes, uint32_t workers) {
    RenderDesc desc;
    desc.transport = options_for({}, 4);
    desc.first_pass = first;
    const auto film = std::make_shared<Film>(film_for(*sensor), nullptr);
    Render render(scene, sensor, film, threads(workers), nullptr, desc);
    AdvanceDesc advance;
    advance.passes = passes;
    render.advance(advance);
    return film;
  };
  const TempFolder folder;
  const auto whole = part(0, 6, 2);
  part(0, 4, 1)->save(folder.file("a.film"));
  const auto merged = Film::load(folder.file("a.film"), nullptr);
  merged->merge(*part(4, 2, 2));
  merged->save(folder.file("b.film"));
  whole->save(folder.file("c.film"));
  for (int number = 0; number < 3; ++number)
    EXPECT_EQ(read(*merged, FilmLayer::Color, 0, 0, number), read(*whole, FilmLayer::Color, 0, 0, number));
  EXPECT_EQ(read(*merged, FilmLayer::Samples), read(*whole, FilmLayer::Samples));
  for (size_t coverage : {0, 1}) {
    double lost_a = 1, lost_b = 1;
    const PixelRect all{0, 0, 16, 12};
    const auto a = merged->read_coverage(coverage, all, 3, false, lost_a);
    const auto b = whole->read_coverage(coverage, all, 3, false, lost_b);
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i].id == b[i].id && a[i].part == b[i].part);
    EXPECT_EQ(lost_a, lost_b);
  }
  FilmDesc other = film_for(*sensor);
  other.unfiltered = 0;
  EXPECT_THROW(merged->merge(Film(other, nullptr)), Error);
}

}  // namespace bdpt::camera_outputs_test
