// Portals: what they sample has the densities that they tell, which integrate to one.
#include "light/portal.h"

#include "light/direct_lighting.h"
#include "light_testing.h"
#include "statistics.h"

#include <gtest/gtest.h>

namespace bdpt::light_portal_test {

using statistics::deviation;
using statistics::Estimate;
using statistics::kMaxDeviation;
using statistics::Uniform;

// 3 x 2 in the plane z = 1, and a tilted one behind, partly seen through it.
const Portal kWindow = {Vec3(-1, 0, 1), Vec3(3, 0, 0), Vec3(0, 2, 0)};
const Portal kBehind = {Vec3(0, -1, 2), Vec3(2, 0, 1), Vec3(0, 2.5f, 0)};

constexpr float kOwn = 0.25f * kInvPi;

// Midpoints of fine equal areas of the sphere, which lie along no edge.
constexpr int kFine = 700;
template <class F>
double integral_over_directions(F&& f) {
  const Frame frame(unit(Vec3(1, 2, 3)));
  double sum = 0;
  for (int i = 0; i < kFine; ++i)
    for (int j = 0; j < kFine; ++j) {
      const float z = 1 - (2 * float(i) + 1) / float(kFine), r = safe_sqrt(1 - z * z);
      const float phi = kTwoPi * (float(j) + 0.5f) / float(kFine);
      sum += double(f(frame.to_world(Vec3(r * std::cos(phi), r * std::sin(phi), z))));
    }
  return sum * 4 * M_PI / (double(kFine) * kFine);
}

// Van Oosterom and Strackee (1983), of both triangles.
double solid_angle(const Portal& p, const Vec3& x) {
  using V = Imath::V3d;
  const V a = V(p.corner) - V(x), u(p.edge_u), v(p.edge_v);
  double sum = 0;
  for (const auto& [b, c] : {std::pair(a + u, a + u + v), std::pair(a + u + v, a + v)}) {
    const double la = a.length(), lb = b.length(), lc = c.length();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::fabs(sum);
}

const Vec3 kPlaces[] = {Vec3(0.2f, 0.5f, 0), Vec3(0.2f, 0.5f, 0.7f), Vec3(0.4f, 1, 1.5f),     Vec3(-4, 0.3f, 0.2f),
                        Vec3(0, 1, -6),      Vec3(3, 4, 5),          Vec3(-1.5f, -0.5f, 0.7f)};

TEST(LightPortal, DensitiesOfDirectionsIntegrateToOne) {
  for (const std::vector<Portal>& list : {std::vector{kWindow}, {kWindow, kBehind}, {kWindow, kWindow}}) {
    const Portals portals(list);
    for (const Vec3& x : kPlaces)
      EXPECT_NEAR(integral_over_directions([&](const Vec3& w) { return portals.direction_density(x, w, kOwn); }), 1,
                  0.02)
          << list.size() << ": " << x.x;
  }
}

TEST(LightPortal, ADirectionThroughAPortalHasHalfOfOneOverItsSolidAngle) {
  const Portals one({kWindow}), two({kWindow, kBehind});
  const Vec3 target = Vec3(0.6f, 0.7f, 1);  // in the window; beyond it is the other
  for (const Vec3& x : {Vec3(0.2f, 0.5f, 0), Vec3(0, 0.5f, 0.999f), Vec3(2, 5, -30), Vec3(0.3f, 0.2f, -3000)}) {
    const Vec3 w = unit(target - x);
    const double window = solid_angle(kWindow, x), behind = solid_angle(kBehind, x);
    const double expected = 0.5 * double(kOwn) + 0.5 / window;
    EXPECT_NEAR(one.direction_density(x, w, kOwn), expected, 1e-3 * expected) << x.z;
    EXPECT_EQ(one.direction_density(x, -w, kOwn), 0.5f * kOwn);
    if (x.z != 0) continue;
    EXPECT_NEAR(two.direction_density(x, w, kOwn), 0.5 * double(kOwn) + 1 / (window + behind), 1e-3 * expected);
  }
  // In its plane, and too far: the light's own density alone.
  EXPECT_EQ(one.direction_density(Vec3(4, 0, 1), Vec3(-1, 0, 0), kOwn), kOwn);
  EXPECT_EQ(one.direction_density(Vec3(0, 0, -1e5f), Vec3(0, 0, 1), kOwn), kOwn);
}

// Sums over cells of 1 / density, against the cell's solid angle: no more is sampled, and no less.
TEST(LightPortal, DirectionsFollowTheirDensity) {
  const Portals portals({kWindow, kBehind});
  for (const Vec3& x : kPlaces) {
    Uniform uniform(1);
    constexpr int kColumns = 24, kRows = 12, kSamples = 40000;
    std::vector<double> observed(size_t(kColumns) * kRows), expected(observed.size());
    const auto cell = [](const Vec3& w) {
      const int i = std::clamp(int((1 - w.y) / 2 * kRows), 0, kRows - 1);
      const int j = std::clamp(int((std::atan2(w.z, w.x) / kTwoPi + 0.5f) * kColumns), 0, kColumns - 1);
      return size_t(i * kColumns + j);
    };
    int own = 0;
    for (int i = 0; i < kSamples; ++i) {
      double u = join(uniform(), uniform());
      const float u1 = uniform(), u2 = uniform();
      Vec3 w;
      if (portals.sample_direction(x, u, u1, u2, w)) {
        EXPECT_NEAR(length(w), 1, 1e-6);
      } else {
        ++own;
        ASSERT_TRUE(u >= 0 && u < 1);
        w = sample_sphere(float(u), u2);
      }
      observed[cell(w)] += 1;
    }
    EXPECT_LT(statistics::count_deviation(own, kSamples, 0.5), kMaxDeviation);
    integral_over_directions([&](const Vec3& w) {
      expected[cell(w)] +=
          double(portals.direction_density(x, w, kOwn)) * 4 * M_PI / (double(kFine) * kFine) * kSamples;
      return 0;
    });
    EXPECT_GT(statistics::chi_square_test(observed, expected, false), statistics::kSignificance) << x.x << ' ' << x.z;
  }
}

// Whatever is sampled through a portal goes through it, from just before it to far away.
TEST(LightPortal, SampledDirectionsMeetAPortal) {
  const Portals portals({kWindow});
  for (double distance : {1e-6, 1e-4, 1e-2, 1.0, 100.0, 5000.0}) {
    const Vec3 x(0.3f, 0.7f, float(1 - distance));
    Uniform uniform(2);
    int missed = 0;
    for (int i = 0; i < 20000; ++i) {
      double u = 0.25;
      const float u1 = uniform(), u2 = uniform();
      Vec3 w;
      ASSERT_TRUE(portals.sample_direction(x, u, u1, u2, w));
      missed += portals.direction_density(x, w, 0) == 0;
    }
    EXPECT_LE(missed, 4) << distance;
  }
}

std::shared_ptr<const Scene> scene_with(const std::vector<Portal>& portals) {
  LightDesc l = lights::environment(Rgb(1));
  l.portals = portals;
  scenes::Builder b;
  b.light(l);
  b.add(scenes::box(Vec3(-3, -3, -3), Vec3(3, 3, 3), true), scenes::diffuse(0.5f));
  return b.build();
}

// Over the plane across a direction; what a portal sends past the disk is lost.
TEST(LightPortal, DensitiesOfRaysIntegrateToOne) {
  const Portal beside = {Vec3(30, 0, 0), Vec3(2, 0, 0), Vec3(0, 0, 3)};
  for (const Vec3& w : {Vec3(0, 0, -1), unit(Vec3(1, 2, 3)), unit(Vec3(-1, 0.6f, -0.3f)), Vec3(0, 1, 0)})
    for (const std::vector<Portal>& list :
         {std::vector{kWindow}, {kWindow, kBehind}, {kWindow, kWindow}, {kWindow, kBehind, beside}}) {
      const auto scene = scene_with(list);
      double all = 0, past = 0;
      for (const Portal& p : list) {
        const double area = std::fabs(double(dot(cross(p.edge_u, p.edge_v), w)));
        all += area;
        if (p.corner.x == 30) past += area;
      }
      LightPoint y0;
      y0.light = 0, y0.infinite = true, y0.normal = -w;
      const float radius = 0.5f * length(scene->info().bounds_max - scene->info().bounds_min);
      const Frame frame(w);
      double sum = 0;
      for (int i = 0; i < kFine; ++i)
        for (int j = 0; j < kFine; ++j) {
          const auto place = [&](int k) { return (2 * (float(k) + 0.5f) / float(kFine) - 1) * radius; };
          const Vec3 x = frame.t * place(i) + frame.b * place(j) + w * 0.7f;
          sum += double(scene->lights().direction_density(y0, x, w));
        }
      sum *= sqr(2 * radius / float(kFine));
      EXPECT_NEAR(sum, all > 0 ? 1 - 0.5 * past / all : 1, 0.02) << w.x << ": " << list.size();
    }
}

// Starts through a portal lie on it, on the disk's plane, and all along the ray the density is the same.
TEST(LightPortal, StartsGoThroughIt) {
  const auto scene = scene_with({kWindow});
  const Lights& light = scene->lights();
  Uniform uniform(3);
  int through = 0;
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const float u[4] = {uniform(), uniform(), uniform(), uniform()};
    const float v[3] = {uniform(), uniform(), 0.499f * uniform()};
    LightStart s;
    ASSERT_TRUE(light.start(u, v, {}, s));
    const float t = (1 - s.origin.z) / s.direction.z;
    const Vec3 p = s.origin + s.direction * t;
    const float margin = 1e-4f / std::fabs(s.direction.z);
    if (std::fabs(s.direction.z) < 2e-4f) continue;
    ++through;
    EXPECT_TRUE(p.x > -1 - margin && p.x < 2 + margin && p.y > -margin && p.y < 2 + margin) << p.x << ' ' << p.y;
    EXPECT_NEAR(dot(s.origin, s.y0.normal), std::sqrt(27.0f), 1e-4);
    int same = 0;
    for (float along : {0.0f, 1.0f, 5.0f})
      same +=
          std::fabs(light.direction_density(s.y0, s.origin + s.direction * along, s.direction) / s.density_direction -
                    1) < 1e-4f;
    EXPECT_TRUE(same == 3 || margin > 0.01f || p.x < -1 + margin || p.x > 2 - margin || p.y < margin ||
                p.y > 2 - margin);
  }
  EXPECT_GT(through, kSamples * 99 / 100);
}

// What comes from all sides, and through a portal from some: the irradiance of a square is pi either way.
TEST(LightPortal, DoNotChangeWhatArrives) {
  for (const std::vector<Portal>& list : {std::vector<Portal>{}, {kWindow}, {kWindow, kBehind}}) {
    LightDesc l = lights::environment(Rgb(1));
    l.portals = list;
    scenes::Builder b;
    b.light(l);
    b.add(lights::square(), scenes::diffuse(0.5f));
    const auto scene = b.build();
    const DirectLighting lighting(scene->lights(), LightSelection::Power);
    for (const Vec3& x : kPlaces) {
      Uniform uniform(4);
      Estimate irradiance;
      for (int i = 0; i < 50000; ++i) {
        DirectLight direct;
        const double u = join(uniform(), uniform());
        const float u1 = uniform(), u2 = uniform();
        ASSERT_TRUE(lighting.sample({x, Vec3(0)}, 0, u, u1, u2, direct));
        irradiance.add(double(std::max(0.0f, direct.direction.z)) / double(direct.density));
      }
      EXPECT_LT(deviation(irradiance, M_PI), kMaxDeviation) << list.size() << ": " << x.x;
    }
  }
}

}  // namespace bdpt::light_portal_test
