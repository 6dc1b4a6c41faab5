// Measurements by the host's functions: they agree with those of the library, and what goes wrong in them is told.
#include "api_scene.h"

#include <atomic>
#include <cmath>
#include <limits>

namespace bdpt_api::api_custom_test {

constexpr float kPi = 3.14159265f;
constexpr float kSide = 6, kTexels = 4;  // the floor, and how many texels it has to a side

// The floor of the world by texels, as a lightmap has it.
struct Floor {
  bdpt_instance_id floor;
  enum class Fault {
    None,
    NanStart,
    NegativeDensity,
    NanResponse,
    Error,
    NegativeAnswer,
    NanLanding
  } fault = Fault::None;
  uint64_t faulty = 5;  // measurement
  std::atomic<int> dropped{0};
};

uint64_t texel_at(float x, float z) {
  const auto place = [](float v) {
    return uint64_t(std::min(std::max((v / kSide + 0.5f) * kTexels, 0.0f), kTexels - 1));
  };
  return place(z) * uint64_t(kTexels) + place(x);
}

int32_t start(void* user, uint32_t n, const uint64_t* measurements, const float (*u)[4],
              bdpt_measurement_start* starts) {
  const Floor& floor = *static_cast<const Floor*>(user);
  for (uint32_t i = 0; i < n; ++i) {
    const float size = kSide / kTexels, column = float(measurements[i] % 4), row = float(measurements[i] / 4);
    const float r = std::sqrt(u[i][2]), phi = 2 * kPi * u[i][3];
    const float position[3] = {(column + u[i][0]) * size - kSide / 2, 0, (row + u[i][1]) * size - kSide / 2};
    const float direction[3] = {r * std::cos(phi), std::sqrt(1 - r * r), r * std::sin(phi)};
    bdpt_measurement_start& s = starts[i];
    std::memcpy(s.position, position, sizeof position);
    std::memcpy(s.direction, direction, sizeof direction);
    s.normal[1] = 1;
    s.weight = 1;
    s.density_position = 1 / (size * size);
    s.density_direction = 1 / kPi;
    s.offset = 1e-5f;
    if (measurements[i] != floor.faulty) continue;
    if (floor.fault == Floor::Fault::NanStart) s.position[0] = std::numeric_limits<float>::quiet_NaN();
    if (floor.fault == Floor::Fault::NegativeDensity) s.density_direction = -1;
    if (floor.fault == Floor::Fault::Error) return 42;
  }
  return 0;
}

int32_t density(void* user, uint32_t n, const bdpt_measurement_place* places, float* densities) {
  const Floor& floor = *static_cast<const Floor*>(user);
  for (uint32_t i = 0; i < n; ++i) {
    EXPECT_GT(places[i].direction[1], 0);
    densities[i] = 1 / kPi;
    if (floor.fault == Floor::Fault::NegativeAnswer && places[i].measurement == floor.faulty) densities[i] = -1;
  }
  return 0;
}

// Irradiance, and radiance from +x over that from -x.
int32_t respond(void* user, uint32_t n, const bdpt_measurement_place* places, float* responses) {
  const Floor& floor = *static_cast<const Floor*>(user);
  for (uint32_t i = 0; i < n; ++i) {
    responses[2 * i] = 1;
    responses[2 * i + 1] = places[i].direction[0] > 0 ? 1 : -1;
    if (floor.fault == Floor::Fault::NanResponse && places[i].measurement == floor.faulty)
      responses[2 * i] = std::numeric_limits<float>::quiet_NaN();
  }
  return 0;
}

int32_t land(void* user, uint32_t n, const bdpt_measurement_landing* landings, bdpt_measurement_landed* landed) {
  const Floor& floor = *static_cast<const Floor*>(user);
  for (uint32_t i = 0; i < n; ++i) {
    const bdpt_measurement_landing& l = landings[i];
    landed[i].measurement = BDPT_NO_MEASUREMENT;
    if (l.instance.id != floor.floor.id) continue;
    landed[i].measurement = texel_at(l.position[0], l.position[2]);
    landed[i].normal[1] = 1;
    landed[i].weight = landed[i].density_position = kTexels * kTexels / (kSide * kSide);
    if (floor.fault == Floor::Fault::NanLanding && landed[i].measurement == floor.faulty)
      landed[i].density_position = std::numeric_limits<float>::quiet_NaN();
  }
  return 0;
}

class ApiCustom : public testing::Test {
 protected:
  World world_;
  Floor floor_{world_.contents.floor};

  bdpt_custom_desc desc() {
    bdpt_custom_desc d = make<bdpt_custom_desc>();
    d.measurements = 16, d.planes = 2;
    d.start = start, d.density = density, d.respond = respond, d.land = land;
    d.user = &floor_;
    d.drop = [](void* user) { ++static_cast<Floor*>(user)->dropped; };
    return d;
  }
  Sensor create(const bdpt_custom_desc& d) {
    bdpt_sensor* sensor = nullptr;
    EXPECT_OK(bdpt_custom_create(world_.context.get(), &d, &sensor));
    return Sensor(sensor);
  }
  Film measure(bdpt_sensor* sensor, uint64_t n, const char* plan = nullptr) {
    Film film = make_film(sensor);
    bdpt_render_desc options = make<bdpt_render_desc>();
    options.plan = plan;
    EXPECT_OK(advance(make_render(world_.scene.get(), sensor, film.get(), &options).get(), n));
    return film;
  }
};

double sum_of(const Film& film, uint32_t plane) {
  double sum = 0;
  for (float v : pixels_of(film.get(), BDPT_LAYER_COLOR, plane)) sum += double(v);
  return sum;
}

TEST_F(ApiCustom, AgreesWithALightmapWhateverIsLeftOut) {
  bdpt_lightmap_instance place = make<bdpt_lightmap_instance>();
  place.instance = world_.contents.floor;
  bdpt_lightmap_desc map = make<bdpt_lightmap_desc>();
  map.width = map.height = 4, map.instances = &place, map.instance_count = 1;
  bdpt_sensor* sensor = nullptr;
  ASSERT_OK(bdpt_lightmap_create(world_.scene.get(), &map, &sensor));
  const Sensor owner(sensor);
  const double expected = sum_of(measure(sensor, 4096), 0);
  for (const char* plan : {"one-to-one", "two-way", "pooled", "matrix"})
    for (int left_out = 0; left_out < 3; ++left_out) {
      bdpt_custom_desc d = desc();
      if (left_out >= 1) d.land = nullptr;
      if (left_out == 2) d.density = nullptr;
      const Film film = measure(create(d).get(), 4096, plan);
      // Without the density the lamp is found by chance alone.
      const double error = left_out == 2 ? 0.06 : 0.01;
      EXPECT_NEAR(1, sum_of(film, 0) / expected, error) << plan << ", " << left_out;
      EXPECT_NEAR(0, sum_of(film, 1) / expected, error) << plan << ", " << left_out;  // the world is symmetrical
      EXPECT_EQ(0u, info_of(film.get()).rejected);
    }
  EXPECT_EQ(12, floor_.dropped);
}

TEST_F(ApiCustom, OnePlaneWithoutAFunctionIsTheWeight) {
  bdpt_custom_desc d = desc();
  d.respond = nullptr, d.planes = 0;
  const Film one = measure(create(d).get(), 1024), two = measure(create(desc()).get(), 1024);
  EXPECT_NEAR(1, sum_of(one, 0) / sum_of(two, 0), 0.02);
}

TEST_F(ApiCustom, WhatIsNotFiniteIsCountedAndStaysWhereItIs) {
  const Film sound = measure(create(desc()).get(), 64);
  const std::vector<float> good = pixels_of(sound.get());
  for (const Floor::Fault fault : {Floor::Fault::NanStart, Floor::Fault::NegativeDensity, Floor::Fault::NanResponse}) {
    floor_.fault = fault;
    const Sensor sensor = create(desc());
    const Film film = make_film(sensor.get());
    const Render render = make_render(world_.scene.get(), sensor.get(), film.get());
    ASSERT_OK(advance(render.get(), 64));
    bdpt_render_stats stats = make<bdpt_render_stats>();
    ASSERT_OK(bdpt_render_get_stats(render.get(), &stats));
    const uint64_t rejected = info_of(film.get()).rejected;
    EXPECT_GE(rejected, 64u) << int(fault);
    EXPECT_GE(rejected, stats.rejected) << int(fault);
    const std::vector<float> bad = pixels_of(film.get()), where = pixels_of(film.get(), BDPT_LAYER_REJECTED, 1);
    for (size_t i = 0; i < where.size(); ++i)
      EXPECT_EQ(i / 3 == floor_.faulty ? float(rejected) : 0, where[i]) << int(fault) << ", " << i / 3;
    for (size_t i = 0; i < bad.size(); ++i) {
      EXPECT_TRUE(std::isfinite(bad[i]));
      if (i / 3 == floor_.faulty) continue;
      EXPECT_EQ(good[i], bad[i]) << int(fault) << ", " << i / 3;
    }
  }
}

// Also where the densities are only asked for: in the weights of t = 1 and t = 0.
TEST_F(ApiCustom, DensitiesThatAreNoneAreCountedAndStayWhereTheyAre) {
  const std::vector<float> good = pixels_of(measure(create(desc()).get(), 64).get());
  for (const Floor::Fault fault : {Floor::Fault::NegativeAnswer, Floor::Fault::NanLanding}) {
    floor_.fault = fault;
    const Sensor sensor = create(desc());
    const Film film = make_film(sensor.get());
    const Render render = make_render(world_.scene.get(), sensor.get(), film.get());
    ASSERT_OK(advance(render.get(), 64));
    bdpt_render_stats stats = make<bdpt_render_stats>();
    ASSERT_OK(bdpt_render_get_stats(render.get(), &stats));
    EXPECT_GT(stats.rejected, 0u) << int(fault);
    const std::vector<float> bad = pixels_of(film.get()), where = pixels_of(film.get(), BDPT_LAYER_REJECTED);
    EXPECT_EQ(float(info_of(film.get()).rejected), where[3 * floor_.faulty]) << int(fault);
    for (size_t i = 0; i < bad.size(); ++i) {
      EXPECT_TRUE(std::isfinite(bad[i]));
      if (i / 3 == floor_.faulty) continue;
      EXPECT_EQ(good[i], bad[i]) << int(fault) << ", " << i / 3;
    }
  }
}

TEST_F(ApiCustom, AnErrorStopsTheCallAndIsTold) {
  floor_.fault = Floor::Fault::Error;
  const Sensor sensor = create(desc());
  const Film film = make_film(sensor.get());
  const Render render = make_render(world_.scene.get(), sensor.get(), film.get());
  EXPECT_EQ(BDPT_ERROR_CALLBACK_FAILED, advance(render.get(), 4));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "42")) << bdpt_last_error();
  EXPECT_EQ(0u, info_of(film.get()).passes);
  for (float v : pixels_of(film.get())) EXPECT_EQ(0, v);
  floor_.fault = Floor::Fault::None;  // the next call begins the pass anew
  EXPECT_OK(advance(render.get(), 4));
  EXPECT_EQ(pixels_of(measure(create(desc()).get(), 4).get()), pixels_of(film.get()));
}

TEST_F(ApiCustom, FieldsAreChecked) {
  const auto refused = [&](auto&& change) {
    bdpt_custom_desc d = desc();
    change(d);
    bdpt_sensor* sensor = nullptr;
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_custom_create(world_.context.get(), &d, &sensor));
    EXPECT_EQ(nullptr, sensor);
  };
  refused([](auto& d) { d.measurements = 0; });
  refused([](auto& d) { d.measurements = uint64_t(1) << 32; });
  refused([](auto& d) { d.planes = 1025; });
  refused([](auto& d) { d.start = nullptr; });
  refused([](auto& d) { d.density = nullptr; });
  EXPECT_EQ(5, floor_.dropped);
}

}  // namespace bdpt_api::api_custom_test
