// Lights: the densities they tell are those they sample with.
#include "light/direct_lighting.h"
#include "sampling/warp.h"
#include "scenes.h"
#include "statistics.h"

#include <gtest/gtest.h>

namespace bdpt::light_density_test {

using statistics::deviation;
using statistics::Estimate;
using statistics::kMaxDeviation;
using statistics::Uniform;

// One of each kind.
std::shared_ptr<const Scene> all_lights() {
  scenes::Builder b;
  b.add(scenes::quad(Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)), scenes::emitter(Rgb(1, 2, 1)));
  b.add(scenes::disk(Vec3(0, 2, 0), Vec3(0, -1, 0), 0.5f, 9), scenes::emitter(Rgb(2), true));
  b.add_sphere(Vec3(2, 0, 1), 0.5f, scenes::emitter(Rgb(3)));
  b.add_sphere(Vec3(-2, 0, 1), 0.7f, scenes::emitter(Rgb(1), true));
  b.point(Vec3(0, 1, 2), Rgb(2));
  b.spot(Vec3(1, 1, 2), Vec3(-1, -1, 0), Rgb(5), 50, 30);
  b.environment(Rgb(0.5f));
  return b.build();
}

const Vec3 kPlaces[] = {Vec3(0.3f, 0.4f, 0.7f), Vec3(2.1f, 0.1f, 1.2f), Vec3(-2, 0, 1), Vec3(2, 0, 3),
                        Vec3(0.1f, 0.2f, -3)};

// Probabilities that are neither those of power nor all alike.
Discrete uneven(size_t lights) {
  std::vector<double> weights;
  for (size_t i = 0; i < lights; ++i) weights.push_back(double(1 + i * 3 % lights));
  return Discrete(weights);
}

TEST(LightDensity, OfAStartIsThatOfItsPositionTimesThatOfItsDirection) {
  const auto scene = all_lights();
  const Lights& lights = scene->lights();
  Uniform uniform(1);
  std::vector<int> seen(lights.count());
  const Discrete table = uneven(lights.count());
  for (const LightChoice& by : {LightChoice{}, LightChoice{.uniform = true}, LightChoice{.table = &table}})
    for (int i = 0; i < 20000; ++i) {
      const float u[4] = {uniform(), uniform(), uniform(), uniform()}, v[3] = {uniform(), uniform(), uniform()};
      LightStart start;
      ASSERT_TRUE(lights.start(u, v, by, start));
      ++seen[size_t(start.y0.light)];
      EXPECT_FLOAT_EQ(start.density_position, lights.position_density(start.y0, by));
      EXPECT_FLOAT_EQ(start.density_direction, lights.direction_density(start.y0, start.origin, start.direction));
      EXPECT_NEAR(length(start.direction), 1, 1e-5);
      const Rgb radiance = lights.emitted(start.y0, start.direction);
      const double expected = double(radiance.g) / (double(start.density_position) * start.density_direction);
      EXPECT_NEAR(start.weight.g, expected, 1e-5 * expected);
    }
  for (int n : seen) EXPECT_GT(n, 100);
}

// alpha_2 has the mean of the power, whatever the choice of lights: sums of what leaves all lights.
TEST(LightDensity, StartsCarryThePower) {
  const auto scene = all_lights();
  const Lights& lights = scene->lights();
  const double disk = 9 * 0.5 * std::sin(2 * M_PI / 9) * (0.25 * (2 * M_PI / 9) / std::sin(2 * M_PI / 9));
  // The spot's falloff by quadrature.
  double spot = 0;
  const double outer = std::cos(50 * M_PI / 180), inner = std::cos(30 * M_PI / 180);
  for (int i = 0; i < 10000; ++i) {
    const double t = std::clamp((1 - (1 - outer) * (i + 0.5) / 10000 - outer) / (inner - outer), 0.0, 1.0);
    spot += t * t * (3 - 2 * t) * 2 * M_PI * (1 - outer) / 10000;
  }
  const Vec3 size = scene->info().bounds_max - scene->info().bounds_min;
  const double r2 = 0.25 * double(length_squared(size));
  const double expected[] = {
      1 * M_PI * 2, 2 * M_PI * disk * 2,       3 * M_PI * 4 * M_PI * 0.25, M_PI * 4 * M_PI * 0.49 * 2, 2 * 4 * M_PI,
      5 * spot,     0.5 * 4 * M_PI * M_PI * r2};
  const Discrete table = uneven(lights.count());
  for (const LightChoice& by : {LightChoice{}, LightChoice{.uniform = true}, LightChoice{.table = &table}}) {
    Uniform uniform(2);
    std::vector<Estimate> power(lights.count());
    for (int i = 0; i < 200000; ++i) {
      const float u[4] = {uniform(), uniform(), uniform(), uniform()}, v[3] = {uniform(), uniform(), uniform()};
      LightStart start;
      ASSERT_TRUE(lights.start(u, v, by, start));
      for (size_t k = 0; k < power.size(); ++k) power[k].add(int(k) == start.y0.light ? double(start.weight.r) : 0);
    }
    for (size_t k = 0; k < power.size(); ++k)
      EXPECT_LT(deviation(power[k], expected[k], 1e-4 * expected[k]), kMaxDeviation + 0.5) << "light " << k;
  }
}

constexpr LightSelection kSelections[] = {LightSelection::Power, LightSelection::Uniform, LightSelection::Tree};

// Facing somewhere, or lit from all sides alike where the normal is zero.
Receiver receiver_at(const Vec3& x, Uniform& uniform, int i) {
  return {x, i % 3 == 0 ? Vec3(0) : sample_sphere(uniform(), uniform())};
}

bool sample_direct(const DirectLighting& lighting, const Receiver& x, Uniform& uniform, DirectLight& direct) {
  const double u = join(uniform(), uniform());
  const float u1 = uniform(), u2 = uniform();
  return lighting.sample(x, int(u * lighting.turns()), u * lighting.turns() - int(u * lighting.turns()), u1, u2,
                         direct);
}

// To the bit: a path's weights must not depend on which technique made it.
TEST(LightDensity, OfDirectLightingIsThatOfItsPoint) {
  const auto scene = all_lights();
  const Lights& lights = scene->lights();
  for (const LightSelection selection : kSelections) {
    const DirectLighting lighting(lights, selection);
    Uniform uniform(3);
    for (const Vec3& place : kPlaces)
      for (int i = 0; i < 5000; ++i) {
        const Receiver receiver = receiver_at(place, uniform, i);
        const Vec3& x = receiver.p;
        DirectLight direct;
        if (!sample_direct(lighting, receiver, uniform, direct)) continue;
        EXPECT_EQ(direct.density, lighting.density(direct.y0, receiver));
        EXPECT_NEAR(length(direct.direction), 1, 1e-5);
        EXPECT_FALSE(is_black(direct.radiance));
        if (direct.y0.infinite) continue;
        EXPECT_NEAR(length(x + direct.direction * direct.distance - direct.y0.p), 0, 1e-4 * direct.distance);
        const Rgb emitted = lights.emitted(direct.y0, -direct.direction);
        EXPECT_NEAR(emitted.g, direct.radiance.g, 1e-4 * emitted.g);
      }
  }
}

// The integral over all lights of P_A^d is one, those parts apart that cannot be chosen; by points that lie evenly on
// each light, as light subpaths start.
TEST(LightDensity, OfDirectLightingIntegratesToOne) {
  const auto scene = all_lights();
  const Lights& lights = scene->lights();
  for (const LightSelection selection :
       {LightSelection::Power, LightSelection::Uniform, LightSelection::Tree, LightSelection::Each}) {
    const DirectLighting lighting(lights, selection);
    for (const Vec3& place : kPlaces) {
      Uniform uniform(4);
      const Receiver x = receiver_at(place, uniform, 1);
      Estimate integral;
      for (int i = 0; i < 200000; ++i) {
        const float u[4] = {uniform(), uniform(), uniform(), uniform()}, v[3] = {uniform(), uniform(), uniform()};
        LightStart start;
        ASSERT_TRUE(lights.start(u, v, {true}, start));
        integral.add(lighting.density(start.y0, x) / start.density_position);
      }
      EXPECT_LT(deviation(integral, lighting.turns(), 1e-4 * lighting.turns()), kMaxDeviation)
          << int(selection) << ": " << x.p.x << ' ' << x.p.y << ' ' << x.p.z;
    }
  }
}

// What direct lighting samples with that density: the mean of 1 / density over a light is its area.
TEST(LightDensity, OfDirectLightingIsWhatItSamples) {
  const float radius = 0.5f;
  scenes::Builder b;
  b.add_sphere(Vec3(0), radius, scenes::emitter(Rgb(1), true));
  const auto scene = b.build();
  const DirectLighting lighting(scene->lights(), LightSelection::Power);
  for (float distance : {0.0f, 0.3f, 0.5001f, 0.6f, 2.0f, 50.0f}) {
    const Vec3 x(0, distance, 0);
    // The cap that is seen in four zones of equal area, by the cosine from its centre; within, the whole sphere.
    const double least = distance > radius ? radius / double(distance) : -1.0;
    Uniform uniform(5);
    Estimate zone[4];
    for (int i = 0; i < 100000; ++i) {
      DirectLight direct;
      if (!sample_direct(lighting, {x, Vec3(0)}, uniform, direct)) continue;
      const double place = (direct.y0.normal.y - least) / (1 - least);
      const int k = std::clamp(int(place * 4), 0, 3);
      EXPECT_GT(place, -1e-2);
      for (int j = 0; j < 4; ++j) zone[j].add(j == k ? 1 / double(direct.density) : 0);
    }
    const double area = 2 * M_PI * double(radius) * radius * (1 - least) / 4;
    // Rounding at the rim matters where the cap's cosine hardly changes.
    for (int j = 1; j < 4; ++j)
      EXPECT_LT(deviation(zone[j], area, 2e-3 * area), kMaxDeviation + 0.5)
          << "distance " << distance << ", zone " << j;
  }
}

TEST(LightDensity, SpotFallsOffSmoothlyBetweenItsCones) {
  scenes::Builder b;
  b.spot(Vec3(0), Vec3(0, 0, -1), Rgb(4), 40, 20);
  const auto scene = b.build();
  LightPoint y0;
  y0.light = 0;
  const auto at = [&](double degrees) {
    const double a = degrees * M_PI / 180;
    return scene->lights().emitted(y0, Vec3(float(std::sin(a)), 0, -float(std::cos(a)))).r;
  };
  EXPECT_EQ(at(0), 4);
  EXPECT_EQ(at(19.9), 4);
  EXPECT_EQ(at(40.1), 0);
  EXPECT_EQ(at(180), 0);
  const double outer = std::cos(40 * M_PI / 180), inner = std::cos(20 * M_PI / 180);
  for (double degrees : {22.0, 30.0, 38.0}) {
    const double t = (std::cos(degrees * M_PI / 180) - outer) / (inner - outer);
    EXPECT_NEAR(at(degrees), 4 * t * t * (3 - 2 * t), 1e-4) << degrees;
  }
}

TEST(LightDensity, TransformedMeshesShineFromTheirFrontOverTheirTrueArea) {
  for (float turn : {1.0f, -1.0f}) {  // a reflection keeps the front the image of the front
    scenes::Builder b;
    Transform t;
    t.m[0] = turn * 2, t.m[5] = 3, t.m[11] = 1;
    b.add(scenes::quad(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)), scenes::emitter(Rgb(1)), t);
    const auto scene = b.build();
    Uniform uniform(6);
    for (int i = 0; i < 100; ++i) {
      const float u[4] = {uniform(), uniform(), uniform(), uniform()}, v[3] = {uniform(), uniform(), uniform()};
      LightStart start;
      ASSERT_TRUE(scene->lights().start(u, v, {}, start));
      EXPECT_NEAR(start.density_position, 1 / 6.0, 1e-6);
      EXPECT_NEAR(start.y0.normal.z, 1, 1e-6) << turn;
      EXPECT_GT(start.direction.z, 0);
      EXPECT_NEAR(start.y0.p.z, 1, 1e-6);
    }
  }
}

}  // namespace bdpt::light_density_test
