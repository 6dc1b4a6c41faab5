// Cameras: what they start, what they see, and what hits them agree.
#include "scenes.h"
#include "statistics.h"

#include <gtest/gtest.h>

namespace bdpt {
namespace {

using statistics::deviation;
using statistics::Estimate;
using statistics::kMaxDeviation;
using statistics::Uniform;

struct Kind {
  std::string name;
  CameraDesc desc;
};

std::vector<Kind> cameras() {
  const scenes::Viewpoint view{Vec3(0.3f, 0.5f, 2), Vec3(-0.2f, 0.1f, -1), 55};
  std::vector<Kind> kinds;
  const auto add = [&](const char* name, const auto& change) {
    CameraDesc d = scenes::camera_desc(view, 24, 16);
    change(d);
    kinds.push_back({name, d});
  };
  const auto lens = [](CameraDesc& d) { d.lens_radius = 0.2f, d.focus_distance = 1.7f; };
  add("pinhole", [](CameraDesc&) {});
  add("lens", lens);
  for (int blades : {3, 4, 7})
    add(("lens of " + std::to_string(blades) + " blades").c_str(), [&](CameraDesc& d) {
      lens(d);
      d.aperture_blades = blades;
      d.aperture_rotation = 17;
    });
  const auto crop = [](CameraDesc& d) { d.crop[0] = 5, d.crop[1] = 3, d.crop[2] = 17, d.crop[3] = 12; };
  add("crop", crop);
  add("shift", [](CameraDesc& d) { d.shift[0] = 0.3f, d.shift[1] = -0.6f; });
  add("crop, shift, lens", [&](CameraDesc& d) {
    crop(d);
    lens(d);
    d.shift[0] = -0.2f, d.shift[1] = 0.4f;
  });
  add("reflected, lens", [&](CameraDesc& d) {
    lens(d);
    d.aperture_blades = 5;
    for (int row = 0; row < 3; ++row) d.transform.m[4 * row] *= -1;
  });
  return kinds;
}

PixelRect bounds_of(const Camera& camera, int margin = 2) {
  return {-margin, -margin, camera.width() + margin, camera.height() + margin};
}

// A start's film position comes back from the point it looks at, with the same densities.
TEST(SensorCamera, StartAndHitAgree) {
  for (const Kind& kind : cameras()) {
    const Camera camera(kind.desc);
    const PixelRect bounds = bounds_of(camera);
    Uniform uniform(1);
    for (int i = 0; i < 2000; ++i) {
      const FilmPosition film(float(bounds.x0) + uniform() * float(bounds.width()),
                              float(bounds.y0) + uniform() * float(bounds.y1 - bounds.y0));
      const float u[2] = {uniform(), uniform()};
      const EyeStart start = camera.start(film, u, bounds);
      EXPECT_NEAR(length(start.direction), 1, 1e-5);
      EXPECT_EQ(start.weight, 1);
      const Vec3 x = start.p + start.direction * (0.2f + 5 * uniform());
      SensorPoint seen;
      const bool found = camera.is_hittable() ? camera.hit(x, -start.direction, 100, bounds, seen)
                                              : camera.sample_toward(x, u, bounds, seen);
      const float margin = 1e-2f;  // those at the rim may round out of the lens or the picture
      if (!found) {
        const Vec2 from_rim(std::min(film.x - float(bounds.x0), float(bounds.x1) - film.x),
                            std::min(film.y - float(bounds.y0), float(bounds.y1) - film.y));
        EXPECT_TRUE(from_rim.x < margin || from_rim.y < margin || u[0] < 0.01f || u[0] > 0.99f || u[1] < 0.01f ||
                    u[1] > 0.99f || kind.desc.aperture_blades > 0)
            << kind.name;
        continue;
      }
      EXPECT_NEAR(seen.film.x, film.x, 2e-3) << kind.name;
      EXPECT_NEAR(seen.film.y, film.y, 2e-3) << kind.name;
      EXPECT_NEAR(length(seen.p - start.p), 0, 1e-5) << kind.name;
      EXPECT_FLOAT_EQ(seen.density_position, start.density_position);
      EXPECT_NEAR(seen.density_direction, start.density_direction, 1e-4 * start.density_direction);
      EXPECT_NEAR(seen.importance, seen.density_position * seen.density_direction, 1e-4 * seen.importance);
    }
  }
}

// Few of the starts may miss the lens' test by rounding.
TEST(SensorCamera, EveryStartIsOnTheLens) {
  for (const Kind& kind : cameras()) {
    const Camera camera(kind.desc);
    if (!camera.is_hittable()) continue;
    const PixelRect bounds = bounds_of(camera);
    Uniform uniform(2);
    int missed = 0;
    for (int i = 0; i < 5000; ++i) {
      const float u[2] = {uniform(), uniform()};
      const EyeStart start = camera.start({5, 5}, u, bounds);
      SensorPoint seen;
      missed += !camera.hit(start.p + start.direction, -start.direction, 2, bounds, seen);
    }
    EXPECT_LE(missed, 5) << kind.name;
  }
}

TEST(SensorCamera, SampleTowardAgreesWithHit) {
  for (const Kind& kind : cameras()) {
    const Camera camera(kind.desc);
    const PixelRect bounds = bounds_of(camera);
    Uniform uniform(3);
    int seen_count = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 x(4 * uniform() - 2, 4 * uniform() - 2, 4 * uniform() - 2);
      const float u[2] = {uniform(), uniform()};
      SensorPoint seen, hit;
      if (!camera.sample_toward(x, u, bounds, seen)) continue;
      ++seen_count;
      EXPECT_TRUE(seen.film.x >= float(bounds.x0) && seen.film.x < float(bounds.x1));
      EXPECT_TRUE(seen.film.y >= float(bounds.y0) && seen.film.y < float(bounds.y1));
      if (!camera.is_hittable() || !camera.hit(x, unit(seen.p - x), 100, bounds, hit)) continue;
      EXPECT_NEAR(hit.film.x, seen.film.x, 5e-3) << kind.name;
      EXPECT_NEAR(hit.film.y, seen.film.y, 5e-3) << kind.name;
      EXPECT_NEAR(hit.importance, seen.importance, 1e-3 * seen.importance) << kind.name;
      EXPECT_FALSE(camera.hit(x, unit(seen.p - x), 0.99f * length(seen.p - x), bounds, hit)) << "beyond tmax";
      EXPECT_FALSE(camera.hit(x, unit(x - seen.p), 100, bounds, hit)) << "away from it";
    }
    EXPECT_GT(seen_count, 50) << kind.name;
  }
}

// P_sigma-perp integrates to one over projected directions, at any point of the lens.
TEST(SensorCamera, DensityOfDirectionsIntegratesToOne) {
  for (const Kind& kind : cameras()) {
    const Camera camera(kind.desc);
    const PixelRect bounds = bounds_of(camera, 0);
    const Vec3 forward = -kind.desc.transform.column(2);
    const Frame frame(forward);
    Uniform uniform(4);
    const float off_axis[2] = {0.3f, 0.8f};
    const Vec3 z0 = camera.start({1, 1}, off_axis, bounds).p;
    Estimate integral;
    for (int i = 0; i < 200000; ++i) {
      // Evenly over projected directions: cosine-weighted, density 1/pi.
      const float r = std::sqrt(uniform()), phi = kTwoPi * uniform();
      const Vec3 w = frame.to_world(Vec3(r * std::cos(phi), r * std::sin(phi), safe_sqrt(1 - r * r)));
      SensorPoint seen;
      const bool found = camera.is_hittable() ? camera.hit(z0 + w, -w, 100, bounds, seen)
                                              : camera.sample_toward(z0 + w, off_axis, bounds, seen);
      integral.add(found ? double(seen.density_direction) * M_PI : 0);
    }
    EXPECT_LT(deviation(integral, 1, 1e-4), kMaxDeviation) << kind.name;
  }
}

// Starts lie evenly on the lens, and hits happen on the same shape: its area is one over the density.
TEST(SensorCamera, AreaOfTheLensIsThatOfItsDensity) {
  for (const Kind& kind : cameras()) {
    const Camera camera(kind.desc);
    if (!camera.is_hittable()) continue;
    const PixelRect bounds = bounds_of(camera);
    const CameraDesc& d = kind.desc;
    const Vec3 right = d.transform.column(0), up = d.transform.column(1), back = d.transform.column(2);
    Uniform uniform(5);
    Estimate inside;
    const float square = 4 * d.lens_radius * d.lens_radius;
    const float centre[2] = {0.5f, 0.5f};
    const Vec3 direction =
        camera.start({float(camera.width()) / 2, float(camera.height()) / 2}, centre, bounds).direction;
    for (int i = 0; i < 100000; ++i) {
      const Vec3 p = d.transform.column(3) + right * (d.lens_radius * (2 * uniform() - 1)) +
                     up * (d.lens_radius * (2 * uniform() - 1));
      SensorPoint seen;
      const bool found = camera.hit(p + direction, -direction, 100, bounds, seen);
      inside.add(found ? double(seen.density_position) * square : 0);
    }
    EXPECT_LT(deviation(inside, 1, 1e-4), kMaxDeviation) << kind.name;

    // Evenly: the means of starts by half of the lens are those of hits.
    Estimate to_right, to_up;
    for (int i = 0; i < 100000; ++i) {
      const float u[2] = {uniform(), uniform()};
      const Vec3 off = camera.start({1, 1}, u, bounds).p - d.transform.column(3);
      EXPECT_NEAR(dot(off, back), 0, 1e-5);
      EXPECT_LE(length(off), d.lens_radius * 1.0001f);
      to_right.add(dot(off, right)), to_up.add(dot(off, up));
    }
    EXPECT_LT(deviation(to_right, 0, 1e-6), kMaxDeviation) << kind.name;  // all shapes are centred
    EXPECT_LT(deviation(to_up, 0, 1e-6), kMaxDeviation) << kind.name;
  }
}

// Row 0 is the top one, x grows to the right; the middle of the picture lies ahead.
TEST(SensorCamera, PictureIsUpright) {
  const Camera camera(scenes::camera_desc({Vec3(0), Vec3(0, 0, -1), 90}, 20, 10));
  const float u[2] = {0.5f, 0.5f};
  const auto at = [&](float x, float y) { return camera.start({x, y}, u, {0, 0, 20, 10}).direction; };
  EXPECT_NEAR(length(at(10, 5) - Vec3(0, 0, -1)), 0, 1e-6);
  EXPECT_NEAR(length(at(10, 0) - unit(Vec3(0, 1, -1))), 0, 1e-6);  // 90 degrees from top to bottom
  EXPECT_NEAR(length(at(20, 10) - unit(Vec3(2, -1, -1))), 0, 1e-6);
}

TEST(SensorCamera, CropIsAPartOfTheWholePicture) {
  CameraDesc d = scenes::camera_desc({Vec3(0), Vec3(1, 2, -3), 50}, 20, 10);
  d.shift[0] = 0.1f, d.shift[1] = 0.2f;
  const Camera whole(d);
  d.crop[0] = 4, d.crop[1] = 2, d.crop[2] = 9, d.crop[3] = 8;
  const Camera part(d);
  EXPECT_EQ(part.width(), 5);
  EXPECT_EQ(part.height(), 6);
  EXPECT_NE(part.hash(), whole.hash());
  const float u[2] = {0.5f, 0.5f};
  for (float x : {0.0f, 1.5f, 5.0f}) {
    const Vec3 a = part.start({x, x}, u, {0, 0, 5, 6}).direction,
               b = whole.start({x + 4, x + 2}, u, {0, 0, 20, 10}).direction;
    EXPECT_NEAR(length(a - b), 0, 1e-6);
  }
}

}  // namespace
}  // namespace bdpt
