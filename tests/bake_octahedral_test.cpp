// Directions on a square: the map, its solid angles, and outputs whose values are known.
#include "bake/octahedral.h"
#include "baking.h"
#include "sampling/warp.h"

namespace bdpt::bake_octahedral_test {

using namespace baking;
using scenes::Builder;

OutputDesc octahedral(OutputKind kind, int size, float reach = 0) {
  OutputDesc o{kind};
  o.size = size, o.reach = reach;
  return o;
}

TEST(BakeOctahedral, DirectionsThereAndBack) {
  statistics::Uniform u(1);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 w = sample_sphere(u(), u());
    const Vec2 p = to_octahedron(w);
    EXPECT_LE(std::max(std::fabs(p.x), std::fabs(p.y)), 1 + 1e-6f);
    EXPECT_LT(length(from_octahedron(p) - w), 1e-6f);
  }
  EXPECT_EQ(from_octahedron({0, 0}), Vec3(0, 0, 1));
  EXPECT_EQ(from_octahedron({1, 0}), Vec3(1, 0, 0));
  EXPECT_EQ(from_octahedron({0, -1}), Vec3(0, -1, 0));
  for (const Vec2& corner : {Vec2(1, 1), Vec2(-1, 1), Vec2(1, -1), Vec2(-1, -1)})
    EXPECT_EQ(from_octahedron(corner).z, -1);
}

TEST(BakeOctahedral, SolidAnglesOfTexels) {
  for (const int n : {1, 2, 3, 4, 5, 8, 32}) {
    const Octahedron o(n);
    double sum = 0;
    for (float a : o.angles) sum += double(a);
    EXPECT_NEAR(sum, 4 * M_PI, 1e-5) << n;
    // By how many of evenly spread directions fall into each.
    std::vector<double> counted(o.angles.size()), expected;
    statistics::Uniform u{uint32_t(n)};
    constexpr int samples = 400000;
    for (int i = 0; i < samples; ++i) counted[size_t(o.texel(sample_sphere(u(), u())))] += 1;
    for (float a : o.angles) expected.push_back(samples * double(a) / sum);
    EXPECT_TRUE(n == 1 || statistics::chi_square_test(counted, expected) > statistics::kSignificance) << n;
    for (size_t i = 0; n % 2 == 0 && i < o.directions.size(); ++i) EXPECT_EQ(o.texel(o.directions[i]), int(i));
  }
  for (float a : Octahedron(2).angles) EXPECT_NEAR(a, M_PI, 1e-6);
}

std::vector<Estimate> planes_of(const ScenePointer& scene, const SensorPointer& sensor, const TransportOptions& options,
                                uint64_t passes, int channel) {
  constexpr size_t seeds = 16;
  std::vector<Picture> pictures(seeds);
  in_parallel(seeds, [&](size_t i) { pictures[i] = render(scene, sensor, options, passes, i); });
  std::vector<Estimate> values(size_t(sensor->planes()));
  for (const Picture& p : pictures)
    for (int plane = 0; plane < sensor->planes(); ++plane)
      values[size_t(plane)].add(double(read(*p.film, FilmLayer::Color, 0, 0, plane)[size_t(channel)]));
  return values;
}

// A sky of radiance 2: a constant, by every technique, of points and balls; and half of it over a normal.
TEST(BakeOctahedral, AUniformSky) {
  Builder b;
  b.add(scenes::ball(Vec3(3, 3, 3), 0.001f, 3, false), scenes::diffuse(0.0f));
  b.environment(Rgb(2));
  const ScenePointer scene = b.build();
  const std::vector<OutputDesc> outputs = {octahedral(OutputKind::RadianceOctahedral, 3),
                                           octahedral(OutputKind::IrradianceOctahedral, 4)};
  for (const float radius : {0.0f, 0.5f}) {
    const SensorPointer sensor = points({{Vec3(3, 3, 3.2f), Vec3(0), radius}}, outputs);
    for (const auto& [name, mask] :
         {std::pair("s = 0", only(0, 2)), std::pair("s = 1", only(1, 1)), std::pair("all", TechniqueMask{})}) {
      const std::vector<Estimate> values = planes_of(scene, sensor, options_for(mask, 1), 8192, 0);
      for (size_t i = 0; i < values.size(); ++i) {
        const double value = i < 9 ? 2 : 2 * M_PI;
        expect_value(values[i], value, 200, std::string(name) + ", plane " + std::to_string(i), 1e-4 * value);
        EXPECT_LT(values[i].standard_error(), 0.02 * value);
      }
    }
  }
  const SensorPointer held = points({{Vec3(0), Vec3(0, 0, 1)}}, {octahedral(OutputKind::RadianceOctahedral, 4)});
  const std::vector<Estimate> values = planes_of(scene, held, options_for({}, 1), 4096, 0);
  for (size_t i = 0; i < values.size(); ++i) {
    const int x = int(i) % 4, y = int(i) / 4, folds = int(x == 0 || x == 3) + int(y == 0 || y == 3);
    expect_value(values[i], folds == 0 ? 2 : folds == 1 ? 1 : 0, 16, "plane " + std::to_string(i), 1e-4);
  }
}

// Means over a texel's directions by its points: squares of a fine grid, each by its solid angle.
std::vector<double> texel_means(int size, const std::function<double(const Vec3&)>& value) {
  constexpr int fine = 48;
  const Octahedron o(size * fine);
  std::vector<double> sums(size_t(size * size)), angles(sums.size());
  for (size_t i = 0; i < o.directions.size(); ++i) {
    const int x = int(i) % o.size / fine, y = int(i) / o.size / fine;
    sums[size_t(y * size + x)] += value(o.directions[i]) * double(o.angles[i]);
    angles[size_t(y * size + x)] += double(o.angles[i]);
  }
  for (size_t i = 0; i < sums.size(); ++i) sums[i] /= angles[i];
  return sums;
}

TEST(BakeOctahedral, MomentsOfTheDistance) {
  Builder sphere, box;
  sphere.add_sphere(Vec3(1, 2, 3), 1.5f, scenes::diffuse(0.5f));
  const ScenePointer ball = sphere.build();
  const SensorPointer center = points({{Vec3(1, 2, 3)}}, {octahedral(OutputKind::DistanceOctahedral, 4, 10)});
  const double exact[] = {1.5, 2.25, 1};
  for (int c = 0; c < 3; ++c)
    for (const Estimate& e : planes_of(ball, center, options_for({}, 1), 2048, c))
      expect_value(e, exact[c], 16 * 3, "sphere", 1e-4);

  // A box without a lid, from a place that is not its middle, up to 1.1.
  box.add(scenes::box(Vec3(-1), Vec3(1), true, 63 - 32), scenes::diffuse(0.5f));
  const ScenePointer walls = box.build();
  const Vec3 place(0.2f, -0.1f, 0.3f);
  const SensorPointer sensor = points({{place}}, {octahedral(OutputKind::DistanceOctahedral, 4, 1.1f)});
  const auto distance = [&](const Vec3& w) {
    double nearest = 1e30;
    for (int axis = 0; axis < 3; ++axis) {
      if (w[axis] == 0 || (axis == 2 && w.z > 0)) continue;
      nearest = std::min(nearest, double(((w[axis] > 0 ? 1 : -1) - place[axis]) / w[axis]));
    }
    const Vec3 at = place + w * float(nearest);
    return at.z > 1 ? 1e30 : nearest;
  };
  const std::function<double(double)> moments[] = {[](double d) { return std::min(d, 1.1); },
                                                   [](double d) { return std::min(d, 1.1) * std::min(d, 1.1); },
                                                   [](double d) { return double(d < 1.1); }};
  for (int c = 0; c < 3; ++c) {
    const std::vector<double> means = texel_means(4, [&](const Vec3& w) { return moments[c](distance(w)); });
    const std::vector<Estimate> values = planes_of(walls, sensor, options_for({}, 1), 40000, c);
    for (size_t i = 0; i < means.size(); ++i) {
      expect_value(values[i], means[i], 16 * 3, "box, plane " + std::to_string(i), 2e-3);
      EXPECT_LT(values[i].standard_error(), 0.01);
    }
  }
}

// Texels in a room by every technique; over all directions they are the fluence.
TEST(BakeOctahedral, RadianceByEveryTechniqueAndPlan) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer sensor =
      points({{Vec3(0.1f, 0.1f, 0.2f), Vec3(0), 0.15f}},
             {octahedral(OutputKind::RadianceOctahedral, 2), octahedral(OutputKind::IrradianceOctahedral, 2),
              OutputDesc{OutputKind::Fluence}});
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : ways(3)) {
    BlockMeans m;
    m.values.resize(size_t(sensor->planes()));
    for (int seed = 0; seed < 32; ++seed) {
      const Picture p =
          render(scene, sensor, way.options, way.name == "s = 0" ? 8192 : 2048, means.size() * 1000 + uint64_t(seed));
      for (int plane = 0; plane < sensor->planes(); ++plane)
        m.values[size_t(plane)].add(grey(&read(*p.film, FilmLayer::Color, 0, 0, plane)[0]));
    }
    double sum = 0;
    for (size_t i = 0; i < 4; ++i) sum += m.values[i].mean() * M_PI;
    EXPECT_NEAR(sum, m.values[8].mean(), 1e-4 * sum);
    means.push_back(m), names.push_back(way.name);
  }
  expect_all_same(means, names);
}

}  // namespace bdpt::bake_octahedral_test
