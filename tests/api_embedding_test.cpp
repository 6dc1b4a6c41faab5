// What a host can rely on for its process: signals, floating-point mode, output, forks, exit. See docs/embedding.md.
#include "api_scene.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace bdpt_api::api_embedding_test {

size_t thread_count() {
  return size_t(
      std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator()));
}

void render_once(bdpt_progress_fn progress = nullptr, void* user = nullptr) {
  const World world;
  bdpt_build_desc build_desc = make<bdpt_build_desc>();
  build_desc.progress = progress;
  build_desc.user = user;
  bdpt_scene* scene = nullptr;
  EXPECT_OK(bdpt_scene_build(world.builder.get(), &build_desc, &scene));
  const Scene owner(scene);
  const Render render = world.render();
  bdpt_advance_desc desc = passes(4);
  desc.progress = progress;
  desc.progress_user = user;
  EXPECT_OK(bdpt_render_advance(render.get(), &desc, nullptr));
}

// Runs body in a child that must end with 0.
void in_child(const std::function<void()>& body) {
  std::fflush(nullptr);
  const pid_t child = fork();
  ASSERT_NE(-1, child);
  if (child == 0) {
    alarm(100);
    body();
    _exit(testing::Test::HasFailure() ? 1 : 0);
  }
  int status = -1;
  ASSERT_EQ(child, waitpid(child, &status, 0));
  EXPECT_EQ(0, status);
}

#if defined(__SSE2__)
struct ModesSeen {
  std::atomic<int> calls{0}, others{0};
  void look() {
    ++calls;
    if ((_mm_getcsr() & ~0x3fu) != 0x1f80u) ++others;  // but for the flags of what has happened
  }
};

TEST(ApiEmbedding, FunctionsOfTheHostsRunInTheFloatingPointModeInWhichProgramsStart) {
  ModesSeen texture, material, start, respond;
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  const Contents contents(builder.get());

  bdpt_host_texture_desc pattern = make<bdpt_host_texture_desc>();
  pattern.user = &texture;
  pattern.look_up = [](void* user, uint32_t count, const bdpt_texture_place*, float(*colors)[4]) {
    static_cast<ModesSeen*>(user)->look();
    for (uint32_t i = 0; i < count; ++i) std::fill_n(colors[i], 4, 0.5f);
    return int32_t(0);
  };
  bdpt_texture_use use = make<bdpt_texture_use>();
  ASSERT_OK(bdpt_host_texture_add(builder.get(), &pattern, &use.texture));
  bdpt_host_material host = make<bdpt_host_material>();
  host.user = &material;
  host.evaluate = [](void* user, const bdpt_scattering_place* place, const float next[3], bdpt_scattering_value* v) {
    static_cast<ModesSeen*>(user)->look();
    v->f[0] = v->f[1] = v->f[2] = 0.1f * place->reflectance[0];
    v->density = std::fabs(next[2]) / float(M_PI);
    v->density_reverse = std::fabs(place->previous[2]) / float(M_PI);
    return int32_t(0);
  };
  host.sample = [](void* user, const bdpt_scattering_place* place, const float u[3], float next[3]) {
    static_cast<ModesSeen*>(user)->look();
    const float r = std::sqrt(u[0]), phi = float(2 * M_PI) * u[1];
    next[0] = r * std::cos(phi), next[1] = r * std::sin(phi);
    next[2] = std::copysign(std::sqrt(1 - u[0]), place->previous[2]);
    return int32_t(0);
  };
  bdpt_material_desc desc = make<bdpt_material_desc>();
  desc.type = BDPT_MATERIAL_HOST;
  for (float& v : desc.reflectance) v = 1;
  desc.host = &host;
  desc.textures = &use, desc.texture_count = 1;
  ASSERT_OK(bdpt_material_update(builder.get(), contents.grey, &desc));
  const Scene scene = build(builder.get());

  const Sensor camera = make_camera(context.get());
  const Film film = make_film(camera.get());
  const Render render = make_render(scene.get(), camera.get(), film.get());
  const bdpt_advance_desc advance = passes(2);
  ASSERT_OK(bdpt_render_advance(render.get(), &advance, nullptr));

  struct Both {
    ModesSeen *start, *respond;
  } both{&start, &respond};
  bdpt_custom_desc custom = make<bdpt_custom_desc>();
  custom.measurements = 16;
  custom.user = &both;
  custom.start = [](void* user, uint32_t n, const uint64_t*, const float(*)[4], bdpt_measurement_start* starts) {
    static_cast<Both*>(user)->start->look();
    for (uint32_t i = 0; i < n; ++i) {
      starts[i].position[0] = starts[i].position[1] = 1.2f, starts[i].direction[1] = -1;  // down to the floor
      starts[i].weight = starts[i].density_position = starts[i].density_direction = 1;
    }
    return int32_t(0);
  };
  custom.respond = [](void* user, uint32_t n, const bdpt_measurement_place*, float* responses) {
    static_cast<Both*>(user)->respond->look();
    std::fill_n(responses, n, 1.0f);
    return int32_t(0);
  };
  bdpt_sensor* created = nullptr;
  ASSERT_OK(bdpt_custom_create(context.get(), &custom, &created));
  const Sensor sensor(created);
  const Film measured = make_film(sensor.get());
  const Render measuring = make_render(scene.get(), sensor.get(), measured.get());
  ASSERT_OK(bdpt_render_advance(measuring.get(), &advance, nullptr));

  for (const ModesSeen* seen : {&texture, &material, &start, &respond}) {
    EXPECT_GT(seen->calls, 0);
    EXPECT_EQ(0, seen->others);
  }
}

TEST(ApiEmbedding, TheCallersFloatingPointModeIsItsOwnAlsoInsideCallbacks) {
  const unsigned before = _mm_getcsr();
  for (const unsigned mode : {0x1f80u, 0x3f80u, 0x9fc0u}) {  // as it is, rounding down, and with FTZ and DAZ
    _mm_setcsr(mode);
    struct Seen {
      unsigned mode, others = 0, calls = 0;
    } seen{mode};
    render_once(
        [](void* user, const bdpt_progress*) -> int32_t {
          auto* s = static_cast<Seen*>(user);
          ++s->calls;
          if ((_mm_getcsr() ^ s->mode) & ~0x3fu) ++s->others;  // but for flags that tell what has happened
          return 0;
        },
        &seen);
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    EXPECT_GE(seen.calls, 4u);
    EXPECT_EQ(0u, seen.others);
    EXPECT_EQ(mode & ~0x3fu, after & ~0x3fu);
  }
}
#endif

TEST(ApiEmbedding, NoSignalHandlerIsTouched) {
  struct sigaction before[32] = {}, after{};
  for (int i = 1; i < 32; ++i) sigaction(i, nullptr, &before[i]);
  render_once();
  for (int i = 1; i < 32; ++i) {
    sigaction(i, nullptr, &after);
    EXPECT_EQ(before[i].sa_handler, after.sa_handler) << i;
    EXPECT_EQ(before[i].sa_flags, after.sa_flags) << i;
  }
}

TEST(ApiEmbedding, NothingIsWrittenToTheTerminal) {
  for (const int stream : {1, 2}) {
    FILE* file = std::tmpfile();
    ASSERT_NE(nullptr, file);
    std::fflush(nullptr);
    const int kept = dup(stream);
    dup2(fileno(file), stream);
    {
      render_once();
      const Context context = make_context();
      bdpt_builder* none = nullptr;
      const bdpt_result result = bdpt_builder_create(nullptr, &none);  // an error
      const Builder dark = make_builder(context.get());                // and a warning, for which there is no log
      add_instance(dark.get(), add_square(dark.get()), add_grey(dark.get()));
      build(dark.get());
      std::fflush(nullptr);
      dup2(kept, stream);
      EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result);
    }
    close(kept);
    std::fseek(file, 0, SEEK_END);
    EXPECT_EQ(0, std::ftell(file)) << stream;
    std::fclose(file);
  }
}

TEST(ApiEmbedding, OneThreadIsTheCallersOwn) {
  in_child([] {
    bdpt_context_desc desc = make<bdpt_context_desc>();
    desc.threads = 1;
    const size_t before = thread_count();
    const World world(&desc);
    EXPECT_OK(advance(world.render().get(), 2));
    EXPECT_EQ(before, thread_count());
  });
}

// With threads of the library's that are idle; the child has none of them.
TEST(ApiEmbedding, AChildThatWasForkedWhileAllIsQuietGoesOnAlone) {
  const World world;
  EXPECT_OK(advance(world.render().get(), 2));
  const std::vector<float> two = pixels_of(world.film.get());
  in_child([&] {
    EXPECT_EQ(1u, thread_count());
    EXPECT_OK(advance(world.render().get(), 2));  // of the parent's context
    const World own;
    EXPECT_OK(advance(own.render().get(), 2));
    EXPECT_EQ(two, pixels_of(own.film.get()));
  });
  EXPECT_OK(advance(world.render().get(), 2));
  EXPECT_EQ(4u, info_of(world.film.get()).passes);
}

// By return from main, with all handles and the library's threads alive.
TEST(ApiEmbedding, AProcessMayExitWithHandlesAlive) {
  std::fflush(nullptr);
  const pid_t child = fork();
  ASSERT_NE(-1, child);
  if (child == 0) {
    alarm(100);
    auto* world = new World;
    auto* render = new Render(world->render());
    const bool done = advance(render->get(), 2) == BDPT_OK;
    std::fclose(stdout);  // what it would tell of tests again
    std::exit(done ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(child, waitpid(child, &status, 0));
  EXPECT_EQ(0, status);
}

}  // namespace bdpt_api::api_embedding_test
