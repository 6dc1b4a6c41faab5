// The host's threads are the only ones, and whichever they are, the film is the same.
#include "api_scene.h"

#include <atomic>
#include <filesystem>
#include <iterator>
#include <thread>

namespace bdpt_api::api_executor_test {

size_t thread_count() {
  return size_t(
      std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator()));
}

struct Counter {
  std::atomic<uint64_t> bodies{0};
  size_t most_threads = 0;
};

void run_backwards(void* user, uint32_t n, void (*body)(void*, uint32_t), void* body_user) {
  auto* counter = static_cast<Counter*>(user);
  for (uint32_t i = n; i-- > 0; ++counter->bodies) body(body_user, i);
  counter->most_threads = std::max(counter->most_threads, thread_count());
}

void run_on_two_threads(void* user, uint32_t n, void (*body)(void*, uint32_t), void* body_user) {
  auto* counter = static_cast<Counter*>(user);
  std::atomic<uint32_t> next{0};
  const auto work = [&] {
    for (uint32_t i; (i = next++) < n; ++counter->bodies) body(body_user, i);
  };
  std::thread other(work);
  work();
  other.join();
}

std::vector<float> render_with(const bdpt_context_desc& desc) {
  const World world(&desc);
  const Render render = world.render();
  EXPECT_OK(advance(render.get(), 3));
  return pixels_of(world.film.get());
}

TEST(ApiExecutor, NoThreadIsStartedBesideTheHosts) {
  Counter counter;
  bdpt_executor executor = make<bdpt_executor>();
  executor.worker_count = 1;
  executor.run = run_backwards;
  executor.user = &counter;
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.executor = &executor;
  const size_t before = thread_count();
  const Context context = make_context(&desc);
  EXPECT_EQ(before, thread_count());
  // Large enough for the ray queries' builder to want help.
  constexpr int kSide = 300;
  std::vector<float> positions;
  std::vector<uint32_t> indices;
  for (int z = 0; z <= kSide; ++z)
    for (int x = 0; x <= kSide; ++x)
      positions.insert(positions.end(), {float(x), float((x * 7 + z * 13) % 5), float(z)});
  for (uint32_t z = 0; z < kSide; ++z)
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t a = z * (kSide + 1) + x, b = a + kSide + 1;
      indices.insert(indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  const Builder builder = make_builder(context.get());
  bdpt_mesh_desc mesh = make<bdpt_mesh_desc>();
  mesh.positions = view(positions.data(), positions.size() / 3, BDPT_FORMAT_FLOAT3);
  mesh.indices = view(indices.data(), indices.size() / 3, BDPT_FORMAT_UINT32X3);
  bdpt_shape_id shape{};
  ASSERT_OK(bdpt_mesh_add(builder.get(), &mesh, &shape));
  add_instance(builder.get(), shape, add_grey(builder.get(), 1));
  struct Watch {
    size_t most_threads = 0;
  } watch;
  bdpt_build_desc build_desc = make<bdpt_build_desc>();
  build_desc.user = &watch;
  build_desc.progress = [](void* user, const bdpt_progress*) {
    auto* w = static_cast<Watch*>(user);
    w->most_threads = std::max(w->most_threads, thread_count());
    return int32_t(0);
  };
  bdpt_scene* built = nullptr;
  ASSERT_OK(bdpt_scene_build(builder.get(), &build_desc, &built));
  const Scene scene(built);
  EXPECT_LE(watch.most_threads, before);
  EXPECT_LE(thread_count(), before);
  const Sensor sensor = make_camera(context.get());
  const Film film = make_film(sensor.get());
  const Render render = make_render(scene.get(), sensor.get(), film.get());
  ASSERT_OK(advance(render.get(), 2));
  EXPECT_GT(counter.bodies, 0u);
  EXPECT_LE(counter.most_threads, before);
  EXPECT_LE(thread_count(), before);
}

TEST(ApiExecutor, TheFilmIsTheSameOnAllThreads) {
  bdpt_context_desc own = make<bdpt_context_desc>();
  own.threads = 1;
  const std::vector<float> expected = render_with(own);
  own.threads = 4;
  EXPECT_EQ(expected, render_with(own));
  Counter counter;
  bdpt_executor executor = make<bdpt_executor>();
  executor.user = &counter;
  bdpt_context_desc hosted = make<bdpt_context_desc>();
  hosted.executor = &executor;
  executor.run = run_backwards;
  executor.worker_count = 1;
  EXPECT_EQ(expected, render_with(hosted));
  executor.run = run_on_two_threads;
  executor.worker_count = 2;
  EXPECT_EQ(expected, render_with(hosted));
  EXPECT_GT(counter.bodies, 0u);
}

}  // namespace bdpt_api::api_executor_test
