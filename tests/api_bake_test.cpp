// Lightmaps and points by the C ABI: what is refused, what they tell, and that they measure.
#include "api_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace bdpt_api::api_bake_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Asked {
  bdpt_lightmap_desc desc = make<bdpt_lightmap_desc>();
  std::vector<bdpt_lightmap_instance> instances;
  std::vector<bdpt_output_desc> outputs;

  explicit Asked(const World& world) {
    desc.width = desc.height = 8;
    instances.push_back(make<bdpt_lightmap_instance>());
    instances[0].instance = world.contents.floor;
  }
  bdpt_result create(const bdpt_scene* scene, bdpt_sensor** sensor) {
    desc.instances = instances.data(), desc.instance_count = uint32_t(instances.size());
    desc.outputs = outputs.data(), desc.output_count = uint32_t(outputs.size());
    return bdpt_lightmap_create(const_cast<bdpt_scene*>(scene), &desc, sensor);
  }
  void add(bdpt_output_kind kind, bdpt_light_paths paths = BDPT_LIGHT_PATHS_ALL) {
    outputs.push_back(make<bdpt_output_desc>());
    outputs.back().kind = kind, outputs.back().paths = paths;
  }
};

Sensor lightmap(
    const World& world, const std::function<void(Asked&)>& change = [](Asked&) {}) {
  Asked asked(world);
  change(asked);
  bdpt_sensor* sensor = nullptr;
  EXPECT_OK(asked.create(world.scene.get(), &sensor));
  return Sensor(sensor);
}

bdpt_point point_at(float x, float y, float z, float ny = 0) { return {{x, y, z}, {0, ny, 0}, 0, 0}; }

TEST(ApiBake, LightmapFieldsAreChecked) {
  const World world;
  const auto result = [&](const std::function<void(Asked&)>& change) {
    Asked asked(world);
    change(asked);
    bdpt_sensor* sensor = nullptr;
    const bdpt_result r = asked.create(world.scene.get(), &sensor);
    EXPECT_EQ(r == BDPT_OK, sensor != nullptr);
    bdpt_sensor_release(sensor);
    return r;
  };
  const auto refused = [&](const std::function<void(Asked&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result(change)) << bdpt_last_error();
  };
  EXPECT_OK(result([](Asked&) {}));
  refused([](Asked& a) { a.desc.width = 0; });
  refused([](Asked& a) { a.desc.height = 65537; });
  refused([](Asked& a) { a.desc.atlas_count = 8193; });
  refused([](Asked& a) { a.desc.rect[2] = 4; });
  refused([](Asked& a) { a.desc.rect[2] = 9, a.desc.rect[3] = 8; });
  refused([](Asked& a) { a.desc.geometric_normals = 2; });
  refused([](Asked& a) { a.desc.buried_rays = 4097; });
  refused([](Asked& a) { a.desc.buried_rays = 1, a.desc.backface_tolerance = 1; });
  refused([](Asked& a) { a.desc.buried_rays = 1, a.desc.backface_tolerance = kNan; });
  refused([](Asked& a) { a.desc.backface_tolerance = 0.5f; });
  refused([](Asked& a) { a.desc.buried_rays = 1, a.desc.all_backs = 2; });
  refused([](Asked& a) { a.desc.all_backs = 1; });
  refused([](Asked& a) { a.desc.instance_stride = 12; });
  refused([](Asked& a) { a.instances.clear(); });
  refused([](Asked& a) { a.instances.push_back(a.instances[0]); });
  refused([](Asked& a) { a.instances[0].atlas = 1; });
  refused([](Asked& a) { a.instances[0].uv_set = 2; });
  refused([](Asked& a) { a.instances[0].uv_set = 1; });  // the square has no set 0
  refused([](Asked& a) { a.instances[0].flip = 2; });
  refused([](Asked& a) { a.instances[0].scale[1] = kNan; });
  refused([](Asked& a) { a.instances[0].offset[0] = kNan; });
  refused([](Asked& a) { a.instances[0].offset[0] = 2; });  // nothing within the atlas
  refused([&](Asked& a) { a.instances[0].instance = world.contents.thing; });
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "sphere")) << bdpt_last_error();
  refused([](Asked& a) { a.add(BDPT_OUTPUT_UNSHADOWED + 1); });
  refused([](Asked& a) { a.add(BDPT_OUTPUT_DISTANCE_OCTAHEDRAL); });  // without reach
  refused([](Asked& a) { a.add(BDPT_OUTPUT_RADIANCE_OCTAHEDRAL), a.outputs[0].size = 33; });
  refused([](Asked& a) { a.add(BDPT_OUTPUT_RADIANCE_OCTAHEDRAL), a.outputs[0].unfiltered = 1; });
  refused([](Asked& a) { a.add(BDPT_OUTPUT_IRRADIANCE), a.outputs[0].size = 8; });
  refused([](Asked& a) {
    for (int i = 0; i < 2; ++i) a.add(BDPT_OUTPUT_RADIANCE_OCTAHEDRAL), a.outputs[size_t(i)].size = 23;
  });
  EXPECT_OK(result([](Asked& a) { a.add(BDPT_OUTPUT_IRRADIANCE_OCTAHEDRAL), a.outputs[0].size = 32; }));
  refused([](Asked& a) { a.add(BDPT_OUTPUT_FLUENCE, 3); });
  refused([](Asked& a) { a.add(0), a.outputs[0].reach = -1; });
  refused([](Asked& a) { a.outputs.assign(200, make<bdpt_output_desc>()), a.outputs[0].struct_size = 3; });
  refused([](Asked& a) {
    for (int i = 0; i < 114; ++i) a.add(BDPT_OUTPUT_RADIANCE_SH2);
  });
  EXPECT_EQ(BDPT_ERROR_INVALID_ID, result([](Asked& a) { a.instances[0].instance.id = 0; }));
  EXPECT_EQ(BDPT_ERROR_INVALID_ID, result([&](Asked& a) { a.instances[0].instance.id ^= 0x7777; }));
}

TEST(ApiBake, PointFieldsAreChecked) {
  const Context context = make_context();
  const auto result = [&](const std::function<void(bdpt_points_desc&, bdpt_point&, bdpt_output_desc&)>& change) {
    bdpt_points_desc desc = make<bdpt_points_desc>();
    bdpt_point point = point_at(0, 1, 0, 1);
    bdpt_output_desc output = make<bdpt_output_desc>();
    desc.count = 1, desc.points = &point, desc.output_count = 1, desc.outputs = &output;
    change(desc, point, output);
    bdpt_sensor* sensor = nullptr;
    const bdpt_result r = bdpt_points_create(context.get(), &desc, &sensor);
    EXPECT_EQ(r == BDPT_OK, sensor != nullptr);
    bdpt_sensor_release(sensor);
    return r;
  };
  EXPECT_OK(result([](auto&, auto&, auto&) {}));
  const auto refused = [&](const std::function<void(bdpt_points_desc&, bdpt_point&, bdpt_output_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result(change)) << bdpt_last_error();
  };
  refused([](auto& d, auto&, auto&) { d.count = 0; });
  refused([](auto& d, auto&, auto&) { d.count = uint64_t(1) << 32; });
  refused([](auto& d, auto&, auto&) { d.points = nullptr; });
  refused([](auto& d, auto&, auto&) { d.point_stride = 8; });
  refused([](auto& d, auto&, auto&) { d.offset = -1; });
  refused([](auto&, auto& p, auto&) { p.position[1] = kNan; });
  refused([](auto&, auto& p, auto&) { p.normal[1] = kNan; });
  refused([](auto&, auto& p, auto&) { p.radius = -1; });
  refused([](auto&, auto& p, auto&) { p.normal[1] = 0; });  // irradiance needs one
  EXPECT_OK(result([](auto&, auto& p, auto& o) { o.kind = BDPT_OUTPUT_FLUENCE, p.normal[1] = 0, p.radius = 1; }));
  EXPECT_OK(result([](auto&, auto& p, auto&) { p.cone = 90; }));
  refused([](auto&, auto& p, auto&) { p.radius = 1e-10f; });
  refused([](auto&, auto& p, auto&) { p.radius = 1e10f; });
  refused([](auto&, auto& p, auto&) { p.radius = kNan; });
  EXPECT_OK(result([](auto&, auto& p, auto& o) { o.kind = BDPT_OUTPUT_FLUENCE, p.normal[1] = 0, p.radius = 2e-4f; }));
  refused([](auto&, auto& p, auto& o) { o.kind = BDPT_OUTPUT_FLUENCE, p.normal[1] = 0, p.radius = 0.5e-4f; });
  refused([](auto&, auto& p, auto&) { p.cone = -1; });
  refused([](auto&, auto& p, auto&) { p.cone = 91; });
  refused([](auto&, auto& p, auto&) { p.cone = kNan; });
  refused([](auto&, auto& p, auto& o) { o.kind = BDPT_OUTPUT_FLUENCE, p.normal[1] = 0, p.cone = 1; });
}

TEST(ApiBake, ALightmapTellsWhatItCovers) {
  const World world;
  const Sensor sensor = lightmap(world, [](Asked& a) {
    a.desc.atlas_count = 2;
    a.instances[0].atlas = 1, a.instances[0].scale[0] = a.instances[0].scale[1] = 0.5f;
    a.instances[0].offset[0] = 0.75f;  // its right half lies outside
  });
  bdpt_lightmap_info info = make<bdpt_lightmap_info>();
  ASSERT_OK(bdpt_lightmap_get_info(sensor.get(), &info));
  EXPECT_EQ(8u, info.width);
  EXPECT_EQ(16u, info.height);
  EXPECT_EQ(8u, info.texels);
  EXPECT_EQ(2u, info.triangles_outside);
  EXPECT_EQ(0u, info.triangles_unmapped);
  EXPECT_NEAR(18, info.area, 1e-4);
  EXPECT_NEAR(18, info.area_outside, 1e-4);
  std::vector<float> coverage(128), area(128);
  ASSERT_OK(bdpt_lightmap_read_texels(sensor.get(), coverage.data(), area.data(), 128));
  for (uint32_t y = 0; y < 16; ++y)
    for (uint32_t x = 0; x < 8; ++x) {
      const bool covered = x >= 6 && y >= 12;  // v from 0 to 0.5: the lower half of the second atlas
      EXPECT_NEAR(covered ? 1 : 0, coverage[y * 8 + x], 1e-6) << x << ", " << y;
      EXPECT_NEAR(covered ? 2.25 : 0, area[y * 8 + x], 1e-5) << x << ", " << y;
    }
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_read_texels(sensor.get(), coverage.data(), nullptr, 127));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_get_info(world.sensor.get(), &info));
  const bdpt_film_info film = info_of(make_film(sensor.get()).get());
  EXPECT_EQ(8u, film.measured);
  EXPECT_EQ(1u, film.planes);
}

// The floor under a house of one-sided walls, a lid of 1.5 x 1.5 on four of them, is left out, whatever the threads.
TEST(ApiBake, WhatIsBuriedIsToldAndLeftOut) {
  const auto create = [](uint32_t threads, uint32_t rays) {
    bdpt_context_desc context = make<bdpt_context_desc>();
    context.threads = threads;
    World world(&context);
    bdpt_builder* b = world.builder.get();
    bdpt_material_desc wall = grey_desc();
    wall.one_sided = 1;
    bdpt_material_id one_sided{};
    EXPECT_OK(bdpt_material_add(b, &wall, &one_sided));
    const float box[8][3] = {{-3.1f, -1, -3.1f}, {-1.5f, -1, -3.1f}, {-3.1f, 1, -3.1f}, {-1.5f, 1, -3.1f},
                             {-3.1f, -1, -1.5f}, {-1.5f, -1, -1.5f}, {-3.1f, 1, -1.5f}, {-1.5f, 1, -1.5f}};
    const uint32_t triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 4, 2}, {4, 6, 2},
                                       {1, 3, 5}, {3, 7, 5}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}};
    bdpt_mesh_desc mesh = make<bdpt_mesh_desc>();
    mesh.positions = view(box, 8, BDPT_FORMAT_FLOAT3), mesh.indices = view(triangles, 12, BDPT_FORMAT_UINT32X3);
    bdpt_shape_id house{};
    EXPECT_OK(bdpt_mesh_add(b, &mesh, &house));
    add_instance(b, house, one_sided);
    world.scene = build(b);
    return lightmap(world, [&](Asked& a) { a.desc.buried_rays = rays; });
  };
  std::vector<float> first;
  for (const uint32_t threads : {1u, 2u}) {
    const Sensor sensor = create(threads, 16);
    bdpt_lightmap_info info = make<bdpt_lightmap_info>();
    ASSERT_OK(bdpt_lightmap_get_info(sensor.get(), &info));
    EXPECT_EQ(60u, info.texels);  // of 64, each 0.75 wide
    EXPECT_EQ(4u, info.texels_buried);
    EXPECT_NEAR(36 - 2.25, info.area, 1e-4);
    EXPECT_NEAR(2.25, info.area_buried, 1e-4);
    std::vector<float> buried(64), coverage(64);
    ASSERT_OK(bdpt_lightmap_read_buried(sensor.get(), buried.data(), 64));
    ASSERT_OK(bdpt_lightmap_read_texels(sensor.get(), coverage.data(), nullptr, 64));
    for (uint32_t i = 0; i < 64; ++i) EXPECT_NEAR(1, coverage[i] + buried[i], 1e-6);
    EXPECT_EQ(4, std::count(buried.begin(), buried.end(), 1.0f));
    if (first.empty()) first = buried;
    EXPECT_EQ(first, buried);
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_read_buried(sensor.get(), buried.data(), 63));
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_read_buried(sensor.get(), nullptr, 64));
  }
  const Cancel cancel = make_cancel();
  bdpt_cancel_request(cancel.get());
  const World world;
  Asked asked(world);
  asked.desc.buried_rays = 1, asked.desc.cancel = cancel.get();
  bdpt_sensor* none = nullptr;
  EXPECT_EQ(BDPT_CANCELLED, asked.create(world.scene.get(), &none));
  EXPECT_EQ(nullptr, none);
  std::vector<float> buried(64, 1);
  ASSERT_OK(bdpt_lightmap_read_buried(create(1, 0).get(), buried.data(), 64));
  EXPECT_EQ(std::vector<float>(64), buried);
}

// A texel of the floor and a point above its middle agree, output by output.
TEST(ApiBake, ATexelMeasuresWhatAPointDoes) {
  const World world;
  std::vector<bdpt_output_desc> outputs;
  const Sensor map = lightmap(world, [&](Asked& a) {
    a.desc.width = a.desc.height = 31;
    a.add(BDPT_OUTPUT_IRRADIANCE), a.add(BDPT_OUTPUT_RADIANCE_SH1), a.add(BDPT_OUTPUT_IRRADIANCE_OVER_PI);
    a.add(BDPT_OUTPUT_IRRADIANCE, BDPT_LIGHT_PATHS_DIRECT), a.add(BDPT_OUTPUT_IRRADIANCE, BDPT_LIGHT_PATHS_INDIRECT);
    outputs = a.outputs;
  });
  const bdpt_point place = point_at(1.548387f, 0, 0, 2);  // the middle of texel 23 of 31, the floor being 6 wide
  bdpt_points_desc desc = make<bdpt_points_desc>();
  desc.count = 1, desc.points = &place;
  desc.outputs = outputs.data(), desc.output_count = uint32_t(outputs.size());
  bdpt_sensor* point = nullptr;
  ASSERT_OK(bdpt_points_create(world.context.get(), &desc, &point));
  const Sensor owner(point);
  const auto measure = [&](bdpt_sensor* sensor, uint64_t n) {
    Film film = make_film(sensor);
    const Render render = make_render(world.scene.get(), sensor, film.get());
    EXPECT_OK(advance(render.get(), n));
    return film;
  };
  const Film a = measure(map.get(), 512), b = measure(point, 8192);
  EXPECT_EQ(8u, info_of(a.get()).planes);
  std::vector<double> value;
  for (uint32_t plane = 0; plane < 8; ++plane) {
    const double texel = double(pixels_of(a.get(), BDPT_LAYER_COLOR, plane)[3 * (15 * 31 + 23)]);
    const double here = double(pixels_of(b.get(), BDPT_LAYER_COLOR, plane)[0]);
    EXPECT_NEAR(here, texel, 0.02 * double(pixels_of(b.get())[0])) << plane;
    value.push_back(here);
  }
  EXPECT_NEAR(value[5] * M_PI, value[0], 1e-4 * value[0]);
  EXPECT_NEAR(value[6] + value[7], value[0], 1e-4 * value[0]);
  EXPECT_GT(value[7], 0.001 * value[0]);
}

TEST(ApiBake, TheBackReceivesWhereItIsAsked) {
  const World world;
  const Sensor front = lightmap(world), back = lightmap(world, [](Asked&a) { a.instances[0].flip = 1; });
  const Film lit = make_film(front.get()), dark = make_film(back.get());
  ASSERT_OK(advance(make_render(world.scene.get(), front.get(), lit.get()).get(), 4));
  ASSERT_OK(advance(make_render(world.scene.get(), back.get(), dark.get()).get(), 4));
  double sum = 0;
  for (float v : pixels_of(lit.get())) sum += double(v);
  EXPECT_GT(sum, 1);
  for (float v : pixels_of(dark.get())) EXPECT_EQ(0, v);
}

TEST(ApiBake, WhatDoesNotFitIsRefused) {
  const World world, other;
  const Sensor sensor = lightmap(world);
  bdpt_film_desc tent = make<bdpt_film_desc>();
  tent.filter = BDPT_FILTER_TENT;
  bdpt_film* none = nullptr;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_create(sensor.get(), &tent, &none));
  const Film film = make_film(sensor.get());
  bdpt_render* render = nullptr;
  EXPECT_EQ(BDPT_ERROR_MISMATCH, bdpt_render_create(other.scene.get(), sensor.get(), film.get(), nullptr, &render));
  bdpt_render_desc desc = make<bdpt_render_desc>();
  desc.plan = "mmlt";
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT,
            bdpt_render_create(world.scene.get(), sensor.get(), film.get(), &desc, &render));
  desc.plan = nullptr, desc.adaptive = BDPT_ADAPTIVE_TWO_STAGES;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT,
            bdpt_render_create(world.scene.get(), sensor.get(), film.get(), &desc, &render));
  const Sensor camera = make_camera(world.context.get(), camera_desc(8, 8));
  const Film pixels = make_film(camera.get());
  EXPECT_EQ(BDPT_ERROR_MISMATCH, bdpt_render_create(world.scene.get(), sensor.get(), pixels.get(), nullptr, &render));
  EXPECT_EQ(BDPT_ERROR_MISMATCH, bdpt_render_create(world.scene.get(), camera.get(), film.get(), nullptr, &render));
  float texels[8 * 8 * 3];
  bdpt_read_desc read = make<bdpt_read_desc>();
  read.plane = 1;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_read(film.get(), &read, texels, sizeof texels));
  read.plane = 0, read.layer = BDPT_LAYER_EYE;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_read(film.get(), &read, texels, sizeof texels));
}

// The same bits by any number of threads, from halves that are merged, and from a file.
TEST(ApiBake, BitsDoNotDependOnThreadsRangesAndFiles) {
  const auto bake = [](uint32_t threads, uint64_t first, uint64_t count, const char* plan) {
    bdpt_context_desc context = make<bdpt_context_desc>();
    context.threads = threads;
    const World world(&context);
    const Sensor sensor = lightmap(world, [](Asked& a) { a.add(BDPT_OUTPUT_RADIANCE_SH1); });
    bdpt_render_desc desc = make<bdpt_render_desc>();
    desc.first_pass = first, desc.plan = plan, desc.seed = 7;
    Film film = make_film(sensor.get());
    EXPECT_OK(advance(make_render(world.scene.get(), sensor.get(), film.get(), &desc).get(), count));
    return film;
  };
  for (const char* plan : {"one-to-one", "two-way", "pooled", "matrix"}) {
    const Film whole = bake(1, 0, 16, plan), half = bake(2, 0, 8, plan), rest = bake(2, 8, 8, plan);
    const std::string path = testing::TempDir() + "bake.film";
    ASSERT_OK(bdpt_film_save(half.get(), path.c_str()));
    const Context context = make_context();
    bdpt_film* loaded = nullptr;
    ASSERT_OK(bdpt_film_load(context.get(), path.c_str(), &loaded));
    const Film film(loaded);
    ASSERT_OK(bdpt_film_merge(film.get(), rest.get()));
    for (uint32_t plane = 0; plane < 4; ++plane)
      EXPECT_EQ(pixels_of(whole.get(), BDPT_LAYER_COLOR, plane), pixels_of(film.get(), BDPT_LAYER_COLOR, plane))
          << plan << ", plane " << plane;
    std::remove(path.c_str());
  }
}

// Balls: the same bits whatever the threads, blocks and ranges, and what a point in the middle measures.
TEST(ApiBake, BallsHaveTheirBitsAndMeasureWhatPointsDo) {
  std::vector<bdpt_point> places;
  for (int i = 0; i < 40; ++i)
    places.push_back({{-1 + 0.05f * float(i), 1, 0.5f}, {0, 0, 0}, 0.02f + 0.01f * float(i), 0});
  const auto measure = [&](uint32_t threads, uint64_t first, uint64_t count, const char* plan, bool balls) {
    bdpt_context_desc context = make<bdpt_context_desc>();
    context.threads = threads;
    const World world(&context);
    std::vector<bdpt_point> own = places;
    if (!balls)
      for (bdpt_point& p : own) p.radius = 0;
    bdpt_points_desc desc = make<bdpt_points_desc>();
    desc.count = own.size(), desc.points = own.data();
    bdpt_sensor* sensor = nullptr;
    EXPECT_OK(bdpt_points_create(world.context.get(), &desc, &sensor));
    const Sensor owner(sensor);
    bdpt_render_desc render = make<bdpt_render_desc>();
    render.first_pass = first, render.plan = plan, render.seed = 3;
    Film film = make_film(sensor);
    EXPECT_OK(advance(make_render(world.scene.get(), sensor, film.get(), &render).get(), count));
    return film;
  };
  for (const char* plan : {"one-to-one", "two-way", "pooled", "matrix"}) {
    const Film whole = measure(1, 0, 32, plan, true), half = measure(2, 0, 16, plan, true),
               rest = measure(2, 16, 16, plan, true);
    ASSERT_OK(bdpt_film_merge(half.get(), rest.get()));
    EXPECT_EQ(pixels_of(whole.get()), pixels_of(half.get())) << plan;
    EXPECT_EQ(0u, info_of(whole.get()).rejected);
  }
  const std::vector<float> a = pixels_of(measure(2, 0, 2048, "one-to-one", true).get()),
                           b = pixels_of(measure(2, 0, 2048, "one-to-one", false).get());
  for (size_t i = 0; i < 10; ++i) EXPECT_NEAR(b[3 * i], a[3 * i], 0.05 * double(b[3 * i])) << i;  // small ones
}

// A photometer's cone: of a uniform sky E = pi L sin²; and what is left and right of its edge.
TEST(ApiBake, AConeSeesLightWithinIt) {
  const World world;
  std::vector<float> seen;
  for (const float cone : {0.0f, 90.0f, 30.0f, 0.0f}) {
    bdpt_point place = point_at(0.4f, 1, 0.2f, 1);
    place.cone = cone;
    bdpt_points_desc desc = make<bdpt_points_desc>();
    desc.count = 1, desc.points = &place;
    bdpt_sensor* sensor = nullptr;
    ASSERT_OK(bdpt_points_create(world.context.get(), &desc, &sensor));
    const Sensor owner(sensor);
    const Film film = make_film(sensor);
    ASSERT_OK(advance(make_render(world.scene.get(), sensor, film.get()).get(), 256));
    seen.push_back(pixels_of(film.get())[0]);
  }
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_EQ(seen[0], seen[3]);
  EXPECT_NE(seen[0], seen[2]);
}

// The floor by its vertices: what is refused; the light on it; the same bits from parts; and what the solver is given.
TEST(ApiBake, VerticesMeasureAFloor) {
  const auto create = [](const World& world, bdpt_sensor** sensor,
                         const std::function<void(bdpt_vertices_desc&)>& change,
                         std::vector<bdpt_vertex_instance> instances) {
    bdpt_vertices_desc desc = make<bdpt_vertices_desc>();
    desc.instances = instances.data(), desc.instance_count = uint32_t(instances.size());
    change(desc);
    return bdpt_vertices_create(world.scene.get(), &desc, sensor);
  };
  const World world;
  bdpt_vertex_instance floor = make<bdpt_vertex_instance>();
  floor.instance = world.contents.floor;
  const auto refused = [&](const std::function<void(bdpt_vertices_desc&)>& change,
                           const std::vector<bdpt_vertex_instance>& instances, bdpt_result expected) {
    bdpt_sensor* sensor = nullptr;
    EXPECT_EQ(expected, create(world, &sensor, change, instances)) << bdpt_last_error();
    EXPECT_EQ(nullptr, sensor);
  };
  const auto as_is = [](bdpt_vertices_desc&) {};
  bdpt_vertex_instance thing = floor, flipped = floor, unknown = floor;
  thing.instance = world.contents.thing, flipped.flip = 2, unknown.instance.id ^= 0x7777;
  refused(as_is, {}, BDPT_ERROR_INVALID_ARGUMENT);
  refused(as_is, {floor, floor}, BDPT_ERROR_INVALID_ARGUMENT);
  refused(as_is, {thing}, BDPT_ERROR_INVALID_ARGUMENT);
  refused(as_is, {flipped}, BDPT_ERROR_INVALID_ARGUMENT);
  refused(as_is, {unknown}, BDPT_ERROR_INVALID_ID);
  refused([](auto& d) { d.geometric_normals = 2; }, {floor}, BDPT_ERROR_INVALID_ARGUMENT);
  refused([](auto& d) { d.instance_stride = 12; }, {floor}, BDPT_ERROR_INVALID_ARGUMENT);
  refused([](auto& d) { d.instances = nullptr; }, {floor}, BDPT_ERROR_INVALID_ARGUMENT);
  refused([](auto& d) { d.output_count = 1; }, {floor}, BDPT_ERROR_INVALID_ARGUMENT);

  bdpt_sensor* made = nullptr;
  ASSERT_OK(create(world, &made, as_is, {floor}));
  const Sensor sensor(made);
  float areas[4], values[12] = {};
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_vertices_read_areas(made, areas, 3));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_vertices_read_areas(world.sensor.get(), areas, 4));
  ASSERT_OK(bdpt_vertices_read_areas(made, areas, 4));
  EXPECT_NEAR(36, areas[0] + areas[1] + areas[2] + areas[3], 1e-4);  // a square of 6 x 6
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_vertices_solve(made, 0, values, 12));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_vertices_solve(made, 3, values, 11));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_vertices_solve(made, 3, nullptr, 12));
  values[5] = kNan;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_vertices_solve(made, 3, values, 12));

  // As much light as the lightmap finds.
  const Sensor map = lightmap(world);
  const auto measure = [&](bdpt_sensor* s, uint64_t n) {
    const Film film = make_film(s);
    EXPECT_OK(advance(make_render(world.scene.get(), s, film.get()).get(), n));
    return pixels_of(film.get());
  };
  const std::vector<float> by_vertex = measure(made, 8192), by_texel = measure(map.get(), 512);
  double vertex_sum = 0, texel_sum = 0;
  for (size_t j = 0; j < 4; ++j) vertex_sum += double(areas[j]) * double(by_vertex[3 * j]);
  for (size_t i = 0; i < by_texel.size(); i += 3) texel_sum += 36.0 / 64 * double(by_texel[i]);
  EXPECT_NEAR(vertex_sum, texel_sum, 0.01 * texel_sum);

  const auto bake = [&](uint32_t threads, uint64_t first, uint64_t count, const char* plan) {
    bdpt_context_desc context = make<bdpt_context_desc>();
    context.threads = threads;
    const World own(&context);
    bdpt_vertex_instance placed = floor;
    placed.instance = own.contents.floor;
    bdpt_sensor* s = nullptr;
    EXPECT_OK(create(own, &s, as_is, {placed}));
    const Sensor owner(s);
    bdpt_render_desc desc = make<bdpt_render_desc>();
    desc.first_pass = first, desc.plan = plan, desc.seed = 7;
    Film film = make_film(s);
    EXPECT_OK(advance(make_render(own.scene.get(), s, film.get(), &desc).get(), count));
    return film;
  };
  for (const char* plan : {"one-to-one", "two-way", "pooled", "matrix"}) {
    const Film whole = bake(1, 0, 16, plan), half = bake(2, 0, 8, plan), rest = bake(2, 8, 8, plan);
    ASSERT_OK(bdpt_film_merge(half.get(), rest.get()));
    EXPECT_EQ(pixels_of(whole.get()), pixels_of(half.get())) << plan;
  }
}

// Texels of a part have the bits of the whole where no light subpath takes part.
TEST(ApiBake, APartHasTheBitsOfTheWhole) {
  const World world;
  const Sensor all = lightmap(world), part = lightmap(world, [](Asked&a) {
                                        a.desc.rect[0] = 2, a.desc.rect[1] = 3, a.desc.rect[2] = 6, a.desc.rect[3] = 8;
                                      });
  bdpt_render_desc path = make<bdpt_render_desc>();
  path.techniques[0] = path.techniques[1] = ~1u;
  const auto bake = [&](bdpt_sensor* sensor) {
    const Film film = make_film(sensor);
    EXPECT_OK(advance(make_render(world.scene.get(), sensor, film.get(), &path).get(), 4));
    return pixels_of(film.get());
  };
  const std::vector<float> whole = bake(all.get()), some = bake(part.get());
  for (size_t y = 0; y < 8; ++y)
    for (size_t x = 0; x < 8; ++x) {
      const bool inside = x >= 2 && x < 6 && y >= 3;
      EXPECT_EQ(inside ? whole[3 * (8 * y + x)] : 0, some[3 * (8 * y + x)]) << x << ", " << y;
    }
}

}  // namespace bdpt_api::api_bake_test
