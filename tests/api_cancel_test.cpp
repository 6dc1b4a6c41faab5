// A render that was cancelled goes on as if it had not been.
#include "api_scene.h"
#include "temp_folder.h"

#include <csignal>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

namespace bdpt_api::api_cancel_test {

std::string file_of(const bdpt_film* film) {
  const bdpt::TempFolder folder;
  EXPECT_OK(bdpt_film_save(film, folder.file("film").c_str()));
  std::ifstream file(folder.file("film"), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// An executor that asks for a stop after so many bodies.
struct Stopper {
  bdpt_cancel* cancel = nullptr;
  uint64_t bodies_left = 0;
  static void run(void* user, uint32_t n, void (*body)(void*, uint32_t), void* body_user) {
    auto* self = static_cast<Stopper*>(user);
    for (uint32_t i = 0; i < n; ++i) {
      if (self->bodies_left > 0 && --self->bodies_left == 0) bdpt_cancel_request(self->cancel);
      body(body_user, i);
    }
  }
};

TEST(ApiCancel, AtAnyBlockTheFilmIsInTheEndTheSame) {
  constexpr uint64_t kPasses = 3;
  bdpt_render_desc small_blocks = make<bdpt_render_desc>();
  small_blocks.block_size = 16;
  std::string expected;
  {
    const World world;
    const Render render = world.render(&small_blocks);
    ASSERT_OK(advance(render.get(), kPasses));
    expected = file_of(world.film.get());
  }
  const Cancel cancel = make_cancel();
  Stopper stopper{cancel.get()};
  bdpt_executor executor = make<bdpt_executor>();
  executor.worker_count = 1;
  executor.run = Stopper::run;
  executor.user = &stopper;
  bdpt_context_desc context_desc = make<bdpt_context_desc>();
  context_desc.executor = &executor;
  const World world(&context_desc);
  std::mt19937 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Film film = world.new_film();
    const Render render = world.render(film.get(), &small_blocks);
    int cancels = 0;
    while (info_of(film.get()).passes < kPasses) {
      bdpt_cancel_reset(cancel.get());
      stopper.bodies_left = 1 + random() % 60;
      bdpt_advance_desc desc = passes(kPasses - info_of(film.get()).passes);
      desc.cancel = cancel.get();
      bdpt_advance_report report = make<bdpt_advance_report>();
      const bdpt_result result = bdpt_render_advance(render.get(), &desc, &report);
      ASSERT_TRUE(result == BDPT_OK || result == BDPT_CANCELLED) << bdpt_last_error();
      if (result == BDPT_CANCELLED) {
        ++cancels;
        EXPECT_EQ(BDPT_STOP_CANCELLED, report.reason);
        EXPECT_EQ(info_of(film.get()).next_pass, report.next_pass);
      }
    }
    EXPECT_GT(cancels, 0);
    ASSERT_EQ(expected, file_of(film.get())) << "after " << cancels << " cancels";
  }
}

TEST(ApiCancel, FromAnotherThreadTheFilmIsInTheEndTheSame) {
  constexpr uint64_t kPasses = 20;
  const World world;
  const Render whole = world.render();
  ASSERT_OK(advance(whole.get(), kPasses));
  const std::string expected = file_of(world.film.get());
  const Film film = world.new_film();
  const Render render = world.render(film.get());
  const Cancel cancel = make_cancel();
  std::mt19937 random(2);
  for (int calls = 0; info_of(film.get()).passes < kPasses; ++calls) {
    bdpt_cancel_reset(cancel.get());
    bdpt_advance_desc desc = passes(kPasses - info_of(film.get()).passes);
    desc.cancel = cancel.get();
    std::thread stopper([&, delay = random() % 20000] {
      std::this_thread::sleep_for(std::chrono::microseconds(delay));
      bdpt_cancel_request(cancel.get());
    });
    const bdpt_result result = bdpt_render_advance(render.get(), &desc, nullptr);
    stopper.join();
    ASSERT_TRUE(result == BDPT_OK || result == BDPT_CANCELLED) << bdpt_last_error();
    ASSERT_LT(calls, 10000);
  }
  EXPECT_EQ(expected, file_of(film.get()));
}

TEST(ApiCancel, AnInterruptedPassShowsOnlyWhereItIsAskedFor) {
  const Cancel cancel = make_cancel();
  Stopper stopper{cancel.get(), 20};
  bdpt_executor executor = make<bdpt_executor>();
  executor.worker_count = 1;
  executor.run = Stopper::run;
  executor.user = &stopper;
  bdpt_context_desc context_desc = make<bdpt_context_desc>();
  context_desc.executor = &executor;
  const World world(&context_desc);
  stopper.bodies_left = 12;
  bdpt_render_desc small_blocks = make<bdpt_render_desc>();
  small_blocks.block_size = 16;
  Render render = world.render(&small_blocks);
  bdpt_advance_desc desc = passes(1);
  desc.cancel = cancel.get();
  ASSERT_EQ(BDPT_CANCELLED, bdpt_render_advance(render.get(), &desc, nullptr));
  const std::vector<float> black(24 * 16 * 3);
  EXPECT_EQ(black, pixels_of(world.film.get()));
  bdpt_read_desc read = make<bdpt_read_desc>();
  read.include_partial = 1;
  std::vector<float> pixels(black.size());
  ASSERT_OK(bdpt_film_read(world.film.get(), &read, pixels.data(), pixels.size() * sizeof(float)));
  EXPECT_NE(black, pixels);
  render.reset();
  ASSERT_OK(bdpt_film_read(world.film.get(), &read, pixels.data(), pixels.size() * sizeof(float)));
  EXPECT_EQ(black, pixels);
}

bdpt_cancel* signalled = nullptr;

TEST(ApiCancel, ASignalHandlerMayAskForIt) {
  const World world;
  const Cancel cancel = make_cancel();
  signalled = cancel.get();
  const auto old = std::signal(SIGUSR1, [](int) { bdpt_cancel_request(signalled); });
  const Render render = world.render();
  bdpt_advance_desc desc = passes(~uint64_t(0));
  desc.cancel = cancel.get();
  std::thread sender([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::raise(SIGUSR1);
  });
  EXPECT_EQ(BDPT_CANCELLED, bdpt_render_advance(render.get(), &desc, nullptr));
  sender.join();
  std::signal(SIGUSR1, old);
  EXPECT_EQ(1u, bdpt_cancel_is_requested(cancel.get()));
  bdpt_cancel_reset(cancel.get());
  EXPECT_EQ(0u, bdpt_cancel_is_requested(cancel.get()));
}

TEST(ApiCancel, ARequestedTokenStopsACallBeforeItBegins) {
  const World world;
  const Cancel cancel = make_cancel();
  bdpt_cancel_request(cancel.get());
  bdpt_build_desc build_desc = make<bdpt_build_desc>();
  build_desc.cancel = cancel.get();
  bdpt_scene* scene = reinterpret_cast<bdpt_scene*>(uintptr_t(8));
  EXPECT_EQ(BDPT_CANCELLED, bdpt_scene_build(world.builder.get(), &build_desc, &scene));
  EXPECT_EQ(nullptr, scene);
  EXPECT_NE(nullptr, build(world.builder.get()));
  const Render render = world.render();
  bdpt_advance_desc desc = passes(5);
  desc.cancel = cancel.get();
  EXPECT_EQ(BDPT_CANCELLED, bdpt_render_advance(render.get(), &desc, nullptr));
  EXPECT_EQ(0u, info_of(world.film.get()).passes);
}

TEST(ApiCancel, ATokenMayBeReleasedInsideTheCallThatHoldsIt) {
  const World world;
  const Render render = world.render();
  bdpt_advance_desc desc = passes(2);
  Cancel cancel = make_cancel();
  desc.cancel = cancel.get();
  desc.progress_user = &cancel;
  desc.progress = [](void* user, const bdpt_progress*) {
    static_cast<Cancel*>(user)->reset();
    return int32_t(0);
  };
  EXPECT_OK(bdpt_render_advance(render.get(), &desc, nullptr));
  EXPECT_EQ(nullptr, cancel);
}

}  // namespace bdpt_api::api_cancel_test
