// Symmetries of the scattering function (Veach, chapter 5).
#include <gtest/gtest.h>

#include "material_testing.h"

namespace bdpt::material_reciprocity_test {

using namespace material_testing;

const Rgb kReflectance(0.2f, 0.5f, 0.8f);

// Pairs of directions of which one is sampled from the other, so that all lobes are met, and pairs at random.
template <class Function>
void for_each_pair(const Named& n, const Function& function) {
  SCOPED_TRACE(n.name);
  Uniform uniform(21);
  int met = 0;
  for (int i = 0; i < 20000 && !testing::Test::HasFailure(); ++i) {
    const Vec3 a = random_direction(uniform);
    Vec3 b = random_direction(uniform);
    if (i % 2) {
      const BsdfSample s = material_testing::sample(n.material, kReflectance, a, TransportMode::Radiance, uniform);
      if (!was_absorbed(s)) b = s.next;
    }
    if (std::fabs(a.z) < 1e-3f || std::fabs(b.z) < 1e-3f) continue;
    function(a, b);
    met += !is_black(evaluate(n.material, kReflectance, a, b, TransportMode::Radiance).f);
  }
  EXPECT_GT(met, 2000);
}

void expect_equal(const Rgb& a, const Rgb& b) {
  const float tolerance = 1e-3f * norm(b) + 1e-7f;
  ASSERT_NEAR(a.r, b.r, tolerance);
  ASSERT_NEAR(a.g, b.g, tolerance);
  ASSERT_NEAR(a.b, b.b, tolerance);
}

float index_at(const Material& m, const Vec3& v) {
  if (m.type == MaterialType::Mix) return index_at(*m.parts[0], v);
  const bool refracts = m.type == MaterialType::Dielectric ||
                        (m.type == MaterialType::Principled && m.transmission > 0 && !m.thin_walled);
  return refracts && v.z < 0 ? m.ior : 1;
}

TEST(MaterialReciprocity, BothTransportModesSeeTheSameScattering) {
  for (const auto& materials : {nonspecular_materials(), partly_specular_materials()})
    for (const Named& n : materials)
      for_each_pair(n, [&](const Vec3& eye, const Vec3& light) {
        expect_equal(evaluate(n.material, kReflectance, eye, light, TransportMode::Radiance).f,
                     evaluate(n.material, kReflectance, light, eye, TransportMode::Importance).f);
      });
}

// Veach 5.14, of which reflection's reciprocity is the part with equal indices.
TEST(MaterialReciprocity, ScatteringOverTheSquaredIndexIsSymmetric) {
  for (const auto& materials : {nonspecular_materials(), partly_specular_materials()})
    for (const Named& n : materials)
      for_each_pair(n, [&](const Vec3& a, const Vec3& b) {
        const Rgb f_ab = evaluate(n.material, kReflectance, a, b, TransportMode::Radiance).f;
        const Rgb f_ba = evaluate(n.material, kReflectance, b, a, TransportMode::Radiance).f;
        expect_equal(f_ab * (1 / sqr(index_at(n.material, a))), f_ba * (1 / sqr(index_at(n.material, b))));
      });
}

TEST(MaterialReciprocity, ScatteringTurnsWithIsotropicMaterialsOnly) {
  const Vec3 a = direction(0.5, 0.3), b = direction(0.9, 2.9), a_turned = direction(0.5, 1.3),
             b_turned = direction(0.9, 3.9);
  const auto f = [&](const Material& m, const Vec3& p, const Vec3& n) {
    return evaluate(m, kReflectance, p, n, TransportMode::Radiance).f.r;
  };
  const Material isotropic = conductor(0.3f, 0.3f), anisotropic = conductor(0.3f, 0.5f);
  EXPECT_NEAR(f(isotropic, a, b), f(isotropic, a_turned, b_turned), 1e-5f);
  EXPECT_GT(std::fabs(f(anisotropic, a, b) - f(anisotropic, a_turned, b_turned)), 1e-2f);
}

// Of an anisotropic material alpha_u is the roughness along x: the lobe is wider in that plane.
TEST(MaterialReciprocity, AlphaUIsTheRoughnessAlongX) {
  const Material m = conductor(0.5f, 0.1f);
  const Vec3 up(0, 0, 1);
  const auto f = [&](const Vec3& n) { return evaluate(m, kReflectance, up, n, TransportMode::Radiance).f.r; };
  EXPECT_GT(f(direction(0.5, 0)), 10 * f(direction(0.5, M_PI / 2)));
}

}  // namespace bdpt::material_reciprocity_test
