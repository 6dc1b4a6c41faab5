// The header for C++: what C gives, to the bit; exceptions that leave the call that caused them; handles that count.
#include "bdpt.hpp"

#include "api_scene.h"
#include "temp_folder.h"

#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>
#include <thread>

namespace bdpt_api::api_hpp_test {

static_assert(std::is_copy_constructible_v<bdpt::Context> && std::is_nothrow_move_constructible_v<bdpt::Context>);
static_assert(std::is_copy_assignable_v<bdpt::Scene> && std::is_copy_assignable_v<bdpt::Sensor>);
static_assert(std::is_copy_assignable_v<bdpt::Film> && std::is_copy_assignable_v<bdpt::Cancel>);
static_assert(!std::is_copy_constructible_v<bdpt::Builder> && std::is_nothrow_move_assignable_v<bdpt::Builder>);
static_assert(!std::is_copy_constructible_v<bdpt::Render> && std::is_nothrow_move_assignable_v<bdpt::Render>);

// What callables throw: nothing that the library knows.
struct Thrown {
  int number;
};

// The call throws what a callable threw.
void expect_thrown(int number, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown instead of " << number;
  } catch (const Thrown& thrown) {
    EXPECT_EQ(number, thrown.number);
  }
}

// The call fails with a text that has this part.
void expect_error(bdpt_result code, const char* part, const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "no error instead of " << bdpt_result_name(code);
  } catch (const bdpt::Error& error) {
    EXPECT_EQ(code, error.code()) << error.what();
    EXPECT_STREQ(bdpt_result_name(code), error.name());
    EXPECT_NE(nullptr, std::strstr(error.what(), part)) << '"' << part << "\" in: " << error.what();
  }
}

// Something captured, of which there is one as long as the callable lives.
class Captured {
 public:
  explicit Captured(std::atomic<int>& alive) : alive_(&alive) { ++*alive_; }
  Captured(const Captured& o) : alive_(o.alive_) { ++*alive_; }
  Captured& operator=(const Captured&) = delete;
  ~Captured() { --*alive_; }

 private:
  std::atomic<int>* alive_;
};

// The floor, lamp and ball of Contents.
struct HppContents {
  bdpt_shape_id square, ball;
  bdpt_material_id grey, lamp;

  explicit HppContents(bdpt::Builder& b) {
    square = b.add_mesh(square_desc());
    bdpt_sphere_desc sphere{};
    sphere.radius = 0.5f;
    sphere.label = "ball";
    ball = b.add_sphere(sphere);
    bdpt_material_desc material = grey_desc();
    material.struct_size = 0;  // is set for us
    grey = b.add_material(material);
    for (float& v : material.emission) v = 4;
    lamp = b.add_material(material);
    b.add_instance(instance_desc(square, grey, 3));
    b.add_instance(instance_desc(square, lamp, 0.5f, 2, true));
    b.add_instance(instance_desc(ball, grey, 1, 0.5f));
  }
};

bdpt_context_desc two_threads() {
  bdpt_context_desc desc{};
  desc.threads = 2;
  return desc;
}

struct HppWorld {
  bdpt::Context context;
  bdpt::Builder builder;
  HppContents contents;
  bdpt::Scene scene;
  bdpt::Sensor sensor;
  bdpt::Film film;

  explicit HppWorld(bdpt::Executor executor = {}, bdpt::Log log = {}, bdpt_context_desc desc = {})
      : context(desc, std::move(executor), std::move(log)),
        builder(context),
        contents(builder),
        scene(builder.build()),
        sensor(bdpt::Sensor::camera(context, camera_desc())),
        film(sensor) {}
  bdpt::Render render() const { return {scene, sensor, film}; }
};

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

// A sink that counts, and throws a number at one of its functions.
struct Sink {
  int throw_at = -1;
  int begins = 0, tiles = 0, ends = 0;
  void begin(uint32_t width, uint32_t height, uint64_t) {
    EXPECT_EQ(24u * 16, width * height);
    ++begins;
    if (throw_at == 0) throw Thrown{0};
  }
  int32_t tile(uint32_t, uint32_t, uint32_t, uint32_t, const float* pixels) {
    EXPECT_GE(pixels[0], 0);
    ++tiles;
    if (throw_at == 1) throw Thrown{1};
    return throw_at == 9 ? -9 : 0;
  }
  void end(bdpt_result) {
    ++ends;
    if (throw_at == 2) throw Thrown{2};
  }
};
struct TileOnly {
  int* tiles;
  void tile(uint32_t, uint32_t, uint32_t, uint32_t, const float*) const { ++*tiles; }
};

TEST(ApiHpp, WhatCallablesOfACallThrowLeavesTheCall) {
  HppWorld world;
  bdpt::Render render = world.render();
  const auto thrower = [](const bdpt_progress&) { throw Thrown{5}; };
  expect_thrown(5, [&] { world.builder.build({}, thrower); });
  expect_thrown(5, [&] { render.advance(passes(1), thrower); });
  // At the end of a build that has gone well.
  expect_thrown(6, [&] {
    world.builder.build({}, [](const bdpt_progress& p) {
      if (p.fraction == 1) throw Thrown{6};
    });
  });
  int seen = 0;
  const auto look = [&](const bdpt_progress& p) {
    EXPECT_EQ(sizeof p, p.struct_size);
    ++seen;
  };
  EXPECT_TRUE(world.builder.build({}, look));
  EXPECT_GE(seen, 2);
  for (int at = 0; at < 3; ++at) {
    Sink sink;
    sink.throw_at = at;
    expect_thrown(at, [&] { render.advance(passes(1), look, sink); });
    EXPECT_EQ(1, sink.begins);
    EXPECT_EQ(1, sink.ends);
  }
  Sink sink;
  sink.throw_at = 9;
  expect_error(BDPT_ERROR_CALLBACK_FAILED, "-9", [&] { render.advance(passes(1), look, sink); });
  expect_error(BDPT_ERROR_CALLBACK_FAILED, "77",
               [&] { render.advance(passes(1), [](const bdpt_progress&) -> int32_t { return 77; }); });
  sink = {};
  const bdpt_advance_report report = render.advance(passes(4), look, sink, 2);
  EXPECT_EQ(4u, report.passes);
  EXPECT_GE(sink.begins, 2);
  EXPECT_EQ(sink.begins, sink.ends);
  EXPECT_GT(sink.tiles, 0);
  int tiles = 0;
  render.advance(passes(1), look, TileOnly{&tiles});
  EXPECT_GT(tiles, 0);
}

bdpt_subdivision_desc quad(const float (*corners)[3], const uint32_t* indices) {
  bdpt_subdivision_desc desc{};
  desc.level = 4;
  desc.positions = bdpt::data(corners, 4, BDPT_FORMAT_FLOAT3);
  desc.indices = bdpt::data(indices, 4, BDPT_FORMAT_UINT32);
  return desc;
}

TEST(ApiHpp, DisplacementIsACallable) {
  const bdpt::Context context;
  bdpt::Builder builder(context);
  const uint32_t indices[4] = {0, 1, 2, 3};
  const bdpt_subdivision_desc desc = quad(kSquare, indices);
  uint64_t places = 0;
  const bdpt_shape_id raised =
      builder.add_subdivision(desc, [&](uint64_t n, const float*, const float*, const float*, float* displaced) {
        for (uint64_t i = 0; i < n; ++i) displaced[3 * i + 1] += 2;
        places += n;
      });
  EXPECT_GT(places, 0u);
  builder.add_instance(instance_desc(raised, builder.add_material(grey_desc())));
  const bdpt_scene_info info = builder.build().info();
  EXPECT_EQ(2, info.bounds_min[1]);
  EXPECT_EQ(32u, info.triangles);
  expect_thrown(3, [&] {
    builder.add_subdivision(desc, [](uint64_t, const float*, const float*, const float*, float*) { throw Thrown{3}; });
  });
  expect_error(BDPT_ERROR_CALLBACK_FAILED, "12", [&] {
    builder.add_subdivision(desc,
                            [](uint64_t, const float*, const float*, const float*, float*) -> int32_t { return 12; });
  });
  EXPECT_NE(0u, builder.add_subdivision(desc).id);
}

bdpt_material_id add_textured(bdpt::Builder& builder, bdpt_texture_id texture) {
  auto use = bdpt::make<bdpt_texture_use>();
  use.texture = texture;
  bdpt_material_desc material = grey_desc();
  material.textures = &use;
  material.texture_count = 1;
  return builder.add_material(material);
}

TEST(ApiHpp, TexturesAreCallablesThatAreDroppedOnceAndMayThrow) {
  std::atomic<int> alive{0}, calls{0};
  std::atomic<bool> throws{false};
  {
    HppWorld world;
    bdpt_host_texture_desc desc{};
    const auto half = [captured = Captured(alive), &calls, &throws](uint32_t n, const bdpt_texture_place*,
                                                                    float(*colors)[4]) {
      ++calls;
      if (throws) throw Thrown{8};
      for (uint32_t i = 0; i < n; ++i) colors[i][0] = colors[i][1] = colors[i][2] = 0.5f, colors[i][3] = 1;
    };
    EXPECT_EQ(1, alive);
    const bdpt_texture_id texture = world.builder.add_host_texture(desc, half);
    EXPECT_EQ(2, alive);
    world.builder.add_instance(
        instance_desc(world.contents.square, add_textured(world.builder, texture), 0.3f, 1.2f, false));
    bdpt::Scene scene = world.builder.build();
    world.builder = bdpt::Builder(world.context);
    EXPECT_EQ(2, alive) << "the scene has it";
    bdpt::Render render(scene, world.sensor, world.film);
    scene = nullptr;
    throws = true;
    expect_thrown(8, [&] { render.advance(1); });
    throws = false;
    EXPECT_EQ(2u, render.advance(2).passes);
    EXPECT_GT(calls, 1);
    render = nullptr;
    EXPECT_EQ(1, alive) << "dropped with the last render of the scene";
    // A call that fails drops it, too; so does one that cannot even begin.
    desc.maximum = -1;
    expect_error(BDPT_ERROR_INVALID_ARGUMENT, "maximum", [&] { world.builder.add_host_texture(desc, half); });
    EXPECT_EQ(1, alive);
    bdpt::Builder empty(nullptr);
    desc.maximum = 0;
    expect_error(BDPT_ERROR_INVALID_ARGUMENT, "builder", [&] { empty.add_host_texture(desc, half); });
    EXPECT_EQ(1, alive);
  }
  EXPECT_EQ(0, alive);
}

// The irradiance of the floor beside the ball; each of its functions can be told to throw.
struct Beside {
  Captured captured;
  const std::atomic<int>* throw_at;
  void start(uint32_t n, const uint64_t*, const float (*u)[4], bdpt_measurement_start* starts) const {
    if (*throw_at == 0) throw Thrown{0};
    for (uint32_t i = 0; i < n; ++i) {
      const float r = std::sqrt(u[i][2]), phi = 6.2831853f * u[i][3];
      starts[i].position[0] = 1, starts[i].position[1] = 0.01f;
      starts[i].normal[1] = 1;
      starts[i].direction[0] = r * std::cos(phi);
      starts[i].direction[1] = std::sqrt(std::max(0.f, 1 - u[i][2]));
      starts[i].direction[2] = r * std::sin(phi);
      starts[i].weight = 1;
      starts[i].density_position = 1;
      starts[i].density_direction = 0.31830989f;
      starts[i].offset = 1e-4f;
    }
  }
  int32_t density(uint32_t n, const bdpt_measurement_place*, float* densities) const {
    if (*throw_at == 1) throw Thrown{1};
    std::fill_n(densities, n, 0.31830989f);
    return 0;
  }
  void respond(uint32_t n, const bdpt_measurement_place*, float* responses) const {
    if (*throw_at == 2) throw Thrown{2};
    std::fill_n(responses, n, 1.f);
  }
  void land(uint32_t n, const bdpt_measurement_landing*, bdpt_measurement_landed* landed) const {
    if (*throw_at == 3) throw Thrown{3};
    for (uint32_t i = 0; i < n; ++i) landed[i].measurement = BDPT_NO_MEASUREMENT;
  }
};
// The same with the function that it must have, alone.
struct StartOnly {
  Beside beside;
  void start(uint32_t n, const uint64_t* which, const float (*u)[4], bdpt_measurement_start* starts) const {
    beside.start(n, which, u, starts);
  }
};

TEST(ApiHpp, MeasurementsAreObjectsThatAreDroppedOnceAndMayThrow) {
  std::atomic<int> alive{0}, throw_at{-1};
  const HppWorld world;
  bdpt_custom_desc desc{};
  desc.measurements = 1;
  {
    bdpt::Sensor sensor = bdpt::Sensor::custom(world.context, desc, Beside{Captured(alive), &throw_at});
    EXPECT_EQ(1, alive);
    const bdpt::Film film(sensor);
    bdpt::Render render(world.scene, sensor, film);
    sensor = nullptr;
    for (int at = 0; at < 4; ++at) {
      throw_at = at;
      expect_thrown(at, [&] { render.advance(64); });
    }
    throw_at = -1;
    EXPECT_EQ(256u, render.advance(256).passes);
    const bdpt::Sensor start = bdpt::Sensor::custom(world.context, desc, StartOnly{{Captured(alive), &throw_at}});
    const bdpt::Film other(start);
    bdpt::Render(world.scene, start, other).advance(1024);
    EXPECT_EQ(2, alive);
    EXPECT_GT(film.read()[0], 0);
    EXPECT_NEAR(film.read()[0], other.read()[0], 0.2f * film.read()[0]);
  }
  EXPECT_EQ(0, alive);
  desc.planes = 5000;
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "planes", [&] {
    bdpt::Sensor::custom(world.context, desc, Beside{Captured(alive), &throw_at});
  });
  EXPECT_EQ(0, alive);
}

// Lambert's, or one that throws.
struct Matt {
  Captured captured;
  const std::atomic<bool>* throws;
  void evaluate(const bdpt_scattering_place& place, const float next[3], bdpt_scattering_value& value) const {
    if (*throws) throw Thrown{0};
    if (place.previous[2] * next[2] <= 0) return;
    for (float& f : value.f) f = 0.5f * 0.31830989f;
    value.density = std::abs(next[2]) * 0.31830989f;
    value.density_reverse = std::abs(place.previous[2]) * 0.31830989f;
  }
  int32_t sample(const bdpt_scattering_place& place, const float u[3], float next[3]) const {
    const float r = std::sqrt(u[0]), phi = 6.2831853f * u[1], z = std::sqrt(std::max(0.f, 1 - u[0]));
    next[0] = r * std::cos(phi), next[1] = r * std::sin(phi), next[2] = place.previous[2] > 0 ? z : -z;
    return 0;
  }
};

TEST(ApiHpp, MaterialsAreObjectsThatAreDroppedOnceAndWhoseExceptionsAreCounted) {
  std::atomic<int> alive{0};
  std::atomic<bool> throws{false};
  {
    HppWorld world;
    bdpt_material_desc desc{};
    bdpt_host_material host{};
    const bdpt_material_id matt = world.builder.add_host_material(desc, host, Matt{Captured(alive), &throws});
    EXPECT_EQ(1, alive);
    bdpt::Builder builder(world.context);
    const HppContents contents(builder);
    const bdpt_material_id own = builder.add_host_material(desc, host, Matt{Captured(alive), &throws});
    builder.add_instance(instance_desc(contents.ball, own, 0.5f, 2.5f));  // behind the lamp
    builder.add_instance(instance_desc(contents.square, own, 1.5f, 0.001f));
    world.builder.remove(matt);
    EXPECT_EQ(1, alive);
    const bdpt::Scene scene = builder.build();
    bdpt::Render render(scene, world.sensor, world.film);
    render.advance(64);
    EXPECT_EQ(0u, world.film.info().rejected);
    throws = true;
    render.advance(1);
    EXPECT_GT(world.film.info().rejected, 0u);
    EXPECT_EQ(1, alive);
    bdpt_material_desc shining = desc;
    shining.opacity_mode = 77;
    expect_error(BDPT_ERROR_INVALID_ARGUMENT, "opacity_mode", [&] {
      builder.add_host_material(shining, host, Matt{Captured(alive), &throws});
    });
    EXPECT_EQ(1, alive);
  }
  EXPECT_EQ(0, alive);
}

TEST(ApiHpp, ExecutorsAndLogsAreCallablesThatAreDroppedOnce) {
  std::atomic<int> alive{0}, runs{0}, lines{0};
  std::atomic<bool> throws{false};
  const auto run = [captured = Captured(alive), &runs, &throws](uint32_t n, bdpt::Body body) {
    ++runs;
    if (throws) throw Thrown{4};
    for (uint32_t i = n; i-- > 0;) body(i);
  };
  const auto write = [captured = Captured(alive), &lines, &throws](bdpt_log_level, const char* text) {
    EXPECT_NE('\0', text[0]);
    ++lines;
    if (throws) throw Thrown{1};  // is lost
  };
  {
    const World c;
    const Render c_render = c.render();
    ASSERT_OK(advance(c_render.get(), 3));
    HppWorld world({1, run}, bdpt::Log(write));
    EXPECT_EQ(4, alive);
    bdpt::Render render = world.render();
    throws = true;
    expect_thrown(4, [&] { render.advance(1); });
    bdpt::Builder dark(world.context);
    const bdpt_shape_id square = dark.add_mesh(square_desc());
    dark.add_instance(instance_desc(square, dark.add_material(grey_desc())));
    dark.build();  // tells the log that there is no light
    throws = false;
    EXPECT_GT(lines, 0);
    render.advance(3);
    EXPECT_GT(runs, 1);
    EXPECT_EQ(pixels_of(c.film.get()), world.film.read());
  }
  EXPECT_EQ(2, alive);
  // Refused, by the executor's fault and by another; and given to nothing.
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "worker_count",
               [&] { bdpt::Context({}, bdpt::Executor(0, run), bdpt::Log(write)); });
  bdpt_context_desc desc{};
  desc.threads = 5000;
  expect_error(BDPT_ERROR_INVALID_ARGUMENT, "threads", [&] { bdpt::Context(desc, bdpt::Executor(1, run)); });
  {
    const bdpt::Executor executor(1, run);
    const bdpt::Log log(write);
    EXPECT_EQ(4, alive);
  }
  EXPECT_EQ(2, alive);
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
