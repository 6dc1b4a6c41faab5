// Cameras: what they start, what they see, and what hits them agree.
#include "camera_kinds.h"
#include "statistics.h"

#include <gtest/gtest.h>

#include <array>

namespace bdpt::sensor_camera_test {

using statistics::deviation;
using statistics::Estimate;
using statistics::kMaxDeviation;
using statistics::Uniform;

using Kind = scenes::CameraKind;

const scenes::Viewpoint kView{Vec3(0.3f, 0.5f, 2), Vec3(-0.2f, 0.1f, -1), 55};

// Pinholes and thin lenses.
std::vector<Kind> cameras() {
  std::vector<Kind> kinds;
  const auto add = [&](const char* name, const auto& change) {
    CameraDesc d = scenes::camera_desc(kView, 24, 16);
    change(d);
    kinds.push_back({name, d, 0});
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
    scenes::reflect(d);
  });
  add("leaning plane in focus", [&](CameraDesc& d) {
    lens(d);
    d.focus_tilt[0] = 70, d.focus_tilt[1] = -60;
  });
  return kinds;
}

std::vector<Kind> all_cameras() {
  std::vector<Kind> kinds = cameras();
  for (const Kind& kind : scenes::camera_kinds(kView)) kinds.push_back(kind);
  return kinds;
}

PixelRect bounds_of(const Sensor& sensor, int margin = 2) {
  return {-margin, -margin, sensor.width() + margin, sensor.height() + margin};
}

// A start's film position comes back from the point it looks at, with the same densities: their product where they
// may
// be split in several ways.
TEST(SensorCamera, StartAndHitAgree) {
  for (const Kind& kind : all_cameras()) {
    const auto owner = make_camera(kind.desc);
    const Camera& camera = *owner;
    const PixelRect bounds = bounds_of(camera, camera.has_seams() ? 0 : 2);
    Uniform uniform(1);
    int started = 0, lost = 0;
    for (int i = 0; i < 2000; ++i) {
      const FilmPosition film(float(bounds.x0) + uniform() * float(bounds.width()),
                              float(bounds.y0) + uniform() * float(bounds.y1 - bounds.y0));
      const float u[2] = {uniform(), uniform()};
      const EyeStart start = camera.start(film, u, bounds);
      if (start.weight == 0) continue;
      ++started;
      EXPECT_NEAR(length(start.direction), 1, 1e-5);
      EXPECT_NEAR(start.cosine, dot(start.direction, start.normal), 1e-5);
      const float distance = 0.2f + 5 * uniform();
      const Vec3 x = start.p + start.direction * distance;
      SensorPoint seen;
      bool found = false;
      // A panorama's margin shows the other side again: of two places for one direction, one is chosen.
      for (int trial = 0; trial < 30 && !found; ++trial) {
        const float v[2] = {uniform(), uniform()};
        found = camera.is_hittable() ? camera.hit(x, -start.direction, 100, bounds, seen)
                                     : camera.sample_toward(x, v, bounds, seen);
        found = found && std::fabs(seen.film.x - film.x) + std::fabs(seen.film.y - film.y) < 0.05f;
      }
      if (!found) {
        ++lost;  // rounded out of the lens or the picture
        continue;
      }
      EXPECT_NEAR(seen.film.x, film.x, 5e-3) << kind.name;
      EXPECT_NEAR(seen.film.y, film.y, 5e-3) << kind.name;
      EXPECT_NEAR(length(seen.p - start.p), 0, 1e-5) << kind.name;
      // Per area of x.
      const double g = start.parallel ? 1 : double(start.cosine) / (double(distance) * double(distance));
      const double density = double(start.density_position) * double(start.density_direction) * g;
      const double seen_g = absdot(seen.normal, start.direction) / (double(distance) * double(distance));
      EXPECT_NEAR(double(seen.density_position) * double(seen.density_direction) * seen_g, density, 1e-3 * density)
          << kind.name;
      EXPECT_NEAR(double(seen.importance) * seen_g, double(start.weight) * density,
                  1e-3 * double(start.weight) * density)
          << kind.name;
    }
    EXPECT_GT(started, 800) << kind.name;
    EXPECT_LT(lost, started / 50) << kind.name;
  }
}

// The film's cells, 4 x 4, and all of it.
using Cells = std::array<Estimate, 17>;

void add(Cells& cells, const FilmPosition& film, const PixelRect& bounds, double value) {
  const auto cell = [](float v, int low, int high) {
    return std::clamp(int(4 * (v - float(low)) / float(high - low)), 0, 3);
  };
  const int at = 4 * cell(film.y, bounds.y0, bounds.y1) + cell(film.x, bounds.x0, bounds.x1);
  for (int i = 0; i < 16; ++i) cells[size_t(i)].add(i == at ? value : 0);
  cells[16].add(value);
}
void add_none(Cells& cells) {
  for (Estimate& cell : cells) cell.add(0);
}

void expect_same_cells(const Cells& a, const Cells& b, const std::string& what) {
  for (size_t i = 0; i < a.size(); ++i)
    EXPECT_LT(deviation(a[i], b[i]), kMaxDeviation + 0.5)  // of some hundred cells
        << what << ", cell " << i << ": " << a[i].mean() << " and " << b[i].mean();
}

// The measure of rays that a film's cell sees, and what their densities integrate to, come out alike by starts on the
// film, by points of a sphere around that choose z_0, and by rays that find the lens by themselves.
TEST(SensorCamera, StartsAndPointsAndHitsMeasureTheSameRays) {
  constexpr int kSamples = 200000;
  constexpr double kRadius = 3;  // of the sphere
  for (const Kind& kind : all_cameras()) {
    const auto owner = make_camera(kind.desc);
    const Camera& camera = *owner;
    const PixelRect bounds = bounds_of(camera, camera.has_seams() ? 0 : 2);
    const Vec3 centre = kind.desc.transform.column(3);
    Uniform uniform(6);
    Cells started, seen, hit, started_density, seen_density, hit_density;
    for (int i = 0; i < kSamples; ++i) {
      const FilmPosition film(float(bounds.x0) + uniform() * float(bounds.width()),
                              float(bounds.y0) + uniform() * float(bounds.y1 - bounds.y0));
      const float u[2] = {uniform(), uniform()};
      const EyeStart start = camera.start(film, u, bounds);
      add(started, film, bounds, double(start.weight));
      add(started_density, film, bounds, start.weight > 0);
    }
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 n = sample_sphere(uniform(), uniform()), x = centre + n * float(kRadius);
      const float u[2] = {uniform(), uniform()};
      SensorPoint z0;
      if (!camera.sample_toward(x, u, bounds, z0)) {
        add_none(seen), add_none(seen_density);
        continue;
      }
      const Vec3 edge = x - z0.p, w = unit(edge);
      const double g = double(absdot(w, n)) * double(absdot(w, z0.normal)) / double(length_squared(edge));
      const double area = 4 * M_PI * kRadius * kRadius;
      add(seen, z0.film, bounds, double(z0.importance) / double(z0.density_position) * g * area);
      add(seen_density, z0.film, bounds, double(z0.density_direction) * g * area);
    }
    expect_same_cells(started, seen, kind.name + ", starts and points");
    expect_same_cells(started_density, seen_density, kind.name + ", densities of starts and points");
    if (!camera.is_hittable()) continue;
    // Of the cone in which the lens lies: the traced ones are smaller.
    const double sine = (kind.desc.type == CameraType::Lens ? 0.11 : 0.25) / kRadius;
    const auto one_minus_cos = float(1 - std::sqrt(1 - sine * sine));
    for (int i = 0; i < 2 * kSamples; ++i) {
      const Vec3 n = sample_sphere(uniform(), uniform()), x = centre + n * float(kRadius);
      const Vec3 w = Frame(-n).to_world(sample_cone(uniform(), uniform(), one_minus_cos));
      SensorPoint z0;
      if (!camera.hit(x, w, 100, bounds, z0)) {
        add_none(hit), add_none(hit_density);
        continue;
      }
      const double rays = double(absdot(w, n)) * 4 * M_PI * kRadius * kRadius * 2 * M_PI * double(one_minus_cos);
      add(hit, z0.film, bounds, double(z0.importance) * rays);
      add(hit_density, z0.film, bounds, double(z0.density_position) * double(z0.density_direction) * rays);
    }
    expect_same_cells(started, hit, kind.name + ", starts and hits");
    expect_same_cells(started_density, hit_density, kind.name + ", densities of starts and hits");
  }
}

// A uniformly bright world is uniformly bright in the picture, but where a lens vignettes.
TEST(SensorCamera, PixelsMeasureTheMeanRadiance) {
  for (const Kind& kind : all_cameras()) {
    const auto camera = make_camera(kind.desc);
    const PixelRect bounds = bounds_of(*camera, 0);
    Uniform uniform(7);
    Estimate whole, middle;
    for (int i = 0; i < 200000; ++i) {
      const Vec2 part(uniform(), uniform());
      const FilmPosition film(part.x * float(bounds.x1), part.y * float(bounds.y1)),
          near(float(bounds.x1) / 2 + part.x * 0.01f, float(bounds.y1) / 2 + part.y * 0.01f);
      const float u[2] = {uniform(), uniform()};
      whole.add(double(camera->start(film, u, bounds).weight));
      middle.add(double(camera->start(near, u, bounds).weight));
    }
    EXPECT_LT(deviation(middle, 1, 1e-3), kMaxDeviation) << kind.name << ": " << middle.mean();
    const double bright = 1 - double(kind.darkness);
    if (kind.desc.type == CameraType::Lens)
      EXPECT_LT(whole.mean(), bright) << kind.name;
    else
      EXPECT_LT(deviation(whole, bright, 1e-6), kMaxDeviation) << kind.name << ": " << whole.mean();
  }
}

// Few of the starts may miss the lens' test by rounding.
TEST(SensorCamera, EveryStartIsOnTheLens) {
  for (const Kind& kind : cameras()) {
    const auto owner = make_camera(kind.desc);
    const Camera& camera = *owner;
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
  for (const Kind& kind : all_cameras()) {
    const auto owner = make_camera(kind.desc);
    const Camera& camera = *owner;
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
    const auto owner = make_camera(kind.desc);
    const Camera& camera = *owner;
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
    const auto owner = make_camera(kind.desc);
    const Camera& camera = *owner;
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
  const auto camera = make_camera(scenes::camera_desc({Vec3(0), Vec3(0, 0, -1), 90}, 20, 10));
  const float u[2] = {0.5f, 0.5f};
  const auto at = [&](float x, float y) { return camera->start({x, y}, u, {0, 0, 20, 10}).direction; };
  EXPECT_NEAR(length(at(10, 5) - Vec3(0, 0, -1)), 0, 1e-6);
  EXPECT_NEAR(length(at(10, 0) - unit(Vec3(0, 1, -1))), 0, 1e-6);  // 90 degrees from top to bottom
  EXPECT_NEAR(length(at(20, 10) - unit(Vec3(2, -1, -1))), 0, 1e-6);
}

TEST(SensorCamera, CropIsAPartOfTheWholePicture) {
  CameraDesc d = scenes::camera_desc({Vec3(0), Vec3(1, 2, -3), 50}, 20, 10);
  d.shift[0] = 0.1f, d.shift[1] = 0.2f;
  const auto whole = make_camera(d);
  d.crop[0] = 4, d.crop[1] = 2, d.crop[2] = 9, d.crop[3] = 8;
  const auto part = make_camera(d);
  EXPECT_EQ(part->width(), 5);
  EXPECT_EQ(part->height(), 6);
  EXPECT_NE(part->hash(), whole->hash());
  const float u[2] = {0.5f, 0.5f};
  for (float x : {0.0f, 1.5f, 5.0f}) {
    const Vec3 a = part->start({x, x}, u, {0, 0, 5, 6}).direction,
               b = whole->start({x + 4, x + 2}, u, {0, 0, 20, 10}).direction;
    EXPECT_NEAR(length(a - b), 0, 1e-6);
  }
}

// What lies ahead moves to the right and up in the picture as it does before the camera; crops show the same.
TEST(SensorCamera, EveryKindIsUprightAndCropsToAPartOfItself) {
  for (Kind kind : scenes::camera_kinds(kView)) {
    SCOPED_TRACE(kind.name);
    CameraDesc d = kind.desc;
    scenes::crop(d, 0, 0, d.width, d.height);
    d.shift[0] = d.shift[1] = d.focus_tilt[0] = d.focus_tilt[1] = 0;  // all is in focus
    const auto camera = make_camera(d);
    const Transform& m = d.transform;
    const float u[2] = {0.5f, 0.5f};
    const auto film = [&](const Camera& of, const Vec3& p) {
      SensorPoint z0;
      EXPECT_TRUE(of.sample_toward(m.point(p), u, bounds_of(of, 0), z0));
      return z0.film;
    };
    const Vec2 ahead = film(*camera, Vec3(0, 0, -1.2f)), right = film(*camera, Vec3(0.1f, 0, -1.2f)),
               up = film(*camera, Vec3(0, 0.1f, -1.2f));
    if (d.type == CameraType::Cube) {  // as the vector of a texture lookup has it, mirrored
      EXPECT_NEAR(ahead.x, 5.5f * 8, 1e-3);
      EXPECT_LT(right.x, ahead.x - 0.1f);
    } else {
      EXPECT_NEAR(ahead.x, float(d.width) / 2, 1e-2);
      EXPECT_GT(right.x, ahead.x + 0.1f);
    }
    EXPECT_NEAR(ahead.y, float(d.height) / 2, 1e-2);
    EXPECT_NEAR(right.y, ahead.y, 1e-2);
    EXPECT_LT(up.y, ahead.y - 0.1f);
    EXPECT_NEAR(up.x, ahead.x, 1e-2);
    const Vec2 corner(std::floor(ahead.x) - 2, std::floor(ahead.y) - 3);
    scenes::crop(d, int(corner.x), int(corner.y), int(corner.x) + 4, int(corner.y) + 5);
    EXPECT_NEAR(length(Vec3(film(*make_camera(d), Vec3(0, 0, -1.2f)).x + corner.x - ahead.x,
                            film(*make_camera(d), Vec3(0, 0, -1.2f)).y + corner.y - ahead.y, 0)),
                0, 1e-4);
  }
}

TEST(SensorCamera, MapsOfAllDirections) {
  const auto direction = [](CameraType type, float field_of_view, int width, int height, float x, float y) {
    CameraDesc d;
    d.type = type, d.field_of_view = field_of_view, d.width = width, d.height = height;
    scenes::crop(d, 0, 0, width, height);
    const float u[2] = {0.5f, 0.5f};
    return make_camera(d)->start({x, y}, u, {0, 0, width, height}).direction;
  };
  const auto expect = [](const Vec3& a, const Vec3& b) { EXPECT_NEAR(length(a - b), 0, 1e-5) << a << " and " << b; };
  const float r = std::sqrt(0.5f);
  const auto equidistant = [&](float x, float y) { return direction(CameraType::Equidistant, 180, 20, 20, x, y); };
  expect(equidistant(20, 10), Vec3(1, 0, 0));
  expect(equidistant(10, 0), Vec3(0, 1, 0));
  expect(equidistant(15, 10), Vec3(r, 0, -r));
  expect(direction(CameraType::Equidistant, 360, 20, 20, 15, 10), Vec3(1, 0, 0));
  expect(direction(CameraType::Equisolid, 360, 20, 20, 10 + 10 * r, 10), Vec3(1, 0, 0));
  const auto around = [&](float x, float y) { return direction(CameraType::Equirectangular, 0, 40, 20, x, y); };
  expect(around(20, 10), Vec3(0, 0, -1));
  expect(around(30, 10), Vec3(1, 0, 0));
  expect(around(40, 10), Vec3(0, 0, 1));
  expect(around(20, 5), Vec3(0, r, -r));
  expect(around(41, 10), around(1, 10));  // on over the border
  expect(around(20, -5), around(40, 5));  // and over the pole
  const Vec3 faces[] = {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)};
  for (int face = 0; face < 6; ++face) {
    expect(direction(CameraType::Cube, 0, 60, 10, float(10 * face + 5), 5), faces[face]);
    expect(direction(CameraType::Cube, 0, 10, 60, 5, float(10 * face + 5)), faces[face]);
  }
  // The top left corners of +x and of +y, by the table of OpenGL: (1, 1, 1) and (-1, 1, -1).
  const float c = std::sqrt(1 / 3.0f);
  expect(direction(CameraType::Cube, 0, 60, 10, 0, 0), Vec3(c, c, c));
  expect(direction(CameraType::Cube, 0, 60, 10, 20, 0), Vec3(-c, c, -c));
}

}  // namespace bdpt::sensor_camera_test
