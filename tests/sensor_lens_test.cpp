// Lenses traced through their surfaces: rays, focus, vignetting, and the thin lens as their limit.
#include "camera_kinds.h"
#include "statistics.h"

#include <gtest/gtest.h>

#include <limits>

namespace bdpt::sensor_lens_test {

using statistics::deviation;
using statistics::Estimate;
using statistics::kMaxDeviation;
using statistics::Uniform;

constexpr double kFar = std::numeric_limits<double>::infinity();

CameraDesc lens_desc(const std::vector<LensSurface>& lens, int width = 24, int height = 16) {
  CameraDesc d;
  d.width = width, d.height = height;
  scenes::crop(d, 0, 0, width, height);
  d.type = CameraType::Lens;
  d.lens = lens;
  d.focus_distance = 0;
  return d;
}

// The lensmaker's equation, and its principal plane: f = R / (n - 1) for a plano-convex lens, curved side first; the
// image of what is far lies f - d / n behind its flat side.
TEST(SensorLens, FocusesWhereTheLensmakersEquationSays) {
  const double f = 25.85 / 0.517, d = 6;
  EXPECT_NEAR(image_distance(scenes::singlet(), kFar), f - d / 1.517, 1e-4);
  // 1/a + 1/b = 1/f, with a from the front vertex, where the first principal plane lies.
  for (const double a : {80.0, 200.0, 5000.0})
    EXPECT_NEAR(image_distance(scenes::singlet(), a), 1 / (1 / f - 1 / a) - d / 1.517, 1e-3);
  EXPECT_LT(image_distance(scenes::singlet(), 40), 0);  // a magnifying glass
  // Newton's x x' = f^2, f = 50 by the patent.
  const double b = image_distance(scenes::double_gauss(), kFar), near = image_distance(scenes::double_gauss(), 1e6);
  EXPECT_NEAR(std::sqrt((near - b) * 1e6), 50, 0.5);
}

// The double Gauss is corrected: all parallel rays meet within a tenth of a millimetre; without correction they do not.
TEST(SensorLens, ACorrectedLensFocusesAllOfItsRays) {
  const auto worst = [](const std::vector<LensSurface>& prescription, double largest) {
    const LensSystem lens(prescription, image_distance(prescription, kFar), {});
    double most = 0;
    for (double y = 0.5; y < largest; y += 0.5) {
      LensRay ray{lens.front_point(0, y), {0, 0, -1}};
      EXPECT_TRUE(lens.enter(ray)) << y;
      const Vec3d p = ray.origin + ray.direction * ((lens.film() - ray.origin.z) / ray.direction.z);
      most = std::max(most, std::fabs(p.y));
    }
    return most;
  };
  EXPECT_LT(worst(scenes::double_gauss(), 12), 0.05);
  EXPECT_GT(worst(scenes::singlet(), 11.5), 0.2);
}

// Whichever way it is followed, a ray meets the same points.
TEST(SensorLens, RaysAreReversible) {
  const LensSystem lens(scenes::double_gauss(), 38, {5, 0.3f});
  Uniform uniform(1);
  int passed = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d film(20 * double(uniform()) - 10, 20 * double(uniform()) - 10, lens.film());
    const Vec3d pupil(20 * double(uniform()) - 10, 20 * double(uniform()) - 10, lens.rear());
    LensRay ray{film, (pupil - film).normalized()};
    if (!lens.leave(ray)) continue;
    ++passed;
    LensRay outside{ray.origin + ray.direction * 500.0, -ray.direction};
    Vec3d p;
    double t;
    ASSERT_TRUE(lens.meet(outside, p, t));
    EXPECT_NEAR(t, 500, 1e-9);
    outside.origin = p;
    ASSERT_TRUE(lens.enter(outside));
    const Vec3d back = outside.origin + outside.direction * ((lens.film() - outside.origin.z) / outside.direction.z);
    EXPECT_NEAR((back - film).length(), 0, 1e-8);
  }
  EXPECT_GT(passed, 2000);
}

// A thin plano-convex lens of long focal length sees what the thin lens of the same radius and focus does.
TEST(SensorLens, ThinPrescriptionApproachesTheThinLens) {
  constexpr float kRadius = 500, kIor = 1.5f, kDistance = 4000;  // mm; f = 1000
  CameraDesc d = lens_desc({{kRadius, 0.2f, kIor, 20}, {0, 1, 1, 20}});
  d.focus_distance = kDistance * 0.001f;
  d.film_height = 60;
  const auto traced = make_camera(d);
  CameraDesc thin = d;
  thin.type = CameraType::Perspective;
  thin.lens_radius = 0.01f;
  const double image = image_distance(d.lens, kDistance);
  EXPECT_NEAR(image, 1 / (1 / 1000.0 - 1 / double(kDistance)), 0.5);
  thin.field_of_view = float(2 * std::atan(30 / image) * 180 / M_PI);
  const auto perspective = make_camera(thin);
  Uniform uniform(2);
  int compared = 0;
  const PixelRect bounds{0, 0, 24, 16};
  for (int i = 0; i < 5000; ++i) {
    // In focus, before and behind it.
    const float z = 1 + 9 * uniform();
    const Vec3 x(0.05f * z * (uniform() - 0.5f), 0.04f * z * (uniform() - 0.5f), -z);
    const float u[2] = {uniform(), uniform()};
    SensorPoint a, b;
    if (!perspective->sample_toward(x, u, bounds, a)) continue;
    if (!traced->hit(x, unit(a.p - x), 100, bounds, b)) continue;
    ++compared;
    EXPECT_NEAR(b.film.x, a.film.x, 0.02f);
    EXPECT_NEAR(b.film.y, a.film.y, 0.02f);
    EXPECT_NEAR(b.importance, a.importance, 0.01f * a.importance);
  }
  EXPECT_GT(compared, 4000);
}

// W_e against plain sums over film and stop: the irradiance of each film point, over that of the middle.
TEST(SensorLens, VignettesAsTheSolidAngleOfItsPupilDoes) {
  CameraDesc d = lens_desc(scenes::double_gauss(), 30, 30);
  d.film_height = 30;
  const auto camera = make_camera(d);
  const LensSystem lens(d.lens, double(d.lens.back().thickness), {});
  // Over a disk far larger than the pupil.
  const auto irradiance = [&](double r) {
    double sum = 0;
    constexpr int kRays = 700;
    for (int j = 0; j < kRays; ++j)
      for (int i = 0; i < kRays; ++i) {
        const Vec3d film(r, 0, lens.film()),
            p((2 * (i + 0.5) / kRays - 1) * 16, (2 * (j + 0.5) / kRays - 1) * 16, lens.rear());
        LensRay ray{film, (p - film).normalized()};
        if (!lens.leave(ray)) continue;
        const double z = lens.rear() - lens.film(), d2 = (p - film).length2();
        sum += z * z / (d2 * d2);
      }
    return sum;
  };
  const double middle = irradiance(0);
  Uniform uniform(3);
  for (const float r : {0.0f, 5.0f, 9.5f, 14.0f}) {
    Estimate estimate;
    for (int i = 0; i < 100000; ++i) {
      const float u[2] = {uniform(), uniform()};
      estimate.add(double(camera->start({15 + r, 15}, u, {0, 0, 30, 30}).weight));
    }
    EXPECT_LT(deviation(estimate, irradiance(double(r)) / middle, 2e-3), kMaxDeviation) << r << estimate.mean();
  }
  // Stopped down the corners come up: what is left is the film's cos^4.
  d.lens[5].aperture = 3;
  const auto stopped = make_camera(d);
  Estimate corner;
  for (int i = 0; i < 100000; ++i) {
    const float u[2] = {uniform(), uniform()};
    corner.add(double(stopped->start({29, 15}, u, {0, 0, 30, 30}).weight));
  }
  EXPECT_GT(corner.mean(), 1.2 * irradiance(14) / middle);
}

TEST(SensorLens, TheFilmMovesIntoFocus) {
  CameraDesc d = lens_desc(scenes::double_gauss());
  d.focus_distance = 0.5f;
  const auto camera = make_camera(d);
  // All of the lens sees a point of the plane in focus at one place of the film; a farther one it does not.
  const auto spread = [&](float z) {
    Uniform uniform(4);
    Estimate x;
    for (int i = 0; i < 2000; ++i) {
      const float u[2] = {uniform(), uniform()};
      SensorPoint seen;
      if (camera->sample_toward({0.01f, 0.005f, -z}, u, {0, 0, 24, 16}, seen)) x.add(double(seen.film.x));
    }
    EXPECT_GT(x.count(), 500);
    return std::sqrt(x.variance());
  };
  EXPECT_LT(spread(0.5f), 0.02);
  EXPECT_GT(spread(0.8f), 0.1);
}

TEST(SensorLens, ALensThatLetsNoLightThroughIsNone) {
  EXPECT_EQ(make_camera(lens_desc(
                {{0, 10, 1, 1e-4f}, {0, 20, 1, 20}, {0, 1e-3f, 1, 1e-4f}, {-3, 30, 1.5f, 6}, {-3, 1, 1, 1e-3f}})),
            nullptr);
}

}  // namespace bdpt::sensor_lens_test
