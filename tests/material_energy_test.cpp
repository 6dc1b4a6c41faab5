// No material makes energy, and those that should keep all of it do.
#include <gtest/gtest.h>

#include <numeric>

#include "material_testing.h"

namespace bdpt {
namespace {

using namespace material_testing;
using namespace statistics;

constexpr double kDegree = M_PI / 180;
const double kAngles[] = {0, 30, 60, 80, 88, 97, 120, 170};

// The integral over next of f |cos next|.
double albedo(const Material& m, const Rgb& reflectance, const Vec3& previous, TransportMode mode) {
  const std::vector<double> cells = SphereGrid(16, 32).integrate(
      [&](const Vec3& v) { return double(evaluate(m, reflectance, previous, v, mode).f.r) * std::fabs(double(v.z)); });
  return std::accumulate(cells.begin(), cells.end(), 0.0);
}

Estimate mean_weight(const Material& m, const Rgb& reflectance, const Vec3& previous, TransportMode mode, int count) {
  Uniform uniform(11);
  Estimate e;
  for (int i = 0; i < count; ++i) e.add(material_testing::sample(m, reflectance, previous, mode, uniform).weight.r);
  return e;
}

TEST(MaterialEnergy, DiffuseReflectsItsAlbedo) {
  for (double theta : kAngles) {
    const Vec3 previous = direction(theta * kDegree, 1);
    EXPECT_NEAR(albedo(diffuse(), Rgb(0.7f), previous, TransportMode::Radiance), 0.7, 1e-5);
    Uniform uniform(5);
    for (int i = 0; i < 1000; ++i) {
      const BsdfSample s =
          material_testing::sample(diffuse(), Rgb(0.7f, 0.1f, 1), previous, TransportMode::Radiance, uniform);
      ASSERT_EQ(s.weight.r, 0.7f);
      ASSERT_EQ(s.weight.g, 0.1f);
      ASSERT_EQ(s.weight.b, 1.0f);
    }
  }
}

// In a white furnace; what a lossless metal lacks has been scattered more than once between the microfacets.
TEST(MaterialEnergy, NoReflectingMaterialReflectsMoreThanArrives) {
  for (float alpha_u : {0.05f, 0.3f, 1.0f})
    for (float alpha_v : {0.1f, 0.6f})
      for (double theta : kAngles) {
        const Vec3 previous = direction(theta * kDegree, 1);
        const double lossless = albedo(lossless_conductor(alpha_u, alpha_v), Rgb(), previous, TransportMode::Radiance);
        EXPECT_LE(lossless, 1 + 3e-5);
        EXPECT_GE(lossless, 0.4);
        EXPECT_LT(albedo(conductor(alpha_u, alpha_v), Rgb(), previous, TransportMode::Importance), lossless);
      }
}

TEST(MaterialEnergy, TheMeanWeightIsTheIntegralOfTheScatteringFunction) {
  for (const Named& n : nonspecular_materials())
    for (double theta : kAngles)
      for (TransportMode mode : kModes) {
        if (n.material.type != MaterialType::Dielectric && mode == TransportMode::Importance) continue;
        SCOPED_TRACE(n.name + ", at " + std::to_string(theta) + " degrees");
        const Vec3 previous = direction(theta * kDegree, 1);
        const Estimate e = mean_weight(n.material, Rgb(0.5f), previous, mode, 40000);
        EXPECT_LT(deviation(e, albedo(n.material, Rgb(0.5f), previous, mode), 1e-4), kMaxDeviation);
      }
}

TEST(MaterialEnergy, NoSampleGainsImportance) {
  for (const auto& materials : {nonspecular_materials(), specular_materials()})
    for (const Named& n : materials) {
      SCOPED_TRACE(n.name);
      Uniform uniform(12);
      for (int i = 0; i < 20000; ++i) {
        const Vec3 previous = random_direction(uniform);
        const BsdfSample s = material_testing::sample(n.material, Rgb(1), previous, TransportMode::Importance, uniform);
        ASSERT_LE(norm(s.weight), 1 + 1e-5f);
      }
    }
}

TEST(MaterialEnergy, ASmoothDielectricKeepsAllImportance) {
  for (float ior : {0.7f, 1.0f, 1.33f, 2.4f}) {
    Uniform uniform(13);
    for (int i = 0; i < 20000; ++i) {
      const Vec3 previous = random_direction(uniform);
      const BsdfSample s =
          material_testing::sample(dielectric(ior, 0, 0), Rgb(), previous, TransportMode::Importance, uniform);
      ASSERT_EQ(s.weight.r, 1);
    }
  }
}

TEST(MaterialEnergy, RefractedRadianceScalesWithTheSquaredIndex) {
  for (float alpha : {0.0f, 0.2f}) {
    const Material glass = dielectric(1.5f, alpha, alpha);
    Uniform uniform(14);
    int refracted = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 previous = random_direction(uniform);
      const float u[3] = {uniform(), uniform(), uniform()};
      const BsdfSample radiance = sample(glass, Rgb(), previous, TransportMode::Radiance, u);
      const BsdfSample importance = sample(glass, Rgb(), previous, TransportMode::Importance, u);
      ASSERT_EQ(radiance.next, importance.next);
      if (was_absorbed(radiance)) continue;
      const bool is_refracted = radiance.next.z * previous.z < 0;
      refracted += is_refracted;
      // (n_previous / n_next)^2
      const float scale = !is_refracted ? 1 : previous.z > 0 ? 1 / 2.25f : 2.25f;
      ASSERT_NEAR(radiance.weight.r, importance.weight.r * scale, 1e-5f);
    }
    EXPECT_GT(refracted, 5000);
  }
}

// As the roughness goes to zero, the rough material scatters what the smooth one does, into the same directions.
TEST(MaterialEnergy, ARoughMaterialTendsToTheSmoothOne) {
  constexpr int kCount = 50000;
  const float alpha = 0.002f;
  for (const auto& [rough, smooth] : {std::pair(conductor(alpha, alpha), conductor(0, 0)),
                                      std::pair(dielectric(1.5f, alpha, alpha), dielectric(1.5f, 0, 0)),
                                      std::pair(dielectric(0.7f, alpha, 2 * alpha), dielectric(0.7f, 0, 0))})
    for (double theta : {0.0, 35.0, 60.0, 160.0, 115.0})
      for (TransportMode mode : kModes) {
        SCOPED_TRACE(theta);
        const Vec3 previous = direction(theta * kDegree, 2);
        Estimate weight[2], reflected[2], z[2], x[2];
        for (int k = 0; k < 2; ++k) {
          Uniform uniform(15 + k);
          for (int i = 0; i < kCount; ++i) {
            const BsdfSample s = material_testing::sample(k ? smooth : rough, Rgb(), previous, mode, uniform);
            weight[k].add(s.weight.r);
            reflected[k].add(s.next.z * previous.z > 0);
            z[k].add(s.weight.r * s.next.z);
            x[k].add(s.weight.r * s.next.x);
          }
        }
        const auto expect_close = [](const Estimate& a, const Estimate& b) {
          EXPECT_NEAR(a.mean(), b.mean(),
                      0.5 * 0.002 + kMaxDeviation * std::hypot(a.standard_error(), b.standard_error()));
        };
        expect_close(weight[0], weight[1]);
        expect_close(reflected[0], reflected[1]);
        expect_close(z[0], z[1]);
        expect_close(x[0], x[1]);
      }
}

}  // namespace
}  // namespace bdpt
