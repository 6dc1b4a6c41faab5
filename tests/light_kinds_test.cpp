// What holds for every kind of light: it samples with the densities that it tells, and all that it does tells of the
// same emission.
#include "light/direct_lighting.h"
#include "light/texel_table.h"
#include "light_testing.h"
#include "statistics.h"

#include <gtest/gtest.h>

namespace bdpt::light_kinds_test {

using lights::Kind;
using statistics::deviation;
using statistics::Estimate;
using statistics::kMaxDeviation;
using statistics::Uniform;

// A square of bins, [0,1) x [0,1), against a density.
class Histogram {
 public:
  static constexpr int kSide = 12, kFine = 48;
  void add(const Vec2& place) { observed_[index(place)] += 1; }
  void miss() { ++missed_; }
  // density(place): per area of the square.
  template <class Density>
  double chance(Density&& density) const {
    double count = missed_;
    for (double n : observed_) count += n;
    std::vector<double> expected(observed_.size());
    constexpr int fine = kSide * kFine;
    for (int j = 0; j < fine; ++j)
      for (int i = 0; i < fine; ++i) {
        const Vec2 place((float(i) + 0.5f) / float(fine), (float(j) + 0.5f) / float(fine));
        expected[index(place)] += double(density(place)) * count / (double(fine) * fine);
      }
    return statistics::chi_square_test(observed_, expected, false);
  }

 private:
  static size_t index(const Vec2& place) {
    const auto bin = [](float v) { return size_t(std::clamp(int(v * kSide), 0, kSide - 1)); };
    return bin(place.y) * kSide + bin(place.x);
  }
  std::vector<double> observed_ = std::vector<double>(size_t(kSide) * kSide);
  double missed_ = 0;
};

// Directions as places of the square, by equal areas: 4 pi of the sphere.
Vec2 square_of(const Vec3& w) { return {(w.z + 1) / 2, (std::atan2(w.y, w.x) + kPi) / kTwoPi}; }
Vec3 direction_of(const Vec2& place) {
  const float z = 2 * place.x - 1, r = safe_sqrt(1 - z * z), phi = kTwoPi * place.y - kPi;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

class LightKinds : public testing::TestWithParam<Kind> {
 protected:
  LightKinds() {
    scenes::Builder b;
    GetParam().add(b);
    b.add(scenes::box(Vec3(-3, -3, -3), Vec3(3, 3, -2.9f), false), scenes::diffuse(0.5f));  // a scene with a size
    scene_ = b.build();
    disk_ = 0.25 * M_PI * double(length_squared(scene_->info().bounds_max - scene_->info().bounds_min));
  }
  const Lights& light() const { return scene_->lights(); }

  LightStart start(Uniform& uniform) const {
    const float u[4] = {uniform(), uniform(), uniform(), uniform()};
    return start(u, uniform);
  }
  LightStart start(const float u[4], Uniform& uniform) const {
    const float v[3] = {uniform(), uniform(), uniform()};
    LightStart start;
    EXPECT_TRUE(light().start(u, v, {}, start));
    return start;
  }
  // Whether light from there could reach x: else it passes the scene.
  bool may_reach(const LightPoint& y0, const Vec3& x) const {
    return !y0.infinite || light().disk_distance(x, y0.normal) > 0;
  }
  Vec3 center() const { return (scene_->info().bounds_max + scene_->info().bounds_min) * 0.5f; }
  // Where on the light y0 is, on the square.
  static Vec2 place_of(const LightPoint& y0) {
    return GetParam().place == Kind::Place::Direction ? square_of(y0.normal) : Vec2((y0.p.x + 1) / 2, (y0.p.y + 1) / 2);
  }
  // The other way round, as eye subpaths know it; area: what the whole square is on the light.
  LightPoint point_at(const Vec2& place, const LightPoint& like, double& area) const {
    LightPoint y0 = like;
    if (GetParam().place == Kind::Place::Square) {
      area = 4;
      y0.p = Vec3(2 * place.x - 1, 2 * place.y - 1, 0);
      // Corners (-1,-1), (1,-1), (1,1) and (-1,-1), (1,1), (-1,1).
      y0.primitive = y0.p.x < y0.p.y;
      const float x = place.x, y = place.y;
      y0.b = y0.primitive ? Vec2(x, y - x) : Vec2(x - y, y);
    } else {
      y0.normal = direction_of(place);
      area = 4 * M_PI;
      if (!y0.infinite) {
        area *= 0.25;
        y0.p = Vec3(0, 0, 1) + y0.normal * 0.5f;
      }
    }
    return y0;
  }

  std::shared_ptr<const Scene> scene_;
  double disk_;
};

TEST_P(LightKinds, PlacesOfStartsFollowTheirDensity) {
  if (GetParam().place == Kind::Place::Point) return;
  Uniform uniform(1);
  Histogram histogram;
  LightStart s;
  for (int i = 0; i < 100000; ++i) {
    s = start(uniform);
    s.density_position > 0 ? histogram.add(place_of(s.y0)) : histogram.miss();
    EXPECT_FLOAT_EQ(s.density_position, light().position_density(s.y0, {}));
  }
  EXPECT_GT(histogram.chance([&](const Vec2& place) {
    double area;
    const LightPoint y0 = point_at(place, s.y0, area);
    return light().position_density(y0, {}) * float(area);
  }),
            statistics::kSignificance);
}

TEST_P(LightKinds, DirectionsOfStartsFollowTheirDensity) {
  Uniform uniform(2);
  Histogram histogram;
  LightStart s;
  const float one[4] = {0.3f, 0.2f, 0.7f, 0.1f};  // of infinite lights, rays of one direction
  const float radius = float(std::sqrt(disk_ / M_PI));
  for (int i = 0; i < 100000; ++i) {
    s = start(uniform);
    if (s.y0.infinite) s = start(one, uniform);
    EXPECT_NEAR(length(s.direction), 1, 1e-5);
    EXPECT_FLOAT_EQ(s.density_direction, light().direction_density(s.y0, s.origin, s.direction));
    if (s.y0.infinite && s.density_direction > 0) {  // on the disk that is the scene's shadow
      EXPECT_NEAR(dot(s.direction, s.y0.normal), -1, 1e-6);
      const Vec3 p = Frame(s.y0.normal).to_local(s.origin - center()) * (1 / radius);
      EXPECT_NEAR(p.z, 1, 1e-4);
      histogram.add({p.x * p.x + p.y * p.y, (std::atan2(p.y, p.x) + kPi) / kTwoPi});
    } else if (s.density_direction == 0) {
      histogram.miss();
    } else {
      histogram.add(square_of(s.y0.has_area ? Frame(s.y0.normal).to_local(s.direction) : s.direction));
    }
  }
  EXPECT_GT(histogram.chance([&](const Vec2& place) -> float {
    if (s.y0.infinite) {
      const float r = std::sqrt(place.x), phi = kTwoPi * place.y - kPi;
      const Vec3 across = Frame(s.y0.normal).to_world(Vec3(r * std::cos(phi), r * std::sin(phi), 0));
      return light().direction_density(s.y0, center() + across * radius, s.direction) * float(disk_);
    }
    Vec3 w = direction_of(place);
    if (!s.y0.has_area) return light().direction_density(s.y0, Vec3(0), w) * 4 * kPi;
    const float cosine = std::fabs(w.z);
    w = Frame(s.y0.normal).to_world(w);
    return light().direction_density(s.y0, Vec3(0), w) * cosine * 4 * kPi;
  }),
            statistics::kSignificance);
}

TEST_P(LightKinds, DirectLightingFollowsItsDensity) {
  if (GetParam().place == Kind::Place::Point) return;
  for (const Vec3& x : {Vec3(0.2f, -0.3f, 0.6f), Vec3(2.5f, 1.5f, -2), Vec3(0.1f, 0.1f, 1.1f)}) {
    Uniform uniform(3);
    Histogram histogram;
    LightPoint like;
    const DirectLighting lighting(light(), LightSelection::Power);
    for (int i = 0; i < 100000; ++i) {
      DirectLight direct;
      const double u = join(uniform(), uniform());
      const float u1 = uniform(), u2 = uniform();
      if (lighting.sample({x, Vec3(0)}, 0, u, u1, u2, direct)) {
        like = direct.y0;
        histogram.add(place_of(direct.y0));
        EXPECT_EQ(direct.density, light().direct_density(direct.y0, x, 1));
      } else {
        histogram.miss();
      }
    }
    if (like.light < 0) continue;  // in the dark
    EXPECT_GT(histogram.chance([&](const Vec2& place) -> float {
      double area;
      const LightPoint y0 = point_at(place, like, area);
      if (is_black(light().emitted(y0, y0.infinite ? -y0.normal : x - y0.p))) return 0;
      return light().direct_density(y0, x, 1) * float(area);
    }),
              statistics::kSignificance)
        << x.x;
  }
}

// Of a Dirac the density is its coefficient, one, whoever asks.
TEST_P(LightKinds, APointOrADirectionHasADensityOfOne) {
  if (GetParam().place != Kind::Place::Point) return;
  const DirectLighting lighting(light(), LightSelection::Power);
  Uniform uniform(8);
  int lit = 0;
  for (int i = 0; i < 1000; ++i) {
    const LightStart s = start(uniform);
    EXPECT_EQ(s.density_position, 1);
    const Receiver x = {Vec3(uniform(), uniform(), uniform()) * 4 - Vec3(2), Vec3(0)};
    EXPECT_EQ(lighting.density(s.y0, x), 1);
    DirectLight direct;
    if (!lighting.sample(x, 0, double(uniform()), uniform(), uniform(), direct)) continue;
    ++lit;
    EXPECT_EQ(direct.density, 1);
  }
  EXPECT_GT(lit, 20);
}

TEST_P(LightKinds, StartsAndDirectLightingKnowTheSameEmission) {
  Uniform uniform(4);
  const DirectLighting lighting(light(), LightSelection::Power);
  for (int i = 0; i < 20000; ++i) {
    const LightStart s = start(uniform);
    const Rgb emitted = light().emitted(s.y0, s.direction);
    const double expected = double(emitted.g) / (double(s.density_position) * double(s.density_direction));
    EXPECT_EQ(is_black(s.weight), is_black(emitted) || s.density_direction == 0);
    if (is_black(s.weight)) continue;
    EXPECT_NEAR(s.weight.g, expected, 1e-5 * expected);
    const Vec3 x(uniform() * 4 - 2, uniform() * 4 - 2, uniform() * 4 - 2);
    DirectLight direct;
    if (!lighting.sample({x, Vec3(0)}, 0, double(uniform()), uniform(), uniform(), direct)) continue;
    const Rgb radiance = light().emitted(direct.y0, -direct.direction);
    EXPECT_NEAR(radiance.g, direct.radiance.g, 1e-4 * radiance.g + 1e-5);
    EXPECT_FALSE(is_black(direct.radiance));
    // Whatever arrives, light subpaths can bring it, but at an edge, for rounding.
    if (norm(radiance) < 1e-5f) continue;
    EXPECT_GT(light().position_density(direct.y0, {}), 0);
    EXPECT_TRUE(!may_reach(direct.y0, x) || light().direction_density(direct.y0, x, -direct.direction) > 0);
  }
}

// Wherever eye subpaths find light, the other techniques may.
TEST_P(LightKinds, WhatShinesMayBeSampled) {
  if (GetParam().place == Kind::Place::Point) return;
  Uniform uniform(5);
  const LightStart like = start(uniform);
  int shining = 0;
  for (int i = 0; i < 50000; ++i) {
    double area;
    LightPoint y0 = point_at({uniform(), uniform()}, like.y0, area);
    const Vec3 x(uniform() * 4 - 2, uniform() * 4 - 2, uniform() * 4 - 2);
    const Vec3 w = y0.infinite ? -y0.normal : unit(x - y0.p);
    if (is_black(light().emitted(y0, w))) continue;
    ++shining;
    EXPECT_GT(light().position_density(y0, {}), 0);
    EXPECT_TRUE(!may_reach(y0, x) || light().direction_density(y0, x, w) > 0);
    const bool far_side = !y0.infinite && GetParam().place == Kind::Place::Direction;  // of a sphere
    EXPECT_TRUE(far_side || light().direct_density(y0, x, 1) > 0);
  }
  EXPECT_GT(shining, 500);
}

TEST_P(LightKinds, StartsCarryThePower) {
  Uniform uniform(6);
  const LightStart like = start(uniform);
  double power = GetParam().power;
  if (power < 0) {
    power = 0;
    constexpr int fine = 600;
    for (int j = 0; j < fine; ++j)
      for (int i = 0; i < fine; ++i) {
        LightPoint y0 = like.y0;
        const Vec2 place((float(i) + 0.5f) / float(fine), (float(j) + 0.5f) / float(fine));
        double area = 4 * M_PI;
        Vec3 w = direction_of(place);
        if (GetParam().place == Kind::Place::Square) {  // Lambertian
          y0 = point_at(place, like.y0, area);
          w = Vec3(0, 0, 1);
          area *= M_PI * (is_black(light().emitted(y0, -w)) ? 1 : 2);
        } else if (y0.infinite) {
          y0.normal = w;
        }
        power += double(light().emitted(y0, w).g) * area / (double(fine) * fine);
      }
  }
  if (like.y0.infinite) power *= disk_;
  Estimate carried, most;
  for (int i = 0; i < 200000; ++i) {
    const LightStart s = start(uniform);
    carried.add(double(s.weight.g));
    most.add(double(norm(s.weight)));
  }
  EXPECT_LT(deviation(carried, power, 2e-3 * power), kMaxDeviation) << carried.mean() << " should be " << power;
  // By what lights are chosen: not exact, but near enough; of textured meshes by few places.
  EXPECT_GT(light().power(0), 0.85 * most.mean());
  EXPECT_LT(light().power(0), (GetParam().name.starts_with("textured") ? 1.5 : 1.15) * most.mean());
}

INSTANTIATE_TEST_SUITE_P(All, LightKinds, testing::ValuesIn(lights::kinds()), [](const auto& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(LightKinds, TheSunIsAsBrightAsItsIrradianceSays) {
  for (double degrees : {0.2665, 5.0, 80.0}) {
    scenes::Builder b;
    b.light(scenes::directional(degrees, Rgb(2)));
    b.add(lights::square(), scenes::diffuse(0.5f));
    const auto scene = b.build();
    Uniform uniform(7);
    Estimate irradiance, visible;
    for (int i = 0; i < 50000; ++i) {
      DirectLight direct;
      ASSERT_TRUE(scene->lights().place_direct(0, {0, 0, uniform(), uniform()}, Vec3(0), direct) || degrees < 1);
      const float density = scene->lights().direct_density(direct.y0, Vec3(0), 1);
      visible.add(density > 0 ? 1 : 0);
      if (density > 0)
        irradiance.add(double(direct.radiance.g) / density *
                       -double(dot(direct.direction, scenes::directional(0).direction)));
    }
    EXPECT_LT(deviation(irradiance, 2, 1e-3), kMaxDeviation) << degrees;
    EXPECT_GT(visible.mean(), 0.999) << degrees;
  }
}

// By hand: up is -z, and counterclockwise from there, looking down, comes -x.
TEST(LightKinds, MeasuredIntensitiesAreLinearAndMirrored) {
  LightDesc l;
  l.direction = Vec3(0, -1, 0);
  l.intensity = Rgb(2);
  const auto along = [&](std::vector<float> horizontal, double c, double g) {
    auto p = std::make_shared<Photometry>();
    p->vertical = {0, 90};
    p->horizontal = std::move(horizontal);
    for (float h : p->horizontal) p->intensities.insert(p->intensities.end(), {10, h});
    l.photometry = p;
    scenes::Builder b;
    b.light(l);
    LightPoint y0;
    y0.light = 0;
    c *= M_PI / 180, g *= M_PI / 180;
    const Vec3 w(float(-std::sin(c) * std::sin(g)), float(-std::cos(g)), float(-std::cos(c) * std::sin(g)));
    return double(b.build()->lights().emitted(y0, w * 3).r) / 2;
  };
  EXPECT_NEAR(along({0}, 77, 45), 5, 1e-4);
  EXPECT_NEAR(along({0}, 77, 91), 0, 0);
  EXPECT_NEAR(along({0, 360}, 77, 45), 5 + 77 / 2.0, 1e-3);
  EXPECT_NEAR(along({0, 360}, 300, 89.99999), 300, 1e-2);
  EXPECT_NEAR(along({0, 180}, 300, 45), 5 + 60 / 2.0, 1e-3);
  for (double c : {20.0, 160.0, 200.0, 340.0}) EXPECT_NEAR(along({0, 45, 90}, c, 45), 5 + 20 / 2.0, 1e-3) << c;
}

TEST(LightKinds, ASpotThrowsItsPictureUpright) {
  LightDesc l = lights::projector(Vec3(0), 45);
  l.direction = Vec3(0, 0, -1), l.up = Vec3(0, 2, 0), l.intensity = Rgb(1);
  l.cos_inner = l.cos_outer + 1e-4f;
  l.texture = scenes::picture(3, 3, [](uint32_t x, uint32_t y) { return Rgb(float(10 * y + x)); });
  scenes::Builder b;
  b.light(l);
  const auto scene = b.build();
  LightPoint y0;
  y0.light = 0;
  const auto toward = [&](float x, float y) { return scene->lights().emitted(y0, Vec3(x, y, -1)).r; };
  EXPECT_NEAR(toward(0, 0), 11, 1e-4);
  EXPECT_NEAR(toward(-2 / 3.0f, 0), 10, 1e-4);
  EXPECT_NEAR(toward(0, 2 / 3.0f), 1, 1e-4);
  EXPECT_NEAR(toward(1 / 3.0f, -1 / 3.0f), 16.5f, 1e-4);
  EXPECT_EQ(toward(0.9f, 0.9f), 0);  // beyond the cone
}

TEST(LightKinds, APictureOfAnEnvironmentIsWhatACameraAtRestSees) {
  scenes::Builder b;
  LightDesc l;
  l.type = LightType::Environment;
  l.radiance = Rgb(1);
  // 0: ahead, 1: right, 2: behind, 3: left, above +10.
  l.texture = scenes::picture(8, 4, [](uint32_t x, uint32_t y) {
    return Rgb(float((x + 5) % 8 / 2) + (y < 1 ? 10 : y > 2 ? 20 : 0));
  });
  b.light(l);
  l.transform.m[0] = l.transform.m[10] = -1;  // half a turn about y
  b.light(l);
  const auto scene = b.build();
  const auto seen = [&](const Vec3& w, int light) {
    LightPoint y0;
    y0.light = light;
    y0.infinite = true;
    y0.normal = unit(w);
    return scene->lights().emitted(y0, -y0.normal).r;
  };
  for (int turned : {0, 1}) {
    EXPECT_NEAR(seen(Vec3(0, 0, -1), turned), turned ? 2 : 0, 1e-3);
    EXPECT_NEAR(seen(Vec3(1, 0, 0), turned), turned ? 3 : 1, 1e-3);
    EXPECT_NEAR(seen(Vec3(0, 0, 1), turned), turned ? 0 : 2, 1e-3);
    EXPECT_NEAR(seen(Vec3(-1, 0, 0), turned), turned ? 1 : 3, 1e-3);
    EXPECT_GT(seen(Vec3(0.1f, 1, 0), turned), 9);
    EXPECT_LT(seen(Vec3(0.1f, 1, 0), turned), 14);
    EXPECT_GT(seen(Vec3(0, -1, 0.1f), turned), 19);
  }
}

TEST(TexelTable, SumsToOneAndLosesNothingBesideASun) {
  const auto weight = [](uint32_t x, uint32_t y) {
    if (x == 3 && y == 2) return 1e12;
    return y == 5 || (x == 6 && y == 2) ? 0.0 : 1e-3 * (x + 1);
  };
  const TexelTable table(8, 7, weight);
  double sum = 0;
  for (uint32_t y = 0; y < 7; ++y)
    for (uint32_t x = 0; x < 8; ++x) {
      sum += double(table.probability(x, y));
      EXPECT_EQ(table.probability(x, y) > 0, weight(x, y) > 0) << x << ' ' << y;
    }
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_TRUE(TexelTable(3, 3, [](uint32_t, uint32_t) { return 0; }).empty());
}

}  // namespace bdpt::light_kinds_test
