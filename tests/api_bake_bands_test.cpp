// What a bake will take, told beforehand, and bakes in bands that fit.
#include "api_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace bdpt_api::api_bake_bands_test {

struct Map {
  bdpt_lightmap_instance floor = make<bdpt_lightmap_instance>();
  std::vector<bdpt_output_desc> outputs{2, make<bdpt_output_desc>()};
  bdpt_lightmap_desc desc = make<bdpt_lightmap_desc>();

  explicit Map(const World& world, uint32_t width = 40, uint32_t height = 30) {
    floor.instance = world.contents.floor;
    outputs[1].kind = BDPT_OUTPUT_RADIANCE_SH1;
    desc.width = width, desc.height = height;
    desc.instances = &floor, desc.instance_count = 1;
    desc.outputs = outputs.data(), desc.output_count = 2;
  }
  Map(const Map&) = delete;
  void band(uint32_t first, uint32_t last) {
    desc.film_of_rect = 1;
    desc.rect[1] = first, desc.rect[2] = desc.width, desc.rect[3] = last;
  }
  Sensor create(const World& world) const {
    bdpt_sensor* sensor = nullptr;
    EXPECT_OK(bdpt_lightmap_create(world.scene.get(), &desc, &sensor));
    return Sensor(sensor);
  }
  bdpt_memory_estimate estimate(const World& world, uint64_t budget = 0) const {
    bdpt_memory_estimate e = make<bdpt_memory_estimate>();
    EXPECT_OK(bdpt_lightmap_estimate(world.scene.get(), &desc, nullptr, budget, &e));
    return e;
  }
};

// Eye subpaths and direct lighting alone.
bdpt_render_desc path_tracing() {
  bdpt_render_desc desc = make<bdpt_render_desc>();
  desc.techniques[0] = desc.techniques[1] = ~1u;
  for (size_t s = 2; s < 32; ++s) desc.techniques[s] = 0;
  return desc;
}

TEST(ApiBakeBands, TheEstimateIsWhatTheContextCounts) {
  const World world;
  for (const uint32_t rays : {0u, 4u})
    for (const bool band : {false, true}) {
      Map map(world);
      map.desc.buried_rays = rays;
      if (band) map.band(7, 19);
      const bdpt_memory_estimate e = map.estimate(world);
      EXPECT_EQ(e.total, e.sensor + e.film + e.render);
      EXPECT_EQ(band ? 12u : 30u, e.band_rows);  // without a limit all fits
      const uint64_t before = memory_in_use(world.context.get());
      const Sensor sensor = map.create(world);
      EXPECT_EQ(e.sensor, memory_in_use(world.context.get()) - before);
      const Film film = make_film(sensor.get());
      EXPECT_EQ(e.film + e.sensor, memory_in_use(world.context.get()) - before);
      const Render render = make_render(world.scene.get(), sensor.get(), film.get());
      const uint64_t all = memory_in_use(world.context.get()) - before;
      ASSERT_OK(advance(render.get(), 2));
      EXPECT_EQ(e.total, all);
      EXPECT_EQ(all, memory_in_use(world.context.get()) - before);
      bdpt_memory_estimate of_film = make<bdpt_memory_estimate>();
      ASSERT_OK(bdpt_film_estimate(sensor.get(), nullptr, &of_film));
      EXPECT_EQ(e.film, of_film.film);
      EXPECT_EQ(e.render, of_film.render);
      EXPECT_EQ(0u, of_film.sensor);
    }
  // A camera's, with groups and a pyramid.
  bdpt_film_desc desc = make<bdpt_film_desc>();
  desc.groups = 3, desc.pyramid_edges = 2;
  bdpt_memory_estimate e = make<bdpt_memory_estimate>();
  ASSERT_OK(bdpt_film_estimate(world.sensor.get(), &desc, &e));
  const uint64_t before = memory_in_use(world.context.get());
  const Film film = make_film(world.sensor.get(), &desc);
  EXPECT_EQ(e.film, memory_in_use(world.context.get()) - before);
}

TEST(ApiBakeBands, NothingIsTakenByEstimates) {
  const World world;
  const uint64_t before = info_of(world.context.get()).memory_peak;
  EXPECT_GT(Map(world, 2048, 2048).estimate(world, 1).total, uint64_t(2048) * 2048 * 5 * 48);
  EXPECT_EQ(before, info_of(world.context.get()).memory_peak);
}

TEST(ApiBakeBands, FieldsAreChecked) {
  const World world;
  Map map(world);
  bdpt_memory_estimate e = make<bdpt_memory_estimate>();
  const auto result = [&](const std::function<void(bdpt_lightmap_desc&, bdpt_film_desc&)>& change) {
    bdpt_lightmap_desc d = map.desc;
    bdpt_film_desc f = make<bdpt_film_desc>();
    change(d, f);
    return bdpt_lightmap_estimate(world.scene.get(), &d, &f, 0, &e);
  };
  EXPECT_OK(result([](auto&, auto&) {}));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result([](auto& d, auto&) { d.width = 0; }));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result([](auto& d, auto&) { d.film_of_rect = 2; }));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result([](auto& d, auto&) { d.reserved = 1; }));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result([](auto&, auto& f) { f.groups = 17; }));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result([](auto&, auto& f) { f.filter = BDPT_FILTER_TENT; }));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_estimate(nullptr, &map.desc, nullptr, 0, &e));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_estimate(world.scene.get(), nullptr, nullptr, 0, &e));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_estimate(world.scene.get(), &map.desc, nullptr, 0, nullptr));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_estimate(nullptr, nullptr, &e));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_estimate(world.sensor.get(), nullptr, nullptr));
}

// Under a limit that the whole exceeds: band by band, the same bits.
TEST(ApiBakeBands, BandsHaveTheBitsOfTheWhole) {
  const bdpt_render_desc path = path_tracing();
  const auto bake = [&](const World& world, const Map& map) {
    const Sensor sensor = map.create(world);
    const Film film = make_film(sensor.get());
    EXPECT_OK(advance(make_render(world.scene.get(), sensor.get(), film.get(), &path).get(), 3));
    std::vector<std::vector<float>> planes;
    for (uint32_t plane = 0; plane < 5; ++plane) planes.push_back(pixels_of(film.get(), BDPT_LAYER_COLOR, plane));
    for (uint32_t plane = 0; plane < 5; ++plane) planes.push_back(pixels_of(film.get(), BDPT_LAYER_VARIANCE, plane));
    return planes;
  };
  const World free;
  constexpr uint32_t kWidth = 240, kHeight = 150;
  const Map whole_map(free, kWidth, kHeight);
  const auto whole = bake(free, whole_map);
  const bdpt_memory_estimate e = whole_map.estimate(free);

  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.threads = 2;
  desc.memory_limit = info_of(free.context.get()).memory_peak - e.total + e.render + (e.total - e.render) / 4;
  const World world(&desc);
  Map map(world, kWidth, kHeight);
  bdpt_sensor* sensor = nullptr;
  ASSERT_OK(bdpt_lightmap_create(world.scene.get(), &map.desc, &sensor));
  const Sensor owner(sensor);
  bdpt_film* film = nullptr;
  EXPECT_EQ(BDPT_ERROR_MEMORY_LIMIT, bdpt_film_create(sensor, nullptr, &film));
  const_cast<Sensor&>(owner).reset();

  map.desc.film_of_rect = 1;
  const uint32_t rows = map.estimate(world).band_rows;
  EXPECT_GT(rows, 20u);
  EXPECT_LT(rows, 50u);
  for (uint32_t first = 0; first < kHeight; first += rows) {
    const uint32_t last = std::min(first + rows, kHeight);
    map.band(first, last);
    const auto band = bake(world, map);
    for (size_t plane = 0; plane < whole.size(); ++plane) {
      const auto begin = whole[plane].begin() + int64_t(3 * kWidth * first);
      EXPECT_EQ(std::vector<float>(begin, whole[plane].begin() + int64_t(3 * kWidth * last)), band[plane])
          << "rows from " << first << ", plane " << plane;
    }
  }
  // No band of so many rows takes more, and one of them takes it all.
  uint64_t most = 0;
  for (uint32_t first = 0; first + rows <= kHeight; ++first) {
    map.band(first, first + rows);
    most = std::max(most, map.estimate(world).total);
  }
  const Map all(world, kWidth, kHeight);
  EXPECT_EQ(rows, all.estimate(world, most).band_rows);
  EXPECT_EQ(rows - 1, all.estimate(world, most - 1).band_rows);
  EXPECT_EQ(0u, all.estimate(world, 1).band_rows);
}

// A band that is a part of the width, and light subpaths: the same measurement.
TEST(ApiBakeBands, APartMeasuresTheSameWithLightSubpaths) {
  const World world;
  Map whole(world, 12, 10), part(world, 12, 10);
  part.desc.film_of_rect = 1;
  part.desc.rect[0] = 5, part.desc.rect[1] = 3, part.desc.rect[2] = 11, part.desc.rect[3] = 8;
  const auto bake = [&](const Map& map, uint64_t n) {
    const Sensor sensor = map.create(world);
    const Film film = make_film(sensor.get());
    EXPECT_OK(advance(make_render(world.scene.get(), sensor.get(), film.get()).get(), n));
    return pixels_of(film.get());
  };
  const std::vector<float> a = bake(whole, 4000), b = bake(part, 4000);
  ASSERT_EQ(b.size(), 3u * 6 * 5);
  const Sensor sensor = part.create(world);
  bdpt_lightmap_info info = make<bdpt_lightmap_info>();
  ASSERT_OK(bdpt_lightmap_get_info(sensor.get(), &info));
  EXPECT_EQ(6u, info.width);
  EXPECT_EQ(5u, info.height);
  EXPECT_EQ(30u, info.texels);
  EXPECT_NEAR(30 * 36.0 / 120, info.area, 1e-4);
  std::vector<float> coverage(30);
  ASSERT_OK(bdpt_lightmap_read_texels(sensor.get(), coverage.data(), nullptr, 30));
  EXPECT_EQ(std::vector<float>(30, 1), coverage);
  for (size_t y = 0; y < 5; ++y)
    for (size_t x = 0; x < 6; ++x) {
      const double whole_value = double(a[3 * (12 * (y + 3) + x + 5)]), value = double(b[3 * (6 * y + x)]);
      EXPECT_NEAR(1, value / whole_value, 0.08) << x << ", " << y;
    }
}

// Which lights are in a plane.
TEST(ApiBakeBands, PlanesAndLightsAreListed) {
  const World world;
  bdpt_scene_info scene = make<bdpt_scene_info>();
  ASSERT_OK(bdpt_scene_get_info(world.scene.get(), &scene));
  ASSERT_EQ(1u, scene.lights);
  bdpt_scene_light light = make<bdpt_scene_light>();
  ASSERT_OK(bdpt_scene_get_light(world.scene.get(), 0, &light));
  EXPECT_EQ(world.contents.light.id, light.instance.id);
  EXPECT_EQ(0u, light.light.id);
  EXPECT_STREQ("", light.label);
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_scene_get_light(world.scene.get(), 1, &light));

  World rich;
  bdpt_builder* b = rich.builder.get();
  bdpt_light_desc point = make<bdpt_light_desc>();
  point.label = "torch", point.group = 5;
  bdpt_light_id torch{};
  ASSERT_OK(bdpt_light_add(b, &point, &torch));
  bdpt_material_desc glow = grey_desc();
  glow.emission[1] = 2, glow.emission_group = 3;
  bdpt_material_id material{};
  ASSERT_OK(bdpt_material_add(b, &glow, &material));
  bdpt_instance_desc sign = instance_desc(rich.contents.square, material, 0.1f, 1);
  sign.label = "sign";
  bdpt_instance_id instance{};
  ASSERT_OK(bdpt_instance_add(b, &sign, &instance));
  const Scene built = build(b);
  const auto told = [&](uint32_t i) {
    bdpt_scene_light l = make<bdpt_scene_light>();
    EXPECT_OK(bdpt_scene_get_light(built.get(), i, &l));
    return l;
  };
  EXPECT_STREQ("torch", told(0).label);
  EXPECT_EQ(5u, told(0).group);
  EXPECT_EQ(torch.id, told(0).light.id);
  EXPECT_EQ(rich.contents.light.id, told(1).instance.id);
  EXPECT_STREQ("sign", told(2).label);
  EXPECT_EQ(3u, told(2).group);
  EXPECT_EQ(instance.id, told(2).instance.id);
  bdpt_scene_light none = make<bdpt_scene_light>();
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_scene_get_light(built.get(), 3, &none));

  Map map(world);
  map.outputs[0].groups = 1 << 5 | 1, map.outputs[0].paths = BDPT_LIGHT_PATHS_INDIRECT;
  map.outputs.resize(4, make<bdpt_output_desc>());
  map.outputs[2].kind = BDPT_OUTPUT_OPENNESS, map.outputs[2].reach = 2;
  map.outputs[3].kind = BDPT_OUTPUT_UNSHADOWED, map.outputs[3].groups = 8;
  map.desc.outputs = map.outputs.data(), map.desc.output_count = 4;
  const Sensor sensor = map.create(world);
  const auto plane = [&](uint32_t i) {
    bdpt_plane_info p = make<bdpt_plane_info>();
    EXPECT_OK(bdpt_sensor_get_plane(sensor.get(), i, &p));
    return p;
  };
  EXPECT_EQ(BDPT_OUTPUT_IRRADIANCE, plane(0).kind);
  EXPECT_EQ(BDPT_LIGHT_PATHS_INDIRECT, plane(0).paths);
  EXPECT_EQ(33u, plane(0).groups);
  EXPECT_EQ(BDPT_OUTPUT_RADIANCE_SH1, plane(3).kind);
  EXPECT_EQ(1u, plane(3).output);
  EXPECT_EQ(2u, plane(3).coefficient);
  EXPECT_EQ(~uint64_t(0), plane(3).groups);
  EXPECT_EQ(BDPT_OUTPUT_OPENNESS, plane(5).kind);
  EXPECT_EQ(2, plane(5).reach);
  EXPECT_EQ(0u, plane(5).groups);
  EXPECT_EQ(BDPT_OUTPUT_UNSHADOWED, plane(6).kind);
  EXPECT_EQ(BDPT_LIGHT_PATHS_DIRECT, plane(6).paths);
  EXPECT_EQ(8u, plane(6).groups);
  bdpt_plane_info p = make<bdpt_plane_info>();
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_sensor_get_plane(sensor.get(), 7, &p));
  ASSERT_OK(bdpt_sensor_get_plane(world.sensor.get(), 0, &p));
  EXPECT_EQ(BDPT_OUTPUT_NONE, p.kind);
}

}  // namespace bdpt_api::api_bake_bands_test
