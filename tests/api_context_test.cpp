// Contexts: versions, threads, the log, and who must be told when all is over.
#include "api_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace bdpt_api::api_context_test {

void run_here(void*, uint32_t n, void (*body)(void*, uint32_t), void* user) {
  for (uint32_t i = 0; i < n; ++i) body(user, i);
}

// An executor and a log that count their drops.
struct Host {
  int executor_drops = 0, log_drops = 0;
  std::mutex mutex;
  std::vector<std::string> texts;
  std::vector<bdpt_log_level> levels;
  bdpt_executor executor = make<bdpt_executor>();
  bdpt_log log = make<bdpt_log>();
  bdpt_context_desc desc = make<bdpt_context_desc>();

  Host() {
    executor.worker_count = 1;
    executor.run = run_here;
    executor.user = this;
    executor.drop = [](void* user) { ++static_cast<Host*>(user)->executor_drops; };
    log.user = this;
    log.write = [](void* user, bdpt_log_level level, const char* text) {
      auto* host = static_cast<Host*>(user);
      const std::lock_guard lock(host->mutex);
      host->texts.push_back(text);
      host->levels.push_back(level);
    };
    log.drop = [](void* user) { ++static_cast<Host*>(user)->log_drops; };
    desc.executor = &executor;
    desc.log = &log;
  }
  bool wrote(const char* part) const {
    return std::any_of(texts.begin(), texts.end(),
                       [&](const std::string& t) { return t.find(part) != std::string::npos; });
  }
};

TEST(ApiContext, TellsItsVersions) {
  EXPECT_EQ(BDPT_ABI, bdpt_abi_version());
  EXPECT_LT(bdpt_version(), 0x01000000u);
  bdpt_context* context = reinterpret_cast<bdpt_context*>(uintptr_t(8));
  EXPECT_EQ(BDPT_ERROR_ABI, bdpt_context_create(BDPT_ABI + 1, nullptr, &context));
  EXPECT_EQ(nullptr, context);
}

TEST(ApiContext, EveryResultHasItsName) {
  EXPECT_STREQ("BDPT_OK", bdpt_result_name(BDPT_OK));
  EXPECT_STREQ("BDPT_CANCELLED", bdpt_result_name(BDPT_CANCELLED));
  EXPECT_STREQ("BDPT_ERROR_INTERNAL", bdpt_result_name(BDPT_ERROR_INTERNAL));
  for (int i = -13; i <= 1; ++i) EXPECT_STRNE("BDPT_ERROR_UNKNOWN", bdpt_result_name(i));
  EXPECT_STREQ("BDPT_ERROR_UNKNOWN", bdpt_result_name(-14));
  EXPECT_STREQ("BDPT_ERROR_UNKNOWN", bdpt_result_name(2));
}

TEST(ApiContext, EachThreadHasItsOwnLastError) {
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_cancel_create(nullptr));
  const std::string here = bdpt_last_error();
  EXPECT_EQ(0u, here.find("bdpt_cancel_create: "));
  std::thread([] { EXPECT_STREQ("", bdpt_last_error()); }).join();
  EXPECT_EQ(here, bdpt_last_error());
}

TEST(ApiContext, AnErrorTextIsCutBetweenCharacters) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  for (int shift = 0; shift < 4; ++shift) {
    std::string label(size_t(shift), 'x');
    for (int i = 0; i < 1000; ++i) label += "\xE2\x82\xAC";  // three bytes each
    bdpt_sphere_desc desc = make<bdpt_sphere_desc>();
    desc.label = label.c_str();
    bdpt_shape_id shape{};
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_sphere_add(builder.get(), &desc, &shape));
    const std::string text = bdpt_last_error();
    EXPECT_GT(text.size(), 900u);
    const size_t begin = text.find('\xE2');
    ASSERT_NE(std::string::npos, begin);
    EXPECT_EQ(0u, (text.size() - begin) % 3);
  }
}

TEST(ApiContext, DescriptionsAreChecked) {
  const auto refused = [](auto&& change) {
    Host host;
    change(host);
    bdpt_context* context = nullptr;
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_context_create(BDPT_ABI, &host.desc, &context)) << bdpt_last_error();
    EXPECT_EQ(nullptr, context);
    EXPECT_EQ(1, host.executor_drops);
    EXPECT_EQ(1, host.log_drops);
  };
  refused([](Host& h) { h.desc.threads = 4097; });
  refused([](Host& h) { h.desc.threads = 2; });  // beside an executor
  refused([](Host& h) { h.desc.isa = 5; });
  refused([](Host& h) { h.desc.isa = -1; });
  refused([](Host& h) { h.desc.reserved = 1; });
  refused([](Host& h) { h.executor.run = nullptr; });
  refused([](Host& h) { h.executor.worker_count = 0; });
  refused([](Host& h) { h.executor.worker_count = 1 << 30; });
  refused([](Host& h) { h.log.write = nullptr; });
  refused([](Host& h) { h.log.reserved = 1; });
  Host host;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_context_create(BDPT_ABI, &host.desc, nullptr));
  EXPECT_EQ(1, host.executor_drops);
  EXPECT_EQ(1, host.log_drops);
}

TEST(ApiContext, DropsAreCalledOnceWhenTheLastChildIsGone) {
  Host host;
  {
    World world(&host.desc);
    Render render = world.render();
    world.context.reset();
    world.builder.reset();
    world.scene.reset();
    world.sensor.reset();
    world.film.reset();
    EXPECT_OK(advance(render.get(), 1));
    EXPECT_EQ(0, host.executor_drops);
    EXPECT_EQ(0, host.log_drops);
  }
  EXPECT_EQ(1, host.executor_drops);
  EXPECT_EQ(1, host.log_drops);
}

TEST(ApiContext, HandlesMayBeReleasedInAnyOrder) {
  for (int order = 0; order < 24; ++order) {
    World world;
    int handles[4] = {0, 1, 2, 3};
    for (int i = 0; i < order; ++i) std::next_permutation(handles, handles + 4);
    for (const int handle : handles) {
      if (handle == 0) world.context.reset();
      if (handle == 1) world.builder.reset();
      if (handle == 2) world.scene.reset();
      if (handle == 3) world.film.reset(), world.sensor.reset();
    }
  }
}

TEST(ApiContext, ARetainedHandleOutlivesOneRelease) {
  const World world;
  bdpt_scene_retain(world.scene.get());
  bdpt_scene_release(world.scene.get());
  bdpt_film_retain(world.film.get());
  bdpt_film_release(world.film.get());
  bdpt_sensor_retain(world.sensor.get());
  bdpt_sensor_release(world.sensor.get());
  bdpt_context_retain(world.context.get());
  bdpt_context_release(world.context.get());
  const Render render = world.render();
  EXPECT_OK(advance(render.get(), 1));
}

TEST(ApiContext, TheLogTellsWhatIsNoError) {
  Host host;
  const Context context = make_context(&host.desc);
  const Builder builder = make_builder(context.get());
  const uint32_t indices[3][3] = {{0, 1, 2}, {1, 1, 2}, {0, 2, 3}};
  bdpt_mesh_desc mesh = square_desc();
  mesh.indices = view(indices, 3, BDPT_FORMAT_UINT32X3);
  bdpt_shape_id shape{};
  ASSERT_OK(bdpt_mesh_add(builder.get(), &mesh, &shape));
  EXPECT_TRUE(host.wrote("1 of 3 triangles"));
  EXPECT_TRUE(host.wrote("square"));
  add_instance(builder.get(), shape, add_grey(builder.get()));
  const Scene scene = build(builder.get());
  EXPECT_TRUE(host.wrote("the scene has no light and renders black"));
  EXPECT_EQ(std::vector<bdpt_log_level>(2, BDPT_LOG_WARNING), host.levels);

  const Sensor sensor = make_camera(context.get());
  const Film film = make_film(sensor.get());
  bdpt_render_desc desc = make<bdpt_render_desc>();
  make_render(scene.get(), sensor.get(), film.get(), &desc);
  desc.techniques[0] = desc.techniques[1] = ~0u;  // path tracing
  make_render(scene.get(), sensor.get(), film.get(), &desc);
  EXPECT_EQ(2u, host.texts.size());
  for (uint32_t& row : desc.techniques) row = 3;  // light tracing
  make_render(scene.get(), sensor.get(), film.get(), &desc);
  ASSERT_EQ(3u, host.texts.size());
  EXPECT_TRUE(host.wrote("t = 0"));
  EXPECT_EQ(BDPT_LOG_INFO, host.levels.back());
}

TEST(ApiContext, TellsThreadsAndMemory) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.threads = 3;
  const Context context = make_context(&desc);
  bdpt_context_info info = make<bdpt_context_info>();
  ASSERT_OK(bdpt_context_get_info(context.get(), &info));
  EXPECT_EQ(std::min(3u, std::thread::hardware_concurrency()), info.threads);  // never more than cores
  EXPECT_NE(BDPT_ISA_BEST, info.isa);
  EXPECT_GE(info.embree, 31300u);
  const uint64_t before = info.memory;
  {
    const Builder builder = make_builder(context.get());
    const Contents contents(builder.get());
    const Scene scene = build(builder.get());
    EXPECT_GT(memory_in_use(context.get()), before);
  }
  ASSERT_OK(bdpt_context_get_info(context.get(), &info));
  EXPECT_EQ(before, info.memory);
  EXPECT_GT(info.memory_peak, before);
}

TEST(ApiContext, TheMemoryLimitHolds) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.threads = 1;
  desc.memory_limit = uint64_t(8) << 20;
  const World world(&desc);
  const uint64_t before = memory_in_use(world.context.get());
  const Sensor large = make_camera(world.context.get(), camera_desc(1000, 1000));
  bdpt_film* film = nullptr;
  EXPECT_EQ(BDPT_ERROR_MEMORY_LIMIT, bdpt_film_create(large.get(), nullptr, &film));
  EXPECT_EQ(nullptr, film);
  const std::vector<float> texels(size_t(1024) * 1024 * 3);
  bdpt_texture_desc texture = make<bdpt_texture_desc>();
  texture.channels = 3, texture.width = texture.height = 1024, texture.pixels = texels.data(),
  texture.texel = BDPT_TEXEL_FLOAT;
  bdpt_texture_id id{};
  EXPECT_EQ(BDPT_ERROR_MEMORY_LIMIT, bdpt_texture_add(world.builder.get(), &texture, &id));
  EXPECT_EQ(before, memory_in_use(world.context.get()));
  bdpt_context_info info = make<bdpt_context_info>();
  ASSERT_OK(bdpt_context_get_info(world.context.get(), &info));
  EXPECT_LE(info.memory_peak, desc.memory_limit);
}

// A pool that is too large is refused, with the size of one that is not.
TEST(ApiContext, AtTheMemoryLimitAPoolThatFitsIsNamed) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.threads = 1;
  desc.memory_limit = uint64_t(64) << 20;
  World world(&desc);
  const Sensor sensor = make_camera(world.context.get(), camera_desc(256, 256));
  const Film film = make_film(sensor.get());
  const auto create = [&](uint32_t pixels, bdpt_render** render) {
    bdpt_render_desc d = make<bdpt_render_desc>();
    d.plan = "matrix", d.pool_pixels = pixels;
    return bdpt_render_create(world.scene.get(), sensor.get(), film.get(), &d, render);
  };
  bdpt_render* render = nullptr;
  ASSERT_EQ(BDPT_ERROR_MEMORY_LIMIT, create(65536, &render));
  const char* most = std::strstr(bdpt_last_error(), "at most ");
  ASSERT_NE(nullptr, most) << bdpt_last_error();
  const uint32_t pixels = uint32_t(std::atoi(most + 8));
  const uint32_t side = uint32_t(std::lround(std::sqrt(pixels)));
  EXPECT_EQ(side * side, pixels);
  EXPECT_EQ(BDPT_ERROR_MEMORY_LIMIT, create((side + 1) * (side + 1), &render));
  ASSERT_OK(create(pixels, &render));
  EXPECT_OK(advance(render, 8));
  bdpt_render_destroy(render);
  EXPECT_LE(info_of(world.context.get()).memory_peak, desc.memory_limit);
}

// Subpaths in a box that absorbs nothing need more than was booked for them.
TEST(ApiContext, AtTheMemoryLimitLongPathsAreNoSurprise) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.threads = 1;
  desc.memory_limit = uint64_t(16) << 20;
  const Context context = make_context(&desc);
  const Builder builder = make_builder(context.get());
  bdpt_material_desc white = grey_desc();
  for (float& v : white.reflectance) v = 1;
  for (float& v : white.emission) v = 1;
  white.emission_two_sided = 1;
  bdpt_material_id material{};
  ASSERT_OK(bdpt_material_add(builder.get(), &white, &material));
  add_instance(builder.get(), add_sphere(builder.get()), material, 100);
  const Scene scene = build(builder.get());
  const Sensor sensor = make_camera(context.get(), camera_desc(64, 64));
  const Film film = make_film(sensor.get());
  bdpt_render_desc d = make<bdpt_render_desc>();
  d.plan = "matrix", d.roulette_start = 40;
  bdpt_render* render = nullptr;
  ASSERT_OK(bdpt_render_create(scene.get(), sensor.get(), film.get(), &d, &render));
  EXPECT_EQ(BDPT_ERROR_MEMORY_LIMIT, advance(render, 8));
  bdpt_render_destroy(render);
  EXPECT_EQ(0u, info_of(film.get()).passes);
}

TEST(ApiContext, AtTheMemoryLimitASceneIsNotBuiltAndTheBuilderStaysAsItWas) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.threads = 1;
  uint64_t in_use = 0;
  {
    const Context context = make_context(&desc);
    const Builder builder = make_builder(context.get());
    const Contents contents(builder.get());
    in_use = memory_in_use(context.get());
  }
  bdpt_result result = BDPT_ERROR_MEMORY_LIMIT;
  for (uint64_t spare = 100; result != BDPT_OK; spare += spare / 8) {
    desc.memory_limit = in_use + spare;
    const Context context = make_context(&desc);
    const Builder builder = make_builder(context.get());
    const Contents contents(builder.get());
    bdpt_scene* scene = nullptr;
    result = bdpt_scene_build(builder.get(), nullptr, &scene);
    ASSERT_TRUE(result == BDPT_OK || result == BDPT_ERROR_MEMORY_LIMIT) << bdpt_last_error();
    EXPECT_TRUE(spare > 100 || result != BDPT_OK);
    bdpt_scene_release(scene);
    // Embree 4 does not take back one small allocation when the next is refused.
    EXPECT_LE(memory_in_use(context.get()), in_use + (info_of(context.get()).embree >= 40000 ? 64 : 0)) << spare;
  }
}

TEST(ApiContext, TwoContextsRenderAtOnceAndAlike) {
  std::vector<float> pictures[2];
  const auto render = [](std::vector<float>& picture) {
    const World world;
    const Render render = world.render();
    EXPECT_OK(advance(render.get(), 4));
    picture = pixels_of(world.film.get());
  };
  std::thread other([&] { render(pictures[1]); });
  render(pictures[0]);
  other.join();
  EXPECT_EQ(pictures[0], pictures[1]);
}

}  // namespace bdpt_api::api_context_test
