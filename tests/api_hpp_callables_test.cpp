// Callables by the header for C++: what they throw leaves the call that caused it, and each is dropped once.
#include "api_hpp.h"

#include <cmath>

namespace bdpt_api::api_hpp_callables_test {

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

TEST(ApiHppCallables, WhatCallablesOfACallThrowLeavesTheCall) {
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

TEST(ApiHppCallables, DisplacementIsACallable) {
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

TEST(ApiHppCallables, TexturesAreCallablesThatAreDroppedOnceAndMayThrow) {
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

TEST(ApiHppCallables, MeasurementsAreObjectsThatAreDroppedOnceAndMayThrow) {
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

TEST(ApiHppCallables, MaterialsAreObjectsThatAreDroppedOnceAndWhoseExceptionsAreCounted) {
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

TEST(ApiHppCallables, ExecutorsAndLogsAreCallablesThatAreDroppedOnce) {
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

}  // namespace bdpt_api::api_hpp_callables_test
