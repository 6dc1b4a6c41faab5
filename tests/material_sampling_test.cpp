// Sampling agrees with the densities it claims.
#include <gtest/gtest.h>

#include <numeric>

#include "material_testing.h"

namespace bdpt::material_sampling_test {

using namespace material_testing;
using namespace statistics;

constexpr double kDegree = M_PI / 180;
constexpr double kQuadratureTolerance = 3e-5;  // of a whole sphere

// The sides where samples are compared, of the front (z > 0).
enum class Part { Front, Back, Both };

bool is_in(Part part, const Vec3& v) { return part == Part::Both || (part == Part::Front) == (v.z > 0); }

// Counts samples in the cells of a grid, and compares with the integral of the density that evaluate() gives. The
// samples elsewhere, most of them absorbed, are as many as that density leaves out.
void expect_samples_follow_density(const Material& m, const Vec3& previous, TransportMode mode, const SphereGrid& grid,
                                   Part part, uint32_t seed) {
  constexpr int kCount = 80000;
  const Rgb reflectance(0.5f);
  const std::vector<double> integrals = grid.integrate(
      [&](const Vec3& v) { return is_in(part, v) ? double(evaluate(m, reflectance, previous, v, mode).density) : 0; });
  const double total = std::accumulate(integrals.begin(), integrals.end(), 0.0);
  EXPECT_LE(total, 1 + kQuadratureTolerance);

  std::vector<double> observed(grid.size()), expected(integrals);
  for (double& e : expected) e *= kCount;
  Uniform uniform(seed);
  int elsewhere = 0;
  for (int i = 0; i < kCount; ++i) {
    const BsdfSample s = material_testing::sample(m, reflectance, previous, mode, uniform);
    if (was_absorbed(s) || s.specular || !is_in(part, s.next))
      ++elsewhere;
    else
      observed[grid.cell_of(s.next)] += 1;
  }
  EXPECT_LT(count_deviation(elsewhere, kCount, 1 - total, kQuadratureTolerance), kMaxDeviation)
      << elsewhere << " of " << kCount << " elsewhere, the density integrates to " << total;
  EXPECT_GT(chi_square_test(observed, expected, false), kSignificance);
}

TEST(MaterialSampling, SamplesFollowTheirDensity) {
  uint32_t seed = 0, number = 0;
  for (const auto& materials : {nonspecular_materials(), partly_specular_materials()})
    for (const Named& n : materials)
      for (double theta : {0.0, 37.0, 74.0, 88.5, 180 - 20.0, 180 - 62.0, 180 - 89.0})
        for (TransportMode mode : kModes) {
          if (++number % 5) continue;  // each material at some of the angles
          SCOPED_TRACE(n.name + ", at " + std::to_string(theta) + " degrees");
          expect_samples_follow_density(n.material, direction(theta * kDegree, 0.6), mode, SphereGrid(16, 32),
                                        Part::Both, ++seed);
        }
}

TEST(MaterialSampling, SamplesOfNarrowLobesFollowTheirDensity) {
  uint32_t seed = 1000;
  for (float alpha : {0.02f, 0.005f, 0.001f})
    for (float stretch : {1.0f, 3.0f})
      for (double theta : {0.0, 40.0, 155.0}) {
        SCOPED_TRACE("alpha " + std::to_string(alpha) + " x " + std::to_string(alpha * stretch) + ", at " +
                     std::to_string(theta) + " degrees");
        const Vec3 previous = direction(theta * kDegree, 0.6);
        const Vec3 reflected(-previous.x, -previous.y, previous.z);
        const float always_refract[3] = {0, 0, 0x1.fffffep-1f};
        const Vec3 refracted =
            sample(dielectric(1.5f, 0, 0), Rgb(), previous, TransportMode::Radiance, always_refract).next;
        ASSERT_LT(refracted.z * previous.z, 0);
        const SphereGrid round_reflected(24, 32, reflected, 6), round_refracted(24, 32, refracted, 6);
        const Part near = previous.z > 0 ? Part::Front : Part::Back, far = previous.z > 0 ? Part::Back : Part::Front;
        const Material metal = single_scattering(conductor(alpha, alpha * stretch)),
                       glass = dielectric(1.5f, alpha, alpha * stretch);
        const TransportMode mode = TransportMode::Radiance;
        expect_samples_follow_density(metal, previous, mode, round_reflected, Part::Both, ++seed);
        expect_samples_follow_density(glass, previous, mode, round_reflected, near, ++seed);
        expect_samples_follow_density(glass, previous, mode, round_refracted, far, ++seed);
      }
}

template <class Function>
void for_each_sample(const Named& n, int count, uint32_t seed, const Function& function) {
  SCOPED_TRACE(n.name);
  Uniform uniform(seed);
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const Vec3 previous = random_direction(uniform);
    const TransportMode mode = kModes[i % 2];
    const BsdfSample s = material_testing::sample(n.material, Rgb(0.2f, 0.5f, 0.8f), previous, mode, uniform);
    if (!was_absorbed(s)) function(previous, s, mode);
  }
}

TEST(MaterialSampling, ASampleHasTheDensitiesAndTheWeightOfEvaluate) {
  for (const auto& materials : {nonspecular_materials(), partly_specular_materials()})
    for (const Named& n : materials)
      for_each_sample(n, 20000, 7, [&](const Vec3& previous, const BsdfSample& s, TransportMode mode) {
        // Next to the plane the rounding of a direction is no longer small against its cosine.
        if (std::fabs(s.next.z) < 1e-3f || std::fabs(previous.z) < 1e-3f) return;
        if (s.specular) {
          ASSERT_TRUE(n.material.has_specular());
          return;
        }
        const BsdfValue v = evaluate(n.material, Rgb(0.2f, 0.5f, 0.8f), previous, s.next, mode);
        ASSERT_NEAR(s.density, v.density, 2e-3f * v.density);
        ASSERT_NEAR(s.density_reverse, v.density_reverse, 2e-3f * v.density_reverse);
        const float factor = std::fabs(s.next.z) / v.density;
        ASSERT_NEAR(s.weight.r, v.f.r * factor, 1e-3f * s.weight.r);
        ASSERT_NEAR(s.weight.g, v.f.g * factor, 1e-3f * s.weight.g);
        ASSERT_NEAR(s.weight.b, v.f.b * factor, 1e-3f * s.weight.b);
        ASSERT_NEAR(length(s.next), 1, 1e-6f);
      });
}

TEST(MaterialSampling, ReverseDensityIsTheDensityWithTheRolesExchanged) {
  for (const auto& materials : {nonspecular_materials(), partly_specular_materials()})
    for (const Named& n : materials)
      for_each_sample(n, 20000, 8, [&](const Vec3& previous, const BsdfSample& s, TransportMode mode) {
        if (s.specular) return;
        const TransportMode other =
            mode == TransportMode::Radiance ? TransportMode::Importance : TransportMode::Radiance;
        const BsdfValue forth = evaluate(n.material, Rgb(0.5f), previous, s.next, mode);
        const BsdfValue back = evaluate(n.material, Rgb(0.5f), s.next, previous, other);
        ASSERT_NEAR(forth.density_reverse, back.density, 1e-3f * back.density);
        ASSERT_NEAR(forth.density, back.density_reverse, 1e-3f * forth.density);
      });
}

}  // namespace bdpt::material_sampling_test
