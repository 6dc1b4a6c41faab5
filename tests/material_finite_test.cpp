// Nothing a material returns is NaN, infinite or negative, whatever the directions and numbers.
#include <gtest/gtest.h>

#include "material/fresnel.h"
#include "material_testing.h"

namespace bdpt::material_finite_test {

using namespace material_testing;

std::vector<Named> all_materials() {
  std::vector<Named> all = nonspecular_materials();
  for (const Named& n : specular_materials()) all.push_back(n);
  for (float alpha : {1e-8f, 1e-4f, 3e-4f, 1e-3f, 0.01f})
    for (float stretch : {1.0f, 100.0f, 1e4f}) {
      const float alpha_v = std::min(alpha * stretch, 1.0f);
      const std::string name = std::to_string(alpha) + " x " + std::to_string(alpha_v);
      all.push_back({"conductor " + name, conductor(alpha, alpha_v)});
      all.push_back({"lossless conductor " + name, lossless_conductor(alpha_v, alpha)});
      for (float ior : {1.5f, 0.5f, 1.0002f, 0.9998f, 1.01f, 10.0f})
        all.push_back({"dielectric " + std::to_string(ior) + ", " + name, dielectric(ior, alpha, alpha_v)});
    }
  Material no_index = conductor(0.2f, 0.2f);
  no_index.eta = no_index.k = Rgb(0);
  all.push_back({"conductor without index", no_index});
  Material vacuum = conductor(0.2f, 0.2f);
  vacuum.eta = Rgb(1), vacuum.k = Rgb(0);
  all.push_back({"conductor of index 1", vacuum});
  Material smooth_along_v = conductor(0.2f, 0);
  all.push_back({"conductor smooth along v", smooth_along_v});
  return all;
}

Vec3 degenerate_direction(int i, Uniform& uniform) {
  const double phi = 2 * M_PI * uniform();
  const double z[] = {1, -1, 0, -0.0, 1e-20, 1e-10, -1e-7, 1e-6, 2e-6, -1e-5, 1e-4, -1e-3, 0.01};
  if (i % 3 == 0) return random_direction(uniform);
  const double cosine = z[static_cast<int>(uniform() * std::size(z))];
  const double sine = std::sqrt(1 - cosine * cosine);
  // Half of them on an axis
  const bool on_axis = i % 2;
  return Vec3(static_cast<float>(sine * (on_axis ? 1 : std::cos(phi))),
              static_cast<float>(sine * (on_axis ? 0 : std::sin(phi))), static_cast<float>(cosine));
}

bool is_good(float x) { return std::isfinite(x) && x >= 0; }
bool is_good(const Rgb& c) { return is_good(c.r) && is_good(c.g) && is_good(c.b); }

TEST(MaterialFinite, FresnelReflectanceOfAnyIndexAndAngle) {
  const auto expect_reflectance = [](float f) { ASSERT_TRUE(f >= 0 && f <= 1 + 1e-5f) << f; };
  const float cosines[] = {0, 1e-30f, 1e-6f, 1e-3f, 0.5f, 0x1.fffffep-1f, 1};
  const float indices[] = {0, 1e-20f, 1e-3f, 0.7f, 1, 0x1.000002p0f, 1.5f, 10};
  for (float cosine : cosines)
    for (float eta : indices)
      for (float k : indices) {
        expect_reflectance(fresnel_conductor(cosine, eta, k));
        if (eta < 1e-3f) continue;
        expect_reflectance(fresnel_dielectric(cosine, safe_sqrt(refracted_cosine_squared(cosine, eta)), eta));
      }
}

TEST(MaterialFinite, EvaluateForAnyTwoDirections) {
  for (const Named& n : all_materials()) {
    SCOPED_TRACE(n.name);
    Uniform uniform(51);
    for (int i = 0; i < 12000 && !HasFailure(); ++i) {
      const Vec3 a = degenerate_direction(i, uniform);
      Vec3 b;
      switch (i / 7 % 6) {
        case 0:
          b = a;
          break;
        case 1:
          b = -a;
          break;
        case 2:
          b = Vec3(-a.x, -a.y, a.z);
          break;
        case 3:
          b = Vec3(a.x, a.y, -a.z);
          break;
        case 4:
          b = material_testing::sample(n.material, Rgb(1), a, kModes[i % 2], uniform).next;
          break;
        default:
          b = degenerate_direction(static_cast<int>(uniform() * 6), uniform);
      }
      const BsdfValue v = evaluate(n.material, Rgb(1), a, b, kModes[i / 2 % 2]);
      ASSERT_TRUE(is_good(v.f) && is_good(v.density) && is_good(v.density_reverse))
          << a << ' ' << b << ' ' << v.f.r << ' ' << v.density << ' ' << v.density_reverse;
    }
  }
}

TEST(MaterialFinite, SampleForAnyDirectionAndNumbers) {
  const float last = 0x1.fffffep-1f;
  const float special[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.75f, last};
  for (const Named& n : all_materials()) {
    SCOPED_TRACE(n.name);
    Uniform uniform(52);
    for (int i = 0; i < 12000 && !HasFailure(); ++i) {
      const Vec3 a = degenerate_direction(i, uniform);
      float u[3];
      for (float& x : u) x = uniform() < 0.5f ? uniform() : special[static_cast<int>(uniform() * std::size(special))];
      const BsdfSample s = sample(n.material, Rgb(1), a, kModes[i / 2 % 2], u);
      ASSERT_TRUE(is_good(s.weight) && is_good(s.density) && is_good(s.density_reverse))
          << a << ' ' << s.weight.r << ' ' << s.density << ' ' << s.density_reverse;
      if (was_absorbed(s)) {
        ASSERT_TRUE(is_black(s.weight));
      } else {
        // Refraction magnifies the rounding of the direction it is given.
        const float ior = n.material.ior,
                    ratio = n.material.type == MaterialType::Dielectric ? std::max(ior, 1 / ior) : 1;
        ASSERT_NEAR(length(s.next), 1, 1e-6f * ratio * ratio);
      }
    }
  }
}

}  // namespace bdpt::material_finite_test
