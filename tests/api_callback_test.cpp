// Callbacks: when they come, what they may call, and what their return values do.
#include "api_scene.h"
#include "temp_folder.h"

#include <functional>
#include <stdexcept>
#include <thread>

namespace bdpt_api::api_callback_test {

using Progress = std::function<int32_t(const bdpt_progress&)>;

int32_t call_progress(void* user, const bdpt_progress* progress) { return (*static_cast<Progress*>(user))(*progress); }

// A sink that writes down what it was told.
struct Recorder {
  std::vector<std::string> events;
  std::vector<float> pixels;
  uint32_t width = 0;
  std::string fail_at;  // the event that answers 5
  bdpt_output_sink sink = make<bdpt_output_sink>();

  explicit Recorder(uint32_t every = 0) {
    sink.every = every;
    sink.user = this;
    sink.begin = [](void* user, uint32_t w, uint32_t h, uint64_t n) {
      auto* self = static_cast<Recorder*>(user);
      self->width = w;
      self->pixels.assign(size_t(w) * h * 3, -1);
      return self->tell("begin " + std::to_string(n));
    };
    sink.tile = [](void* user, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1, const float* p) {
      auto* self = static_cast<Recorder*>(user);
      for (uint32_t y = y0; y < y1; ++y)
        for (uint32_t i = x0 * 3; i < x1 * 3; ++i) self->pixels[size_t(y) * self->width * 3 + i] = *p++;
      return self->tell("tile");
    };
    sink.end = [](void* user, bdpt_result result) {
      static_cast<Recorder*>(user)->tell("end " + std::to_string(result));
    };
  }
  int32_t tell(const std::string& event) {
    events.push_back(event);
    return event == fail_at ? 5 : 0;
  }
};

class ApiCallback : public testing::Test {
 protected:
  World world_;

  bdpt_result advance_with(const Render& render, uint64_t n, Progress progress, bdpt_advance_report* report = nullptr) {
    bdpt_advance_desc desc = passes(n);
    desc.progress = call_progress;
    desc.progress_user = &progress;
    return bdpt_render_advance(render.get(), &desc, report);
  }
  bdpt_result build_with(Progress progress, bdpt_scene** scene) {
    bdpt_build_desc desc = make<bdpt_build_desc>();
    desc.progress = call_progress;
    desc.user = &progress;
    return bdpt_scene_build(world_.builder.get(), &desc, scene);
  }
};

TEST_F(ApiCallback, ProgressNeverFallsAndComesOnTheCallingThread) {
  const Render render = world_.render();
  const std::thread::id here = std::this_thread::get_id();
  double last = 0;
  int calls = 0;
  const auto check = [&](const bdpt_progress& p) {
    EXPECT_EQ(sizeof p, p.struct_size);
    EXPECT_EQ(here, std::this_thread::get_id());
    EXPECT_GE(p.fraction, last);
    EXPECT_LE(p.fraction, 1);
    last = p.fraction;
    ++calls;
    return 0;
  };
  EXPECT_OK(advance_with(render, 40, check));
  EXPECT_GE(calls, 2);
  EXPECT_EQ(1, last);
  last = calls = 0;
  bdpt_scene* scene = nullptr;
  EXPECT_OK(build_with(check, &scene));
  const Scene owner(scene);
  EXPECT_GE(calls, 2);
  EXPECT_EQ(1, last);
}

TEST_F(ApiCallback, AValueOtherThanZeroStopsTheCall) {
  Render render = world_.render();
  bdpt_advance_report report = make<bdpt_advance_report>();
  EXPECT_EQ(BDPT_ERROR_CALLBACK_FAILED, advance_with(
                                            render, 9, [](const bdpt_progress&) { return -77; }, &report));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "-77")) << bdpt_last_error();
  EXPECT_EQ(BDPT_STOP_CALLBACK, report.reason);
  bdpt_scene* scene = nullptr;
  for (const bool late : {false, true}) {
    EXPECT_EQ(BDPT_ERROR_CALLBACK_FAILED,
              build_with([&](const bdpt_progress& p) { return late && p.fraction < 1 ? 0 : 42; }, &scene));
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "42")) << bdpt_last_error();
    EXPECT_EQ(nullptr, scene);
  }
  EXPECT_NE(nullptr, build(world_.builder.get()));
  // And the render goes on as if nothing had been.
  EXPECT_OK(advance(render.get(), 3));
  const Film film = world_.new_film();
  const Render other = world_.render(film.get());
  EXPECT_OK(advance(other.get(), 3));
  EXPECT_EQ(pixels_of(film.get()), pixels_of(world_.film.get()));
}

TEST_F(ApiCallback, AnExceptionStopsTheCallToo) {
  const Render render = world_.render();
  const Progress thrower = [](const bdpt_progress&) -> int32_t { throw std::runtime_error("host"); };
  EXPECT_EQ(BDPT_ERROR_CALLBACK_FAILED, advance_with(render, 9, thrower));
  bdpt_scene* scene = nullptr;
  EXPECT_EQ(BDPT_ERROR_CALLBACK_FAILED, build_with(thrower, &scene));
  EXPECT_EQ(nullptr, scene);
  EXPECT_OK(advance(render.get(), 1));
}

TEST_F(ApiCallback, InsideAnAdvanceOnlyWhatSaysSoMayBeCalled) {
  const Film other = world_.new_film();
  const Render render = world_.render();
  const bdpt::TempFolder folder;
  bool called = false;
  const auto reentrant = [](bdpt_result result) { EXPECT_EQ(BDPT_ERROR_REENTRANT, result) << bdpt_last_error(); };
  const Progress progress = [&](const bdpt_progress&) {
    if (called) return 0;
    called = true;
    bdpt_film* film = world_.film.get();
    reentrant(advance(render.get(), 1));
    reentrant(bdpt_film_clear(film));
    reentrant(bdpt_film_merge(film, other.get()));
    reentrant(bdpt_film_merge(other.get(), film));
    bdpt_render* second = nullptr;
    reentrant(bdpt_render_create(world_.scene.get(), world_.sensor.get(), film, nullptr, &second));
    bdpt_render_destroy(render.get());  // is refused, without a result to say so

    bdpt_render_stats stats = make<bdpt_render_stats>();
    EXPECT_OK(bdpt_render_get_stats(render.get(), &stats));
    pixels_of(film);
    std::vector<float> pixels(24 * 16 * 3);
    bdpt_read_desc read = make<bdpt_read_desc>();
    read.include_partial = 1;
    EXPECT_OK(bdpt_film_read(film, &read, pixels.data(), pixels.size() * sizeof(float)));
    EXPECT_OK(bdpt_film_save(film, folder.file("film").c_str()));
    scene_hash(world_.scene.get());
    memory_in_use(world_.context.get());
    bdpt_film_retain(film);
    bdpt_film_release(film);
    // Objects that are not in use are free for all.
    const Contents more(make_builder(world_.context.get()).get());
    const Scene scene = build(world_.builder.get());
    const Render inner = make_render(scene.get(), world_.sensor.get(), other.get());
    EXPECT_OK(advance(inner.get(), 1));
    return 0;
  };
  EXPECT_OK(advance_with(render, 2, progress));
  EXPECT_TRUE(called);
  EXPECT_EQ(2u, info_of(world_.film.get()).passes);
  EXPECT_OK(advance(render.get(), 1));
}

TEST_F(ApiCallback, InsideABuildTheBuilderIsClosed) {
  bdpt_builder* b = world_.builder.get();
  const Contents& c = world_.contents;
  const uint64_t before = scene_hash(world_.scene.get());
  const Progress progress = [&](const bdpt_progress&) {
    const auto reentrant = [](bdpt_result result) { EXPECT_EQ(BDPT_ERROR_REENTRANT, result) << bdpt_last_error(); };
    const bdpt_mesh_desc mesh = square_desc();
    const bdpt_sphere_desc sphere = make<bdpt_sphere_desc>();
    const bdpt_texture_desc texture = make<bdpt_texture_desc>();
    const bdpt_material_desc material = grey_desc();
    const bdpt_medium_desc medium = make<bdpt_medium_desc>();
    const bdpt_light_desc light = make<bdpt_light_desc>();
    const bdpt_instance_desc instance = instance_desc(c.square, c.grey);
    bdpt_shape_id shape{};
    bdpt_texture_id texture_id{};
    bdpt_material_id material_id{};
    bdpt_medium_id medium_id{};
    bdpt_light_id light_id{};
    bdpt_instance_id instance_id{};
    bdpt_scene* scene = nullptr;
    reentrant(bdpt_mesh_add(b, &mesh, &shape));
    reentrant(bdpt_sphere_add(b, &sphere, &shape));
    reentrant(bdpt_shape_remove(b, c.ball));
    reentrant(bdpt_texture_add(b, &texture, &texture_id));
    const bdpt_host_texture_desc pattern = make<bdpt_host_texture_desc>();
    reentrant(bdpt_host_texture_add(b, &pattern, &texture_id));
    reentrant(bdpt_texture_remove(b, texture_id));
    reentrant(bdpt_material_add(b, &material, &material_id));
    reentrant(bdpt_material_update(b, c.grey, &material));
    reentrant(bdpt_material_remove(b, c.grey));
    reentrant(bdpt_medium_add(b, &medium, &medium_id));
    reentrant(bdpt_medium_update(b, medium_id, &medium));
    reentrant(bdpt_medium_remove(b, medium_id));
    reentrant(bdpt_light_add(b, &light, &light_id));
    reentrant(bdpt_light_update(b, light_id, &light));
    reentrant(bdpt_light_remove(b, light_id));
    reentrant(bdpt_instance_add(b, &instance, &instance_id));
    reentrant(bdpt_instance_update(b, c.floor, &instance));
    reentrant(bdpt_instance_remove(b, c.thing));
    reentrant(bdpt_scene_build(b, nullptr, &scene));
    bdpt_builder_destroy(b);  // is refused, without a result to say so
    return 0;
  };
  bdpt_scene* scene = nullptr;
  ASSERT_OK(build_with(progress, &scene));
  EXPECT_EQ(before, scene_hash(Scene(scene).get()));
  EXPECT_EQ(before, scene_hash(build(b).get()));
}

TEST_F(ApiCallback, ASinkGetsBeginThenEveryPixelOnceThenEnd) {
  const Sensor sensor = make_camera(world_.context.get(), camera_desc(130, 70));
  const Film film = make_film(sensor.get());
  const Render render = make_render(world_.scene.get(), sensor.get(), film.get());
  Recorder recorder(2);
  bdpt_advance_desc desc = passes(5);
  desc.sink = &recorder.sink;
  ASSERT_OK(bdpt_render_advance(render.get(), &desc, nullptr));
  std::vector<std::string> expected;
  for (const char* n : {"2", "4", "5"}) {
    expected.push_back(std::string("begin ") + n);
    expected.insert(expected.end(), 6, "tile");  // 3 x 2 of 64 x 64
    expected.push_back("end 0");
  }
  EXPECT_EQ(expected, recorder.events);
  EXPECT_EQ(pixels_of(film.get()), recorder.pixels);
}

TEST_F(ApiCallback, AnImageIsNotSentTwice) {
  const Render render = world_.render();
  Recorder recorder(2);
  bdpt_advance_desc desc = passes(4);
  desc.sink = &recorder.sink;
  ASSERT_OK(bdpt_render_advance(render.get(), &desc, nullptr));
  EXPECT_EQ((std::vector<std::string>{"begin 2", "tile", "end 0", "begin 4", "tile", "end 0"}), recorder.events);
}

TEST_F(ApiCallback, ASinkThatFailsStopsTheCallAndIsEnded) {
  for (const char* where : {"begin 1", "tile"})
    for (const uint32_t every : {0u, 1u}) {
      const Film film = world_.new_film();
      const Render render = world_.render(film.get());
      Recorder recorder(every);
      recorder.fail_at = where;
      bdpt_advance_desc desc = passes(1);
      desc.sink = &recorder.sink;
      bdpt_advance_report report = make<bdpt_advance_report>();
      EXPECT_EQ(BDPT_ERROR_CALLBACK_FAILED, bdpt_render_advance(render.get(), &desc, &report));
      EXPECT_EQ(BDPT_STOP_CALLBACK, report.reason);
      EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "5")) << bdpt_last_error();
      EXPECT_EQ("end " + std::to_string(BDPT_ERROR_CALLBACK_FAILED), recorder.events.back());
      EXPECT_EQ(1u, info_of(film.get()).passes);
    }
}

TEST_F(ApiCallback, AFailedProgressIsFollowedByNoOutput) {
  const Render render = world_.render();
  Recorder recorder;
  Progress progress = [](const bdpt_progress&) { return 1; };
  bdpt_advance_desc desc = passes(3);
  desc.sink = &recorder.sink;
  desc.progress = call_progress;
  desc.progress_user = &progress;
  EXPECT_EQ(BDPT_ERROR_CALLBACK_FAILED, bdpt_render_advance(render.get(), &desc, nullptr));
  EXPECT_TRUE(recorder.events.empty());
}

TEST_F(ApiCallback, BeginAndEndMayBeLeftOut) {
  const Render render = world_.render();
  Recorder recorder;
  recorder.width = 24;
  recorder.pixels.resize(24 * 16 * 3);
  recorder.sink.begin = nullptr;
  recorder.sink.end = nullptr;
  bdpt_advance_desc desc = passes(1);
  desc.sink = &recorder.sink;
  ASSERT_OK(bdpt_render_advance(render.get(), &desc, nullptr));
  EXPECT_EQ(pixels_of(world_.film.get()), recorder.pixels);
}

}  // namespace bdpt_api::api_callback_test
