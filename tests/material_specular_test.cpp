// Materials that scatter into single directions.
#include <gtest/gtest.h>

#include "material/fresnel.h"
#include "material_testing.h"

namespace bdpt::material_specular_test {

using namespace material_testing;
using namespace statistics;

template <class Function>
void for_each_sample(const Material& m, const Function& function) {
  Uniform uniform(41);
  for (int i = 0; i < 20000 && !testing::Test::HasFailure(); ++i) {
    const Vec3 previous = random_direction(uniform);
    if (std::fabs(previous.z) < 1e-4f) continue;
    function(previous, material_testing::sample(m, Rgb(0.2f, 0.5f, 0.8f), previous, kModes[i % 2], uniform));
  }
}

TEST(MaterialSpecular, IsToldByTheMaterialAndByEverySample) {
  for (const Named& n : specular_materials()) {
    SCOPED_TRACE(n.name);
    EXPECT_TRUE(n.material.is_specular());
    for_each_sample(n.material, [&](const Vec3& previous, const BsdfSample& s) {
      if (was_absorbed(s)) return;
      ASSERT_TRUE(s.specular);
      const BsdfValue v = evaluate(n.material, Rgb(1), previous, s.next, TransportMode::Radiance);
      ASSERT_TRUE(is_black(v.f) && v.density == 0 && v.density_reverse == 0);
    });
  }
  for (const Named& n : nonspecular_materials()) EXPECT_FALSE(n.material.is_specular()) << n.name;
}

TEST(MaterialSpecular, MirrorsReflectAboutTheNormal) {
  for (const Material& m : {mirror(), conductor(0, 0)})
    for_each_sample(m, [&](const Vec3& previous, const BsdfSample& s) {
      ASSERT_EQ(s.next, Vec3(-previous.x, -previous.y, previous.z));
      ASSERT_EQ(s.density, std::fabs(s.next.z));
      ASSERT_EQ(s.density_reverse, std::fabs(previous.z));
    });
}

TEST(MaterialSpecular, AMirrorHasItsReflectanceAndAConductorFresnels) {
  for_each_sample(mirror(), [&](const Vec3&, const BsdfSample& s) {
    ASSERT_EQ(s.weight.r, 0.2f);
    ASSERT_EQ(s.weight.g, 0.5f);
    ASSERT_EQ(s.weight.b, 0.8f);
  });
  const Material gold = conductor(0, 0);
  for_each_sample(gold, [&](const Vec3& previous, const BsdfSample& s) {
    const float cosine = std::min(std::fabs(previous.z), 1.0f);
    ASSERT_NEAR(s.weight.r, fresnel_conductor(cosine, gold.eta.r, gold.k.r), 1e-6f);
    ASSERT_NEAR(s.weight.g, fresnel_conductor(cosine, gold.eta.g, gold.k.g), 1e-6f);
    ASSERT_NEAR(s.weight.b, fresnel_conductor(cosine, gold.eta.b, gold.k.b), 1e-6f);
  });
}

TEST(MaterialSpecular, OneSidedMaterialsAbsorbOnTheBack) {
  for (const Material& m :
       {one_sided(diffuse()), one_sided(mirror()), one_sided(conductor(0, 0)), one_sided(conductor(0.2f, 0.2f))}) {
    Uniform uniform(44);
    for_each_sample(m, [&](const Vec3& previous, const BsdfSample& s) {
      ASSERT_TRUE(previous.z > 0 || (was_absorbed(s) && s.density == 0));
      ASSERT_TRUE(was_absorbed(s) || s.next.z > 0);
      const Vec3 next = random_direction(uniform);
      const BsdfValue v = evaluate(m, Rgb(1), previous, next, TransportMode::Radiance);
      ASSERT_TRUE((previous.z > 0 && next.z > 0) || (is_black(v.f) && v.density == 0 && v.density_reverse == 0));
    });
  }
}

TEST(MaterialSpecular, TwoSidedMaterialsScatterOnTheSideOfArrival) {
  for (const Material& m : {diffuse(), mirror(), conductor(0, 0), conductor(0.2f, 0.2f)})
    for_each_sample(m, [&](const Vec3& previous, const BsdfSample& s) {
      ASSERT_TRUE(was_absorbed(s) || previous.z * s.next.z > 0);
    });
}

TEST(MaterialSpecular, RefractionFollowsSnellsLaw) {
  for (float ior : {0.7f, 1.33f, 2.4f}) {
    int refracted = 0;
    for_each_sample(dielectric(ior, 0, 0), [&](const Vec3& previous, const BsdfSample& s) {
      if (s.next.z * previous.z > 0) {
        ASSERT_EQ(s.next, Vec3(-previous.x, -previous.y, previous.z));
        return;
      }
      ++refracted;
      // The tangential parts are opposite, and so in one plane, with lengths n sin equal on both sides.
      const float index_p = previous.z > 0 ? 1 : ior, index_n = previous.z > 0 ? ior : 1;
      ASSERT_NEAR(s.next.x * index_n, -previous.x * index_p, 1e-6f);
      ASSERT_NEAR(s.next.y * index_n, -previous.y * index_p, 1e-6f);
      ASSERT_NEAR(length(s.next), 1, 1e-6f);
    });
    EXPECT_GT(refracted, 5000);
  }
}

TEST(MaterialSpecular, BeyondTheCriticalAngleAllIsReflected) {
  Uniform uniform(42);
  const double critical = std::asin(1 / 1.5);
  for (double theta = critical + 1e-3; theta < M_PI / 2 - 1e-3; theta += 0.01)
    for (int i = 0; i < 100; ++i) {
      const BsdfSample s = material_testing::sample(dielectric(1.5f, 0, 0), Rgb(), direction(M_PI - theta, 1),
                                                    TransportMode::Radiance, uniform);
      ASSERT_LT(s.next.z, 0);
      ASSERT_EQ(s.weight.r, 1);
    }
}

// Veach 10.3.5: the event's probability times eta^2 |cos| of either direction.
TEST(MaterialSpecular, CoefficientsAreTheEventsProbabilityTimesSquaredIndexAndCosine) {
  for (float ior : {0.7f, 1.5f})
    for (double theta : {0.1, 0.7, 1.4, 2.0, 2.9}) {
      const Material glass = dielectric(ior, 0, 0);
      const Vec3 previous = direction(theta, 1);
      constexpr int kCount = 40000;
      int count[2] = {0, 0};
      double probability[2] = {0, 0};  // of refraction, of reflection, as the coefficients tell it
      Uniform uniform(43);
      const float index_p = previous.z > 0 ? 1 : ior;
      for (int i = 0; i < kCount; ++i) {
        const BsdfSample s = material_testing::sample(glass, Rgb(), previous, TransportMode::Radiance, uniform);
        const bool is_reflected = s.next.z * previous.z > 0;
        const float index_n = s.next.z > 0 ? 1 : ior;
        ++count[is_reflected];
        probability[is_reflected] = s.density / (sqr(index_n) * std::fabs(s.next.z));
        ASSERT_NEAR(s.density_reverse, probability[is_reflected] * sqr(index_p) * std::fabs(previous.z), 1e-5);
      }
      if (count[0] > 0 && count[1] > 0) {
        EXPECT_NEAR(probability[0] + probability[1], 1, 1e-5);
      }
      EXPECT_LT(count_deviation(count[1], kCount, probability[1], 1e-6), kMaxDeviation);
      const float eta = previous.z > 0 ? ior : 1 / ior, cosine = std::fabs(previous.z);
      const float cos_t = safe_sqrt(refracted_cosine_squared(cosine, eta));
      EXPECT_NEAR(probability[1], fresnel_dielectric(cosine, cos_t, eta), 1e-5);
    }
}

// Perfectly anisotropic reflection: the cosine with the grooves is kept, and the angle round them goes by sin / 2.
TEST(MaterialSpecular, GroovesReflectOntoTheConeRoundThem) {
  for (double angle : {0.0, 0.7}) {
    const Vec3 u = direction(M_PI / 2, angle), v = cross(Vec3(0, 0, 1), u);
    Estimate along[2];
    for_each_sample(brushed(angle), [&](const Vec3& previous, const BsdfSample& s) {
      ASSERT_NEAR(dot(s.next, u), -dot(previous, u), 1e-6f);
      ASSERT_NEAR(length(s.next), 1, 1e-6f);
      ASSERT_GT(s.next.z * previous.z, 0);
      const float radius = std::sqrt(1 - sqr(dot(previous, u)));
      if (radius < 0.1f) return;
      ASSERT_NEAR(s.density, 0.5f * std::fabs(s.next.z) / radius, 1e-4f);
      ASSERT_NEAR(s.density_reverse, 0.5f * std::fabs(previous.z) / radius, 1e-4f);
      ASSERT_EQ(s.weight.g, 0.5f);
      along[0].add(dot(s.next, v) / radius);
      along[1].add(sqr(dot(s.next, v) / radius));
    });
    // cos(phi) is even in [-1, 1].
    EXPECT_LT(deviation(along[0], 0), kMaxDeviation);
    EXPECT_LT(deviation(along[1], 1.0 / 3), kMaxDeviation);
  }
}

// The chance of a Dirac beside other lobes is in its coefficients, both ways, and out of its weight.
TEST(MaterialSpecular, ADiracInPartHasItsChanceInItsCoefficients) {
  for (const Named& n : partly_specular_materials()) {
    SCOPED_TRACE(n.name);
    EXPECT_FALSE(n.material.is_specular());
    EXPECT_TRUE(n.material.has_specular());
    for (double theta : {0.2, 1.0, 1.4}) {
      const Vec3 previous = direction(theta, 1);
      constexpr int kCount = 40000;
      Uniform uniform(47);
      // By directions: up, down.
      int count[2] = {0, 0};
      double least[2] = {1e9, 1e9};
      for (int i = 0; i < kCount; ++i) {
        const BsdfSample s =
            material_testing::sample(n.material, Rgb(0.5f), previous, TransportMode::Importance, uniform);
        if (!s.specular) continue;
        const bool down = s.next.z < 0;
        ++count[down];
        const bool refracts = down && s.next != -previous;
        const float index = refracts ? n.material.type == MaterialType::Mix ? 1.5f : n.material.ior : 1;
        const double chance = s.density / (sqr(index) * std::fabs(s.next.z));
        least[down] = std::min(least[down], chance);
      }
      for (int i = 0; i < 2; ++i)
        if (count[i] > 0) {
          // Several Diracs into one direction each have their own; together they are at least the smallest.
          EXPECT_GT(count[i] / double(kCount) + kMaxDeviation * std::sqrt(0.25 / kCount), least[i]);
          if (n.name.find("coat") == std::string::npos || n.material.type == MaterialType::CoatedDiffuse)
            if (n.material.type != MaterialType::Principled) {
              EXPECT_LT(count_deviation(count[i], kCount, least[i], 1e-5), kMaxDeviation);
            }
        }
    }
  }
}

// What is sampled one way with a coefficient is sampled the other way with the reverse one.
TEST(MaterialSpecular, ADiracInPartHasTheSameCoefficientsBothWays) {
  for (const Named& n : partly_specular_materials()) {
    SCOPED_TRACE(n.name);
    Uniform uniform(48);
    int met = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 previous = random_direction(uniform);
      const BsdfSample forth = material_testing::sample(n.material, Rgb(0.5f), previous, kModes[i % 2], uniform);
      if (!forth.specular || std::fabs(previous.z) < 0.05f || std::fabs(forth.next.z) < 0.05f) continue;
      bool found = false;
      for (int k = 0; k < 4000 && !found; ++k) {
        const BsdfSample back = material_testing::sample(n.material, Rgb(0.5f), forth.next, kModes[i % 2], uniform);
        found = back.specular && length(back.next - previous) < 1e-3f &&
                std::fabs(back.density - forth.density_reverse) < 1e-3f * back.density &&
                std::fabs(back.density_reverse - forth.density) < 1e-3f * forth.density;
      }
      EXPECT_TRUE(found) << previous << " to " << forth.next;
      ++met;
    }
    EXPECT_GT(met, 5);
  }
}

TEST(MaterialSpecular, EqualIndicesLetAllLightStraightThrough) {
  for (float ior : {1.0f, 0.99995f, 1.00005f})
    for (float alpha : {0.0f, 0.3f})
      for_each_sample(dielectric(ior, alpha, alpha), [&](const Vec3& previous, const BsdfSample& s) {
        ASSERT_EQ(s.next, -previous);
        ASSERT_EQ(s.weight.r, 1);
        ASSERT_TRUE(s.specular);
      });
}

}  // namespace bdpt::material_specular_test
