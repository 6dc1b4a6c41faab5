// No material makes energy, and those that should keep all of it do.
#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "material_testing.h"

namespace bdpt::material_energy_test {

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

// What a lossless metal lacks has been scattered more than once between the microfacets.
TEST(MaterialEnergy, NoSingleScatteringReflectsMoreThanArrives) {
  for (float alpha_u : {0.05f, 0.3f, 1.0f})
    for (float alpha_v : {0.1f, 0.6f})
      for (double theta : kAngles) {
        const Vec3 previous = direction(theta * kDegree, 1);
        const Material white = single_scattering(lossless_conductor(alpha_u, alpha_v));
        const double lossless = albedo(white, Rgb(), previous, TransportMode::Radiance);
        EXPECT_LE(lossless, 1 + 3e-5);
        EXPECT_GE(lossless, 0.4);
        EXPECT_LT(albedo(single_scattering(conductor(alpha_u, alpha_v)), Rgb(), previous, TransportMode::Importance),
                  lossless);
      }
}

// In a white furnace a material that absorbs nothing cannot be told from its surroundings. How near to it each model
// comes: tables are interpolated (1 %, of glass 2 %); of anisotropic surfaces the loss is known in part; below a coat
// a metal's light is thrown back at other angles than the model has it; and of glass and coats of the principled
// material what is scattered more than once is lost, and below a film what the film throws back of any wavelength.
TEST(MaterialEnergy, AWhiteFurnaceStaysWhite) {
  struct Furnace {
    std::string name;
    std::function<Material(float alpha)> material;
    double least, most;
  };
  const auto white_coated_metal = [](float coat_alpha, float alpha) {
    Material m = coated_conductor(1.5f, coat_alpha, alpha, alpha);
    m.eta = Rgb(0), m.k = Rgb(3);
    return m;
  };
  const Furnace furnaces[] = {
      {"rough diffuse", [](float a) { return rough_diffuse(a); }, 0.998, 1.002},
      {"diffuse transmission", [](float) { return reflecting(diffuse_transmission(Rgb(0.4f)), 0.6f); }, 0.999, 1.001},
      {"metal", [](float a) { return lossless_conductor(a, a); }, 0.99, 1.01},
      {"anisotropic metal", [](float a) { return lossless_conductor(a, 0.3f * a); }, 0.92, 1.01},
      {"very anisotropic metal", [](float a) { return lossless_conductor(0.1f * a, a); }, 0.85, 1.02},
      {"glass", [](float a) { return dielectric(1.5f, a, a); }, 0.98, 1.02},
      {"diamond", [](float a) { return dielectric(2.4f, a, a); }, 0.98, 1.02},
      {"plastic", [](float a) { return coated_diffuse(1.5f, a, a); }, 0.99, 1.01},
      {"plastic, rough below", [](float a) { return coated_diffuse(1.5f, a, a, 1); }, 0.97, 1.015},
      {"metal below smooth coat", [&](float a) { return white_coated_metal(0, a); }, 0.9, 1.005},
      {"metal below rough coat", [&](float a) { return white_coated_metal(a, 0.2f); }, 0.8, 1.005},
      {"principled", [](float a) { return principled(a); }, 0.99, 1.01},
      {"principled metal", [](float a) { return principled(a, [](Material& m) { m.metalness = 1; }); }, 0.99, 1.01},
      {"principled below smooth coat", [](float a) { return principled(a, [](Material& m) { m.coat = 1; }); }, 0.9,
       1.01},
      {"principled below rough coat and sheen",
       [](float a) {
         return principled(0.3f,
                           [&](Material& m) { m.coat = 0.7f, m.coat_alpha = a, m.sheen = Rgb(1), m.sheen_alpha = a; });
       },
       0.8, 1.01},
      {"principled glass", [](float a) { return principled(a, [](Material& m) { m.transmission = 1; }); }, 0.98, 1.02},
      {"principled thin wall",
       [](float a) { return principled(a, [](Material& m) { m.transmission = 1, m.thin_walled = true; }); }, 0.9, 1.01},
      {"principled leaf",
       [](float a) {
         return principled(a, [](Material& m) { m.diffuse_transmission = 0.5f, m.transmittance = Rgb(1); });
       },
       0.99, 1.01},
      {"paint below a film", [](float a) { return filmed(principled(a), 250); }, 0.9, 1.01},
      {"paint below a film of a high index", [](float a) { return filmed(principled(a), 300, 1, 2.2f); }, 0.6, 1.01},
      {"paint below half a film", [](float a) { return filmed(principled(a), 600, 0.5f, 1.3f); }, 0.92, 1.01},
      {"metal below a film", [](float a) { return filmed(principled(a, [](Material& m) { m.metalness = 1; }), 400); },
       0.98, 1.01},
      {"glass below a film",
       [](float a) { return filmed(principled(a, [](Material& m) { m.transmission = 1; }), 400, 1, 2.0f); }, 0.5, 1.01},
      {"glass below half a film",
       [](float a) { return filmed(principled(a, [](Material& m) { m.transmission = 1; }), 400, 0.5f); }, 0.75, 1.02},
      {"bubble",
       [](float a) {
         return filmed(principled(a, [](Material& m) { m.transmission = 1, m.thin_walled = true, m.ior = 1; }), 500, 1,
                       1.33f);
       },
       0.9, 1.01},
      {"mix", [](float a) { return mix(lossless_conductor(a, a), reflecting(diffuse(), 1), 0.5f); }, 0.99, 1.01},
  };
  for (const Furnace& f : furnaces)
    for (float alpha : {0.0f, 0.05f, 0.25f, 0.5f, 1.0f})
      for (double theta : {0.0, 40.0, 70.0, 86.0, 125.0}) {
        SCOPED_TRACE(f.name + ' ' + std::to_string(alpha) + ", at " + std::to_string(theta) + " degrees");
        const Material m = f.material(alpha);
        const float own = f.name == "diffuse transmission" ? 0.6f : 1;
        const Estimate e = mean_weight(m, Rgb(own), direction(theta * kDegree, 1), TransportMode::Importance, 10000);
        EXPECT_GT(e.mean() + kMaxDeviation * e.standard_error(), f.least);
        EXPECT_LT(e.mean() - kMaxDeviation * e.standard_error(), f.most);
      }
}

TEST(MaterialEnergy, TheMeanWeightIsTheIntegralOfTheScatteringFunction) {
  int number = 0;
  for (const Named& n : nonspecular_materials())
    for (double theta : kAngles)
      for (TransportMode mode : kModes) {
        if (!n.material.transmits() && mode == TransportMode::Importance) continue;
        if (++number % 5) continue;  // each material at some of the angles
        SCOPED_TRACE(n.name + ", at " + std::to_string(theta) + " degrees");
        const Vec3 previous = direction(theta * kDegree, 1);
        const Estimate e = mean_weight(n.material, Rgb(0.5f), previous, mode, 40000);
        EXPECT_LT(deviation(e, albedo(n.material, Rgb(0.5f), previous, mode), 1e-4), kMaxDeviation);
      }
}

// Single lobes gain nothing; where several meet a sample may weigh more than 1, by what the others have there.
TEST(MaterialEnergy, NoSampleWeighsMuch) {
  for (const auto& materials : {nonspecular_materials(), partly_specular_materials(), specular_materials()})
    for (const Named& n : materials) {
      SCOPED_TRACE(n.name);
      const MaterialType type = n.material.type;
      const bool is_microfacet = type == MaterialType::Conductor || type == MaterialType::Dielectric;
      const bool is_single = type == MaterialType::Diffuse || type == MaterialType::Mirror ||
                             (is_microfacet && (n.material.single_scattering || n.material.is_specular()));
      Uniform uniform(12);
      for (int i = 0; i < 20000 && !HasFailure(); ++i) {
        const Vec3 previous = random_direction(uniform);
        const BsdfSample s = material_testing::sample(n.material, Rgb(1), previous, TransportMode::Importance, uniform);
        ASSERT_LE(norm(s.weight), is_single ? 1 + 1e-5f : 20.0f);
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
  for (const auto& [rough, smooth] :
       {std::pair(conductor(alpha, alpha), conductor(0, 0)),
        std::pair(coated_diffuse(1.5f, alpha, alpha), coated_diffuse(1.5f, 0, 0)),
        std::pair(coated_conductor(1.5f, alpha, 0.5f, 0.5f), coated_conductor(1.5f, 0, 0.5f, 0.5f)),
        std::pair(principled(alpha), principled(0)), std::pair(dielectric(1.5f, alpha, alpha), dielectric(1.5f, 0, 0)),
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

}  // namespace bdpt::material_energy_test
