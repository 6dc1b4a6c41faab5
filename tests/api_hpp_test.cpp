// The header for C++: what C gives, to the bit; errors; handles that count.
#include "api_hpp.h"
#include "temp_folder.h"

#include <thread>

namespace bdpt_api::api_hpp_test {

static_assert(std::is_copy_constructible_v<bdpt::Context> && std::is_nothrow_move_constructible_v<bdpt::Context>);
static_assert(std::is_copy_assignable_v<bdpt::Scene> && std::is_copy_assignable_v<bdpt::Sensor>);
static_assert(std::is_copy_assignable_v<bdpt::Film> && std::is_copy_assignable_v<bdpt::Cancel>);
static_assert(!std::is_copy_constructible_v<bdpt::Builder> && std::is_nothrow_move_assignable_v<bdpt::Builder>);
static_assert(!std::is_copy_constructible_v<bdpt::Render> && std::is_nothrow_move_assignable_v<bdpt::Render>);

TEST(ApiHpp, GivesTheBitsOfC) {
  const World c;
  const Render c_render = c.render();
  ASSERT_OK(advance(c_render.get(), 4));
  const HppWorld world({}, {}, two_threads());
  bdpt::Render render = world.render();
  const bdpt_advance_report report = render.advance(4);
  EXPECT_EQ(4u, report.passes);
  EXPECT_EQ(BDPT_STOP_PASSES, report.reason);
  EXPECT_EQ(pixels_of(c.film.get()), world.film.read());
  EXPECT_EQ(scene_hash(c.scene.get()), world.scene.info().hash);
  EXPECT_EQ(1u, world.scene.info().lights);
  EXPECT_EQ(world.scene.light(0).instance.id != 0, true);
  EXPECT_EQ(2u, world.context.info().threads == 2 ? 2u : std::thread::hardware_concurrency() < 2 ? 2u : 0u);
  EXPECT_EQ(4u, render.stats().passes);
  EXPECT_GT(render.technique_stats(1, 2).contributions, 0u);
  EXPECT_EQ(BDPT_OUTPUT_NONE, world.sensor.plane(0).kind);
  EXPECT_GT(world.sensor.estimate().film, 0u);
  EXPECT_NEAR(0.7152f, world.context.color_info().luminance[1], 1e-3f);
}

TEST(ApiHpp, FilmsAreReadInPartsMergedAndSaved) {
  const HppWorld world;
  bdpt_render_desc later{};
  later.first_pass = 2;
  const bdpt::Film second(world.sensor);
  bdpt::Render(world.scene, world.sensor, world.film).advance(2);
  bdpt::Render(world.scene, world.sensor, second, later).advance(2);
  world.film.merge(second);
  EXPECT_EQ(4u, world.film.info().passes);
  const bdpt::TempFolder folder;
  world.film.save(folder.file("film"));
  const bdpt::Film loaded = bdpt::Film::load(world.context, folder.file("film"));
  const std::vector<float> whole = world.film.read();
  EXPECT_EQ(whole, loaded.read());

  bdpt_read_desc part{};
  const uint32_t rect[4] = {3, 2, 7, 5};
  std::memcpy(part.rect, rect, sizeof rect);
  const std::vector<float> pixels = loaded.read(part);
  ASSERT_EQ(4u * 3 * 3, pixels.size());
  EXPECT_EQ(whole[(2 * 24 + 3) * 3], pixels[0]);
  part.row_stride = 80;
  EXPECT_EQ(3u * 20, loaded.read(part).size());
  for (const uint32_t x1 : {1u, 25u, 0xFFFFFFFFu}) {  // before x0, and out of the film
    part.rect[2] = x1;
    expect_error(BDPT_ERROR_INVALID_ARGUMENT, "rect", [&] { loaded.read(part); });
  }
  part = {};
  part.row_stride = ~uint64_t(3);
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "", [&] { loaded.read(part); });
  loaded.clear();
  EXPECT_EQ(0u, loaded.info().passes);
  expect_error(BDPT_ERROR_IO, "nowhere", [&] { bdpt::Film::load(world.context, folder.file("nowhere")); });
}

TEST(ApiHpp, ReadsCoverage) {
  const HppWorld world;
  auto output = bdpt::make<bdpt_output_desc>();
  output.kind = BDPT_OUTPUT_INSTANCE_COVERAGE;
  bdpt_camera_desc camera = camera_desc();
  camera.output_count = 1;
  camera.outputs = &output;
  const bdpt::Sensor sensor = bdpt::Sensor::camera(world.context, camera);
  const bdpt::Film film(sensor);
  bdpt::Render(world.scene, sensor, film).advance(1);
  bdpt_coverage_desc desc{};
  desc.ranks = 2;
  double lost = -1;
  const std::vector<bdpt_coverage> entries = film.read_coverage(desc, &lost);
  ASSERT_EQ(24u * 16 * 2, entries.size());
  EXPECT_GE(lost, 0);
  EXPECT_TRUE(std::any_of(entries.begin(), entries.end(), [](const bdpt_coverage& e) { return e.part == 1; }));
  desc.ranks = 9;
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "ranks", [&] { film.read_coverage(desc); });
}

TEST(ApiHpp, CopiesHoldWhatTheyNameAndMovedFromHandlesAreEmpty) {
  bdpt::Film film;
  EXPECT_FALSE(film);
  bdpt::Sensor sensor;
  bdpt::Scene scene;
  {
    const HppWorld world;
    film = world.film;
    EXPECT_EQ(film.get(), world.film.get());
    const bdpt::Film& same = film;
    film = same;  // to itself
    scene = world.scene;
    sensor = world.sensor;
  }
  bdpt::Render render(scene, sensor, film);  // all others are gone
  EXPECT_EQ(1u, render.advance(1).passes);
  bdpt::Render moved = std::move(render);
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "render", [&] { render.advance(1); });
  EXPECT_FALSE(render);
  render = std::move(moved);
  EXPECT_EQ(1u, render.advance(1).passes);
  const bdpt::Film other = std::move(film);
  EXPECT_FALSE(film);
  EXPECT_EQ(2u, other.info().passes);
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "film", [&] { film.info(); });
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "film", [&] { film.read(); });
  bdpt::Context none(nullptr);
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "context", [&] { bdpt::Builder builder(none); });
  bdpt::Builder builder(nullptr);
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "builder", [&] { builder.build(); });
  const bdpt::Context copy = none;
  EXPECT_FALSE(copy);
}

TEST(ApiHpp, MemoryIsGivenBackWithTheLastHandle) {
  const bdpt::Context context;
  const uint64_t empty = context.info().memory;
  {
    bdpt::Builder builder(context);
    const HppContents contents(builder);
    const bdpt::Scene scene = builder.build(), copy = scene;
    const bdpt::Sensor sensor = bdpt::Sensor::camera(context, camera_desc());
    const bdpt::Film film(sensor), second = film;
    bdpt::Render(scene, sensor, film).advance(1);
    EXPECT_GT(context.info().memory, empty);
  }
  EXPECT_EQ(empty, context.info().memory);
}

TEST(ApiHpp, ErrorsCarryCodeAndText) {
  bdpt::Context context;
  bdpt::Builder builder(context);
  bdpt_sphere_desc sphere{};
  sphere.radius = -1;
  sphere.label = "marble";
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "marble", [&] { builder.add_sphere(sphere); });
  expect_error(BDPT_ERROR_INVALID_ID, "", [&] { builder.remove(bdpt_light_id{77}); });
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "metal", [] {
    float eta[3], k[3];
    bdpt::check(bdpt_metal_find("Un", eta, k));
  });
  const HppContents contents(builder);
  expect_error(BDPT_ERROR_IN_USE, "", [&] { builder.remove(contents.ball); });
  bdpt_material_desc material = grey_desc();
  material.reflectance[1] = 2;
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "reflectance", [&] { builder.update(contents.grey, material); });
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "", [&] {  // no limit
    const HppWorld world;
    world.render().advance(0);
  });
}

TEST(ApiHpp, IdsAreAddedUpdatedAndRemoved) {
  const bdpt::Context context;
  bdpt::Builder builder(context);
  const HppContents contents(builder);
  bdpt_medium_desc medium{};
  medium.sigma_s[0] = 1;
  const bdpt_medium_id fog = builder.add_medium(medium);
  builder.update(fog, medium);
  builder.remove(fog);
  bdpt_light_desc light{};
  light.intensity[0] = 1;
  const bdpt_light_id lamp = builder.add_light(light);
  builder.update(lamp, light);
  builder.remove(lamp);
  const uint8_t texel[3] = {1, 2, 3};
  bdpt_texture_desc picture{};
  picture.channels = 3, picture.pixels = texel, picture.width = picture.height = 1;
  builder.remove(builder.add_texture(picture));
  const float points[2][3] = {{0, 0, 0}, {1, 0, 0}}, radius = 0.1f;
  bdpt_curves_desc curves{};
  curves.positions = bdpt::data(points, 2, BDPT_FORMAT_FLOAT3);
  curves.radii = bdpt::data(&radius, 1, BDPT_FORMAT_FLOAT1);
  builder.remove(builder.add_curves(curves));
  bdpt_instance_desc place = instance_desc(contents.ball, contents.grey);
  const bdpt_instance_id second = builder.add_instance(place);
  builder.update(second, place);
  builder.remove(second);
  const bdpt_material_id material = builder.add_material(grey_desc());
  builder.remove(material);
  EXPECT_GT(builder.build().info().triangles, 0u);
}

TEST(ApiHpp, ACancelIsAnOutcomeOfAdvanceAndAnErrorWhereNothingWasMade) {
  HppWorld world;
  const bdpt::Cancel cancel, copy = cancel;
  copy.request();
  EXPECT_TRUE(cancel.is_requested());
  bdpt_build_desc build{};
  build.cancel = cancel.get();
  expect_error(BDPT_CANCELLED, "cancelled", [&] { world.builder.build(build); });
  bdpt::Render render = world.render();
  bdpt_advance_desc desc = passes(5);
  desc.cancel = cancel.get();
  EXPECT_EQ(BDPT_STOP_CANCELLED, render.advance(desc).reason);
  cancel.reset();
  EXPECT_EQ(BDPT_STOP_PASSES, render.advance(desc).reason);
  EXPECT_EQ(5u, world.film.info().passes);
}

TEST(ApiHpp, BorrowedDataStaysAsLongAsItIsNeeded) {
  const auto positions = std::make_shared<std::vector<float>>(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0});
  const bdpt::Context context;
  bdpt::Scene scene;
  {
    bdpt::Builder builder(context);
    bdpt_mesh_desc mesh{};
    mesh.positions = bdpt::borrow(positions, positions->data(), 3, BDPT_FORMAT_FLOAT3);
    mesh.positions.slack_bytes = 12;
    EXPECT_EQ(2, positions.use_count());
    const bdpt_shape_id shape = builder.add_mesh(mesh);
    builder.add_instance(instance_desc(shape, builder.add_material(grey_desc())));
    scene = builder.build();
    mesh.positions = bdpt::borrow(positions, positions->data(), 3, BDPT_FORMAT_FLOAT2);
    expect_error(BDPT_ERROR_INVALID_ARGUMENT, "positions", [&] { builder.add_mesh(mesh); });
  }
  EXPECT_EQ(2, positions.use_count());
  scene = nullptr;
  EXPECT_EQ(1, positions.use_count());
}

TEST(ApiHpp, SensorsOfSurfacesAndPoints) {
  const HppWorld world;
  bdpt_point point{};
  point.normal[1] = 1;
  bdpt_points_desc points{};
  points.count = 1;
  points.points = &point;
  const bdpt::Sensor at = bdpt::Sensor::points(world.context, points);
  EXPECT_EQ(BDPT_OUTPUT_IRRADIANCE, at.plane(0).kind);

  bdpt::Builder builder(world.context);
  const bdpt_shape_id square = builder.add_mesh(square_desc());
  const bdpt_instance_id floor = builder.add_instance(instance_desc(square, builder.add_material(grey_desc())));
  const bdpt::Scene scene = builder.build();
  auto mapped = bdpt::make<bdpt_lightmap_instance>();
  mapped.instance = floor;
  bdpt_lightmap_desc map{};
  map.width = map.height = 4;
  map.instances = &mapped, map.instance_count = 1;
  const bdpt::Sensor lightmap = bdpt::Sensor::lightmap(scene, map);
  EXPECT_EQ(16u, lightmap.lightmap_info().texels);
  EXPECT_EQ(4u, scene.estimate(map).band_rows);
  float coverage[16], area[16], buried[16];
  lightmap.read_texels(coverage, area, 16);
  lightmap.read_buried(buried, 16);
  EXPECT_NEAR(0.25f, area[5], 1e-5f);
  EXPECT_EQ(0, buried[5]);
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "", [&] { at.lightmap_info(); });
  const bdpt::Cancel cancel;
  cancel.request();
  map.cancel = cancel.get();
  map.buried_rays = 16;
  expect_error(BDPT_CANCELLED, "cancelled", [&] { bdpt::Sensor::lightmap(scene, map); });

  auto corner = bdpt::make<bdpt_vertex_instance>();
  corner.instance = floor;
  bdpt_vertices_desc of{};
  of.instances = &corner, of.instance_count = 1;
  const bdpt::Sensor vertices = bdpt::Sensor::vertices(scene, of);
  float areas[4], values[4] = {1, 1, 1, 1};
  vertices.read_areas(areas, 4);
  EXPECT_NEAR(4, areas[0] + areas[1] + areas[2] + areas[3], 1e-4f);
  vertices.solve(1, values, 4);
  EXPECT_NEAR(1, values[2], 1e-4f);
  float rgb[3] = {1, 1, 1};
  world.context.convert("ACEScg", nullptr, rgb, 1);
  EXPECT_NEAR(1, rgb[1], 1e-4f);
}

}  // namespace bdpt_api::api_hpp_test
