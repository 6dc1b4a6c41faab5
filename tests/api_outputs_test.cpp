// Outputs of cameras by the C ABI: what is refused, what they tell, coverage by ids, and the denoiser, there or not.
#include "api_scene.h"

#include <cmath>
#include <cstdlib>
#include <functional>

namespace bdpt_api::api_outputs_test {

bdpt_output_desc output(bdpt_output_kind kind) {
  bdpt_output_desc desc = make<bdpt_output_desc>();
  desc.kind = kind;
  return desc;
}

// A camera with outputs, its film, and a render of some passes.
struct Rendered {
  Sensor sensor;
  Film film;

  Rendered(const World& world, const std::vector<bdpt_output_desc>& outputs, uint64_t n = 4,
           bdpt_camera_desc camera = camera_desc()) {
    camera.outputs = outputs.data();
    camera.output_count = uint32_t(outputs.size());
    sensor = make_camera(world.context.get(), camera);
    film = make_film(sensor.get());
    EXPECT_OK(advance(make_render(world.scene.get(), sensor.get(), film.get()).get(), n));
  }
  std::vector<float> read(bdpt_layer layer, uint32_t plane = 0) const {
    bdpt_film_info info = make<bdpt_film_info>();
    EXPECT_OK(bdpt_film_get_info(film.get(), &info));
    std::vector<float> pixels(size_t(info.width) * info.height * 3);
    bdpt_read_desc desc = make<bdpt_read_desc>();
    desc.layer = layer, desc.plane = plane;
    EXPECT_OK(bdpt_film_read(film.get(), &desc, pixels.data(), pixels.size() * sizeof(float)));
    return pixels;
  }
  std::vector<bdpt_coverage> coverage(uint32_t number, uint32_t ranks, double* lost) const {
    std::vector<bdpt_coverage> entries(24 * 16 * ranks);
    bdpt_coverage_desc desc = make<bdpt_coverage_desc>();
    desc.coverage = number, desc.ranks = ranks;
    EXPECT_OK(bdpt_film_read_coverage(film.get(), &desc, entries.data(), entries.size(), lost));
    return entries;
  }
};

TEST(ApiOutputs, FieldsAreChecked) {
  const World world;
  const auto result = [&](const std::function<void(bdpt_camera_desc&, std::vector<bdpt_output_desc>&)>& change) {
    bdpt_camera_desc desc = camera_desc();
    std::vector<bdpt_output_desc> outputs{output(BDPT_OUTPUT_RADIANCE)};
    desc.outputs = outputs.data(), desc.output_count = 1;
    change(desc, outputs);
    if (desc.outputs) desc.outputs = outputs.data();
    bdpt_sensor* sensor = nullptr;
    const bdpt_result r = bdpt_camera_create(world.context.get(), &desc, &sensor);
    EXPECT_EQ(r == BDPT_OK, sensor != nullptr);
    bdpt_sensor_release(sensor);
    return r;
  };
  const auto refused = [&](const std::function<void(bdpt_camera_desc&, bdpt_output_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result([&](auto& c, auto& o) { change(c, o[0]); }));
    const std::string error = bdpt_last_error();
    EXPECT_NE(error.find(": "), std::string::npos) << error;
  };
  EXPECT_OK(result([](auto&, auto&) {}));
  EXPECT_OK(result([](auto& c, auto& o) { o.resize(63, o[0]), c.output_count = 63; }));
  refused([](auto& c, auto&) { c.output_count = 64; });
  refused([](auto& c, auto&) { c.outputs = nullptr; });
  refused([](auto& c, auto&) { c.output_stride = 8; });
  refused([](auto&, auto& o) { o.kind = BDPT_OUTPUT_IRRADIANCE; });
  refused([](auto&, auto& o) { o.kind = BDPT_OUTPUT_MATERIAL_COVERAGE + 1; });
  refused([](auto&, auto& o) { o.kind = BDPT_OUTPUT_NONE; });
  refused([](auto&, auto& o) { o.paths = 3; });
  refused([](auto&, auto& o) { o.unfiltered = 2; });
  refused([](auto&, auto& o) { o.size = 8; });
  refused([](auto&, auto& o) { o.reach = 1; });
  refused([](auto&, auto& o) { o.struct_size = 8; });
  refused([](auto&, auto& o) { o.kind = BDPT_OUTPUT_DEPTH, o.paths = BDPT_LIGHT_PATHS_DIRECT; });
  refused([](auto&, auto& o) { o.kind = BDPT_OUTPUT_ALBEDO, o.groups = 1; });
  refused([](auto&, auto& o) { o.kind = BDPT_OUTPUT_INSTANCE_COVERAGE, o.unfiltered = 1; });
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result([](auto& c, auto& o) {
              o[0] = output(BDPT_OUTPUT_INSTANCE_COVERAGE);
              o.push_back(o[0]), c.output_count = 2;
            }));
}

TEST(ApiOutputs, LightmapsRefuseThoseOfCameras) {
  const World world;
  const bdpt_output_desc albedo = output(BDPT_OUTPUT_ALBEDO);
  const bdpt_point point{{0, 1, 0}, {0, 1, 0}, 0, 0};
  bdpt_points_desc desc = make<bdpt_points_desc>();
  desc.points = &point, desc.count = 1, desc.outputs = &albedo, desc.output_count = 1;
  bdpt_sensor* sensor = nullptr;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_points_create(world.context.get(), &desc, &sensor));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "camera")) << bdpt_last_error();
}

TEST(ApiOutputs, PlanesTellWhatTheyMeasure) {
  const World world;
  bdpt_output_desc indirect = output(BDPT_OUTPUT_RADIANCE);
  indirect.paths = BDPT_LIGHT_PATHS_INDIRECT, indirect.groups = 6;
  const Rendered r(world, {output(BDPT_OUTPUT_MATERIAL_COVERAGE), indirect, output(BDPT_OUTPUT_DEPTH)});
  const auto plane = [&](uint32_t number) {
    bdpt_plane_info info = make<bdpt_plane_info>();
    EXPECT_OK(bdpt_sensor_get_plane(r.sensor.get(), number, &info));
    return info;
  };
  EXPECT_EQ(plane(0).kind, BDPT_OUTPUT_NONE);
  EXPECT_EQ(plane(0).groups, ~0ull);
  EXPECT_EQ(plane(1).kind, BDPT_OUTPUT_RADIANCE);
  EXPECT_EQ(plane(1).paths, BDPT_LIGHT_PATHS_INDIRECT);
  EXPECT_EQ(plane(1).groups, 6u);
  EXPECT_EQ(plane(1).output, 1u);
  EXPECT_EQ(plane(2).kind, BDPT_OUTPUT_DEPTH);
  EXPECT_EQ(plane(2).groups, 0u);
  EXPECT_EQ(plane(2).output, 2u);
  bdpt_plane_info info = make<bdpt_plane_info>();
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_sensor_get_plane(r.sensor.get(), 3, &info));
  bdpt_film_info film = make<bdpt_film_info>();
  EXPECT_OK(bdpt_film_get_info(r.film.get(), &film));
  EXPECT_EQ(film.planes, 3u);
  EXPECT_EQ(film.coverages, 1u);
}

TEST(ApiOutputs, FilmsAndPlansThatDoNotFitAreRefused) {
  const World world;
  const Rendered r(world, {output(BDPT_OUTPUT_DEPTH)});
  bdpt_render* render = nullptr;
  EXPECT_EQ(BDPT_ERROR_MISMATCH,
            bdpt_render_create(world.scene.get(), r.sensor.get(), world.film.get(), nullptr, &render));
  EXPECT_EQ(BDPT_ERROR_MISMATCH,
            bdpt_render_create(world.scene.get(), world.sensor.get(), r.film.get(), nullptr, &render));
  // One output in place of another: the film is of the same shape, and filled already.
  const Rendered other(world, {output(BDPT_OUTPUT_NORMAL)}, 1);
  EXPECT_EQ(BDPT_ERROR_MISMATCH,
            bdpt_render_create(world.scene.get(), other.sensor.get(), r.film.get(), nullptr, &render));
  bdpt_render_desc mmlt = make<bdpt_render_desc>();
  mmlt.plan = "mmlt";
  const Film film = make_film(r.sensor.get());
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT,
            bdpt_render_create(world.scene.get(), r.sensor.get(), film.get(), &mmlt, &render));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "mmlt")) << bdpt_last_error();
}

// The picture's parts of each instance: the ball is seen in front of the floor.
TEST(ApiOutputs, CoverageNamesInstancesAndMaterials) {
  const World world;
  const Rendered r(
      world, {output(BDPT_OUTPUT_MATERIAL_COVERAGE), output(BDPT_OUTPUT_INSTANCE_COVERAGE), output(BDPT_OUTPUT_DEPTH)},
      64);
  double lost = 1;
  const std::vector<bdpt_coverage> instances = r.coverage(1, 8, &lost), materials = r.coverage(0, 8, nullptr);
  EXPECT_EQ(lost, 0);
  const std::vector<float> depth = r.read(BDPT_LAYER_COLOR, 1);  // coverage has no planes
  double ball = 0;
  for (size_t pixel = 0; pixel < 24 * 16; ++pixel) {
    double parts = 0, grey = 0, floor_and_ball = 0;
    for (size_t i = 8 * pixel; i < 8 * (pixel + 1); ++i) {
      const bdpt_coverage& e = instances[i];
      if (e.part > 0) {
        EXPECT_TRUE(e.id == world.contents.floor.id || e.id == world.contents.light.id ||
                    e.id == world.contents.thing.id);
      }
      if (i % 8 > 0) {
        EXPECT_LE(e.part, instances[i - 1].part);
      }
      parts += double(e.part);
      if (e.id == world.contents.thing.id) ball += double(e.part);
      if (e.id != world.contents.light.id) floor_and_ball += double(e.part);
      if (materials[i].id == world.contents.grey.id) grey += double(materials[i].part);
    }
    EXPECT_NEAR(parts, double(depth[3 * pixel + 2]), 1e-6);  // as much as anything is seen at all
    EXPECT_NEAR(grey, floor_and_ball, 1e-6);
  }
  // The ball of radius 1/2 at a distance d of the centre, angle a off the axis, is an ellipse on the plane at 1.
  const double d2 = 16 + 0.25, sine2 = 0.25 / d2, cos_a = 4 / std::sqrt(d2);
  const double area = M_PI * sine2 * std::sqrt(1 - sine2) * cos_a / std::pow(cos_a * cos_a - sine2, 1.5);
  const double pixel_side = 2 * std::tan(22.5 * M_PI / 180) / 16;
  EXPECT_NEAR(ball, area / (pixel_side * pixel_side), 0.02 * ball);
  const std::vector<bdpt_coverage> one = r.coverage(1, 1, &lost);
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, 0.2);

  bdpt_coverage entry{};
  const auto refused = [&](const bdpt_film* film, const std::function<void(bdpt_coverage_desc&)>& change) {
    bdpt_coverage_desc desc = make<bdpt_coverage_desc>();
    desc.ranks = 1, desc.rect[2] = desc.rect[3] = 1;
    change(desc);
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_read_coverage(film, &desc, &entry, 1, nullptr));
  };
  bdpt_coverage_desc valid = make<bdpt_coverage_desc>();
  valid.ranks = 1, valid.rect[2] = valid.rect[3] = 1;
  EXPECT_OK(bdpt_film_read_coverage(r.film.get(), &valid, &entry, 1, nullptr));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_read_coverage(r.film.get(), &valid, &entry, 0, nullptr));
  refused(world.film.get(), [](auto&) {});
  refused(r.film.get(), [](auto& d) { d.coverage = 2; });
  refused(r.film.get(), [](auto& d) { d.ranks = 0; });
  refused(r.film.get(), [](auto& d) { d.ranks = 9; });
  refused(r.film.get(), [](auto& d) { d.include_partial = 2; });
  refused(r.film.get(), [](auto& d) { d.rect[2] = 2; });
  refused(r.film.get(), [](auto& d) { d.struct_size = 24; });
}

TEST(ApiOutputs, SamplesAreReadWhereTheyAreCounted) {
  const World world;
  const Rendered r(world, {output(BDPT_OUTPUT_DEPTH)}, 6);
  for (float v : r.read(BDPT_LAYER_SAMPLES)) EXPECT_EQ(v, 6);
  bdpt_read_desc desc = make<bdpt_read_desc>();
  desc.layer = BDPT_LAYER_SAMPLES;
  std::vector<float> pixels(24 * 16 * 3);
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT,
            bdpt_film_read(world.film.get(), &desc, pixels.data(), pixels.size() * sizeof(float)));
}

TEST(ApiOutputs, MemoryIsToldBefore) {
  const World world;
  const auto film_bytes = [&](const std::vector<bdpt_output_desc>& outputs) {
    bdpt_camera_desc camera = camera_desc();
    camera.outputs = outputs.data(), camera.output_count = uint32_t(outputs.size());
    const Sensor sensor = make_camera(world.context.get(), camera);
    bdpt_memory_estimate estimate = make<bdpt_memory_estimate>();
    EXPECT_OK(bdpt_film_estimate(sensor.get(), nullptr, &estimate));
    return estimate.film / (24 * 16);
  };
  const uint64_t plain = film_bytes({}), one = film_bytes({output(BDPT_OUTPUT_ALBEDO)});
  EXPECT_EQ(plain, 112u * 3);
  EXPECT_EQ(one, (112u + 32 + 96) * 3);
  EXPECT_EQ(film_bytes({output(BDPT_OUTPUT_ALBEDO), output(BDPT_OUTPUT_INSTANCE_COVERAGE)}), one + 272);
}

TEST(ApiOutputs, TheDenoiserWorksOrSaysThatItIsAbsent) {
  std::vector<float> color(32 * 32 * 3), output(color.size());
  for (size_t i = 0; i < color.size(); ++i) color[i] = i / 3 % 2 == 0 ? 0.4f : 0.6f;
  bdpt_denoise_desc desc = make<bdpt_denoise_desc>();
  desc.width = desc.height = 32, desc.color = color.data(), desc.output = output.data();
  if (!bdpt_has_denoiser()) {
    EXPECT_EQ(BDPT_ERROR_UNSUPPORTED, bdpt_denoise(&desc));
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "Open Image Denoise")) << bdpt_last_error();
    for (float v : output) EXPECT_EQ(v, 0);
  } else {
    EXPECT_OK(bdpt_denoise(&desc));
    double sum = 0;
    for (float v : output) sum += double(v) / double(output.size());
    EXPECT_NEAR(sum, 0.5, 0.05);
  }
  // What is wrong is wrong, there or not.
  const auto refused = [&](const std::function<void(bdpt_denoise_desc&)>& change) {
    bdpt_denoise_desc d = desc;
    change(d);
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_denoise(&d)) << bdpt_last_error();
  };
  refused([](auto& d) { d.width = 0; });
  refused([](auto& d) { d.height = 65537; });
  refused([](auto& d) { d.color = nullptr; });
  refused([](auto& d) { d.output = nullptr; });
  refused([](auto& d) { d.clean = 1; });
  refused([](auto& d) { d.clean = 2; });
  refused([](auto& d) { d.threads = 1025; });
  refused([](auto& d) { d.reserved = 1; });
  refused([&](auto& d) { d.normal = color.data(); });
  refused([&](auto& d) { d.color = reinterpret_cast<const float*>(reinterpret_cast<const char*>(color.data()) + 1); });
}

}  // namespace bdpt_api::api_outputs_test
