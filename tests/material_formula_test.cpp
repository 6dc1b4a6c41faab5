// The scattering functions are those of the literature, written out there term by term; here in double precision.
#include <gtest/gtest.h>

#include <Imath/ImathVec.h>

#include <complex>

#include "material/fresnel.h"
#include "material_testing.h"

namespace bdpt::material_formula_test {

using namespace material_testing;
using Vec3d = Imath::V3d;
using Complex = std::complex<double>;

// Fresnel's equations for any complex index, as Born and Wolf give them (1.5.2), with the refracted cosine by Snell.
double fresnel_reference(double cos_i, Complex eta) {
  const Complex cos_t = std::sqrt(1.0 - (1 - cos_i * cos_i) / (eta * eta));
  const Complex r_s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const Complex r_p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return 0.5 * (std::norm(r_s) + std::norm(r_p));
}

// Walter et al. 2007 with Heitz 2014's anisotropic D and Lambda.
struct Reference {
  double alpha_u, alpha_v;

  double d(const Vec3d& h) const {
    const double cos2 = h.z * h.z, cos4 = cos2 * cos2;
    const double slope_u = h.x / h.z / alpha_u, slope_v = h.y / h.z / alpha_v;
    return 1 / (M_PI * alpha_u * alpha_v * cos4 * std::pow(1 + slope_u * slope_u + slope_v * slope_v, 2));
  }
  double lambda(const Vec3d& v) const {
    const double slope2 = std::pow(alpha_u * v.x / v.z, 2) + std::pow(alpha_v * v.y / v.z, 2);
    return (-1 + std::sqrt(1 + slope2)) / 2;
  }
  double g2(const Vec3d& a, const Vec3d& b) const { return 1 / (1 + lambda(a) + lambda(b)); }
  double visible_d(const Vec3d& v, const Vec3d& h) const {
    return d(h) * std::fabs(v.dot(h)) / std::fabs(v.z) / (1 + lambda(v));
  }
};

void expect_near(double value, double expected) { ASSERT_NEAR(value, expected, 1e-3 * expected + 1e-6); }

// Random pairs; every other one sampled, to meet the lobes.
template <class Function>
void for_each_pair(const Material& m, const Function& function) {
  Uniform uniform(31);
  for (int i = 0; i < 20000 && !testing::Test::HasFailure(); ++i) {
    const Vec3 a = random_direction(uniform);
    Vec3 b = random_direction(uniform);
    if (i % 2) {
      const BsdfSample s = material_testing::sample(m, Rgb(), a, TransportMode::Radiance, uniform);
      if (!was_absorbed(s)) b = s.next;
    }
    if (std::fabs(a.z) > 1e-3f && std::fabs(b.z) > 1e-3f) function(a, b);
  }
}

TEST(MaterialFormula, DielectricFresnelEquations) {
  for (float eta : {0.4f, 0.75f, 0.999f, 1.0f, 1.001f, 1.33f, 1.5f, 3.0f})
    for (int i = 1; i <= 1000; ++i) {
      const float cos_i = i / 1000.0f;
      const float cos2_t = refracted_cosine_squared(cos_i, eta);
      if (std::fabs(cos2_t) < 1e-4f) continue;  // the edge of total reflection, where the slope is infinite
      const double f = cos2_t > 0 ? fresnel_dielectric(cos_i, std::sqrt(cos2_t), eta) : 1;
      ASSERT_NEAR(f, fresnel_reference(cos_i, eta), 2e-5) << eta << ' ' << cos_i;
      if (cos2_t > 0) {
        ASSERT_NEAR(f, fresnel_dielectric(std::sqrt(cos2_t), cos_i, 1 / eta), 1e-5);  // the same both ways
      }
    }
}

TEST(MaterialFormula, ConductorFresnelEquations) {
  for (float eta : {0.0f, 0.05f, 0.2f, 1.0f, 2.5f})
    for (float k : {0.0f, 0.01f, 1.0f, 4.0f, 9.0f}) {
      if (eta == 0 && k == 0) continue;
      for (int i = 1; i <= 1000; ++i) {
        const float cos_i = i / 1000.0f;
        const Complex index(eta, k);
        if (std::abs(1.0 - (1 - double(cos_i) * cos_i) / (index * index)) < 1e-3) continue;
        ASSERT_NEAR(fresnel_conductor(cos_i, eta, k), fresnel_reference(cos_i, index), 5e-5)
            << eta << ' ' << k << ' ' << cos_i;
      }
      if (eta != 1 || k != 0) {
        EXPECT_NEAR(fresnel_conductor(0, eta, k), 1, 1e-6);
      }
    }
}

TEST(MaterialFormula, RoughConductor) {
  for (const auto& [u, v] : {std::pair(0.05f, 0.05f), std::pair(0.3f, 0.6f), std::pair(1.0f, 0.1f)}) {
    const Material m = single_scattering(conductor(u, v));
    const Reference reference{u, v};
    for_each_pair(m, [&](const Vec3& a, const Vec3& b) {
      const BsdfValue value = evaluate(m, Rgb(), a, b, TransportMode::Radiance);
      if (a.z * b.z < 0) {
        ASSERT_TRUE(is_black(value.f) && value.density == 0 && value.density_reverse == 0);
        return;
      }
      const Vec3d p(a), n(b), h = (p + n).normalized();
      const double f = reference.d(h) * reference.g2(p, n) / (4 * std::fabs(p.z * n.z));
      const double cos_h = p.dot(h);
      expect_near(value.f.r, f * fresnel_reference(cos_h, {m.eta.r, m.k.r}));
      expect_near(value.f.g, f * fresnel_reference(cos_h, {m.eta.g, m.k.g}));
      expect_near(value.f.b, f * fresnel_reference(cos_h, {m.eta.b, m.k.b}));
      expect_near(value.density, reference.visible_d(p, h) / (4 * cos_h));
      expect_near(value.density_reverse, reference.visible_d(n, h) / (4 * cos_h));
    });
  }
}

TEST(MaterialFormula, RoughDielectric) {
  for (float ior : {1.5f, 0.7f})
    for (const auto& [u, v] : {std::pair(0.1f, 0.1f), std::pair(0.3f, 0.6f), std::pair(1.0f, 0.2f)}) {
      const Material m = single_scattering(dielectric(ior, u, v));
      const Reference reference{u, v};
      const double index = ior;
      for_each_pair(m, [&](const Vec3& eye, const Vec3& light) {
        const BsdfValue value = evaluate(m, Rgb(), eye, light, TransportMode::Radiance);
        const Vec3d o(eye), i(light);
        const double index_o = o.z > 0 ? 1 : index, index_i = i.z > 0 ? 1 : index;
        if (o.z * i.z > 0) {
          const Vec3d h = (o + i).normalized();
          const double cos_h = o.dot(h);
          if (std::fabs(1 - (1 - cos_h * cos_h) / std::pow(o.z > 0 ? index : 1 / index, 2)) < 1e-4) return;
          const double fresnel = fresnel_reference(cos_h, o.z > 0 ? index : 1 / index);
          expect_near(value.f.r, fresnel * reference.d(h) * reference.g2(o, i) / (4 * std::fabs(o.z * i.z)));
          expect_near(value.density, fresnel * reference.visible_d(o, h) / (4 * cos_h));
          expect_near(value.density_reverse, fresnel * reference.visible_d(i, h) / (4 * cos_h));
          return;
        }
        Vec3d h = -(i * index_i + o * index_o).normalized();  // eq. 16; to the front
        if (h.z < 0) h = -h;
        const double cos_i = i.dot(h), cos_o = o.dot(h);
        if (cos_i * i.z <= 0 || cos_o * o.z <= 0) {
          ASSERT_TRUE(is_black(value.f) && value.density == 0 && value.density_reverse == 0);
          return;
        }
        const double transmittance = 1 - fresnel_reference(std::fabs(cos_i), index_o / index_i);
        const double square = std::pow(index_i * cos_i + index_o * cos_o, 2);
        // eq. 21, and the densities by eq. 17
        expect_near(value.f.r, std::fabs(cos_i * cos_o / (i.z * o.z)) * index_o * index_o * transmittance *
                                   reference.g2(i, o) * reference.d(h) / square);
        expect_near(value.density,
                    transmittance * reference.visible_d(o, h) * index_i * index_i * std::fabs(cos_i) / square);
        expect_near(value.density_reverse,
                    transmittance * reference.visible_d(i, h) * index_o * index_o * std::fabs(cos_o) / square);
      });
    }
}

}  // namespace bdpt::material_formula_test
