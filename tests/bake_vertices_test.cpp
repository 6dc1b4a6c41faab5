// Means by hat functions: fluxes, every technique against each other, and values at vertices by least squares.
#include "bake/vertex_basis.h"

#include "baking.h"

namespace bdpt::bake_vertices_test {

using namespace baking;
using scenes::Builder;

std::shared_ptr<const VertexBasis> vertices(const ScenePointer& scene,
                                            const std::vector<OutputDesc>& outputs = {OutputDesc{}}) {
  return std::make_shared<const VertexBasis>(scene, std::vector<ReceivingInstance>{{0}}, outputs, false, nullptr);
}

// A square of n x n cells with moved vertices, one of no triangle at the end.
scenes::MeshData grid(int n) {
  scenes::MeshData m;
  statistics::Uniform u(3);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const float dx = inner ? 0.5f * (u() - 0.5f) : 0, dz = inner ? 0.5f * (u() - 0.5f) : 0;
      m.positions.push_back(Vec3(-1 + 2 * (float(i) + dx) / float(n), 0, 1 - 2 * (float(j) + dz) / float(n)));
    }
  const auto at = [&](int i, int j) { return uint32_t(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  m.positions.push_back(Vec3(0, 5, 0));
  return m;
}

scenes::MeshData lamp() {
  return scenes::quad(Vec3(-0.3f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, -0.2f), Vec3(0.5f, 0.6f, 0.4f),
                      Vec3(-0.3f, 0.6f, 0.4f));
}

// E at a point of the plane y = 0 under the lamp of radiance 3.
double lamp_irradiance(double x, double z) {
  double factor = 0;
  for (const int side : {-1, 1})
    for (const int end : {-1, 1}) {
      const double a = (side < 0 ? -0.3 : 0.5) - x, b = (end < 0 ? -0.2 : 0.4) - z, p = std::fabs(a) / 0.6,
                   q = std::fabs(b) / 0.6, u = std::sqrt(1 + p * p), v = std::sqrt(1 + q * q);
      factor += side * end * (a < 0 ? -1 : 1) * (b < 0 ? -1 : 1) *
                (p / u * std::atan(q / u) + q / v * std::atan(p / v)) / (2 * M_PI);
    }
  return 3 * M_PI * factor;
}

// Calls visit(vertices of a triangle, barycentric coordinates, part of the surface) for the midpoints of its n² parts.
void each_part(const scenes::MeshData& m, int n,
               const std::function<void(const std::array<uint32_t, 3>&, const double[3], double)>& visit) {
  for (const Triangle& t : m.triangles) {
    const Vec3 a = m.positions[t.a], b = m.positions[t.b], c = m.positions[t.c];
    const double area = 0.5 * double(length(cross(b - a, c - a))) / (n * n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n - i; ++j)
        for (const double third : {1.0, 2.0}) {
          if (third == 2 && i + j + 2 > n) continue;
          const double u = (i + third / 3) / n, v = (j + third / 3) / n, coordinates[] = {1 - u - v, u, v};
          visit({t.a, t.b, t.c}, coordinates, area);
        }
  }
}

TEST(BakeVertices, MeansByHatFunctionsUnderALamp) {
  const scenes::MeshData floor = grid(4);
  Builder b;
  b.add(floor, scenes::diffuse(0.0f));
  b.add(lamp(), scenes::emitter(Rgb(3)));
  const ScenePointer scene = b.build();
  const auto sensor = vertices(scene);
  ASSERT_EQ(sensor->vertices(), 26u);
  ASSERT_EQ(sensor->count(), 25u);
  EXPECT_EQ(sensor->area(25), 0);
  std::vector<double> means(26), areas(26);
  double flux = 0;
  each_part(floor, 60, [&](const std::array<uint32_t, 3>& t, const double c[3], double area) {
    double x = 0, z = 0;
    for (size_t k = 0; k < 3; ++k)
      x += c[k] * double(floor.positions[t[k]].x), z += c[k] * double(floor.positions[t[k]].z);
    const double e = lamp_irradiance(x, z);
    flux += e * area;
    for (size_t k = 0; k < 3; ++k) means[t[k]] += e * c[k] * area, areas[t[k]] += c[k] * area;
  });
  for (size_t j = 0; j < 25; ++j) {
    means[j] /= areas[j];
    EXPECT_NEAR(sensor->area(j), areas[j], 1e-5);
  }
  for (const Way& way :
       {Way{"t = 0", options_for(mask_of([](int, int t) { return t == 0; }), 1)},
        Way{"s = 0", options_for(mask_of([](int s, int) { return s == 0; }), 1)},
        Way{"s = 1", options_for(mask_of([](int s, int) { return s == 1; }), 1)}, Way{"all", options_for({}, 1)}}) {
    constexpr size_t seeds = 32;
    std::vector<Picture> pictures(seeds);
    in_parallel(seeds, [&](size_t i) { pictures[i] = render(scene, sensor, way.options, 1024, i); });
    std::vector<Estimate> values(25);
    Estimate sum;
    for (const Picture& p : pictures) {
      const std::vector<float> map = read(*p.film);
      double whole = 0;
      for (size_t j = 0; j < 25; ++j) {
        values[j].add(double(map[3 * j]));
        whole += sensor->area(j) * double(map[3 * j]);
      }
      sum.add(whole);
      EXPECT_EQ(p.film->rejected(), 0u);
    }
    for (size_t j = 0; j < 25; ++j) {
      expect_value(values[j], means[j], 200, way.name + ", vertex " + std::to_string(j), 1e-4 * means[j]);
      EXPECT_LT(values[j].standard_error(), 0.05 * means[j]) << way.name;
    }
    expect_value(sum, flux, 200, way.name + ", flux", 1e-4 * flux);
    EXPECT_LT(sum.standard_error(), 0.005 * flux) << way.name;
  }
}

TEST(BakeVertices, EveryTechniqueAndPlanMeasureTheSame) {
  Builder b;
  scenes::MeshData walls = scenes::box(Vec3(-1), Vec3(1), true, 63 - 2);
  b.add(walls, scenes::diffuse(Rgb(0.7f, 0.5f, 0.4f)));
  b.add(
      scenes::quad(Vec3(-0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, -0.6f), Vec3(0.4f, 0.9f, 0.1f), Vec3(-0.4f, 0.9f, 0.1f)),
      scenes::emitter(Rgb(4, 3.5f, 3)));
  b.add(scenes::box(Vec3(-0.6f, -1, -0.5f), Vec3(-0.1f, -0.4f, 0.1f), false), scenes::diffuse(0.6f));
  b.environment(Rgb(1, 1.5f, 2), 1);
  const ScenePointer scene = b.build();
  const auto sensor = vertices(scene, {OutputDesc{OutputKind::Irradiance}, OutputDesc{OutputKind::RadianceSh1}});
  std::vector<Way> all = ways(4);
  all.push_back({"cutoff", options_for({}, 4)});
  all.back().options.heuristic = Heuristic::Cutoff, all.back().options.cutoff = 0.1f;
  all.push_back({"balance", options_for({}, 4)});
  all.back().options.heuristic = Heuristic::Balance;
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const Way& way : all) {
    constexpr size_t seeds = 32;
    std::vector<Picture> pictures(seeds);
    in_parallel(seeds, [&](size_t i) {
      pictures[i] = render(scene, sensor, way.options, way.name == "s = 0" ? 512 : 128, means.size() * 1000 + i);
    });
    BlockMeans m;
    m.values.resize(size_t(sensor->planes()) * sensor->vertices());
    for (const Picture& p : pictures) {
      size_t value = 0;
      for (int plane = 0; plane < sensor->planes(); ++plane) {
        const std::vector<float> map = read(*p.film, FilmLayer::Color, 0, 0, plane);
        for (size_t j = 0; j < sensor->vertices(); ++j) m.values[value++].add(grey(&map[3 * j]));
      }
      m.rejected += p.film->rejected() + p.stats.rejected;
    }
    means.push_back(m), names.push_back(way.name);
  }
  expect_all_same(means, names);
}

// What is linear comes back to the rounding of a float, whatever the mesh; what is not measured stays.
TEST(BakeVertices, LeastSquaresReproduceALinearFunction) {
  for (const int n : {1, 7, 30}) {
    const scenes::MeshData floor = grid(n);
    Builder b;
    b.add(floor, scenes::diffuse(0.5f));
    const auto sensor = vertices(b.build());
    const auto f = [](const Vec3& p, size_t channel) {
      return channel == 0 ? 1.0 : 2 + 0.7 * double(p.x) - 0.4 * double(p.z);
    };
    std::vector<double> sums(2 * floor.positions.size());
    for (const Triangle& t : floor.triangles) {
      const Vec3 &a = floor.positions[t.a], &p = floor.positions[t.b], &c = floor.positions[t.c];
      const double area = 0.5 * double(length(cross(p - a, c - a)));
      for (size_t channel = 0; channel < 2; ++channel) {
        const double all = f(a, channel) + f(p, channel) + f(c, channel);
        for (const uint32_t j : {t.a, t.b, t.c})
          sums[2 * j + channel] += area / 12 * (all + f(floor.positions[j], channel));
      }
    }
    std::vector<float> values(sums.size(), 9);
    for (size_t j = 0; j + 1 < floor.positions.size(); ++j)
      for (size_t channel = 0; channel < 2; ++channel)
        values[2 * j + channel] = float(sums[2 * j + channel] / sensor->area(j));
    for (uint32_t channel = 0; channel < 2; ++channel) sensor->solve(values.data(), channel, 2);
    for (size_t j = 0; j + 1 < floor.positions.size(); ++j)
      for (size_t channel = 0; channel < 2; ++channel)
        EXPECT_NEAR(double(values[2 * j + channel]), f(floor.positions[j], channel), 3e-6) << n << ", vertex " << j;
    EXPECT_EQ(values[values.size() - 1], 9);
  }
}

}  // namespace bdpt::bake_vertices_test
