// Renders: what is refused, and what advance() tells.
#include "api_scene.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace bdpt_api::api_render_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class ApiRender : public testing::Test {
 protected:
  World world_;
};

TEST_F(ApiRender, DescriptionsAreChecked) {
  const auto try_render = [&](const std::function<void(bdpt_render_desc&)>& change) {
    bdpt_render_desc desc = make<bdpt_render_desc>();
    change(desc);
    bdpt_render* render = nullptr;
    const bdpt_result result =
        bdpt_render_create(world_.scene.get(), world_.sensor.get(), world_.film.get(), &desc, &render);
    EXPECT_EQ(result == BDPT_OK, render != nullptr);
    bdpt_render_destroy(render);
    return result;
  };
  const auto refused = [&](const std::function<void(bdpt_render_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_render(change)) << bdpt_last_error();
  };
  EXPECT_OK(try_render([](auto& d) { d.max_edges = 5, d.roulette_start = 1, d.block_size = 1; }));
  for (uint32_t i = 0; bdpt_plan_name(i); ++i) {
    EXPECT_OK(try_render([&](auto& d) { d.plan = bdpt_plan_name(i); })) << bdpt_plan_name(i);
    EXPECT_NE(nullptr, bdpt_plan_summary(i));
  }
  EXPECT_EQ(nullptr, bdpt_plan_name(~0u));
  EXPECT_EQ(nullptr, bdpt_plan_summary(~0u));
  EXPECT_OK(try_render([](auto& d) { d.max_edges = ~0u, d.roulette_start = ~0u, d.block_size = 65536; }));
  refused([](auto& d) { d.heuristic = 6; });
  refused([](auto& d) { d.heuristic = -1; });
  refused([](auto& d) { d.beta = -1; });
  refused([](auto& d) { d.beta = 65; });
  refused([](auto& d) { d.beta = kNan; });
  refused([](auto& d) { d.cutoff = 1.5f; });
  refused([](auto& d) { d.cutoff = kNan; });
  refused([](auto& d) { d.sampler = 3; });
  refused([](auto& d) { d.strata = 257; });
  refused([](auto& d) { d.light_start = 3; });
  EXPECT_OK(try_render([](auto& d) { d.light_start = BDPT_LIGHT_START_IMPORTANCE; }));
  refused([](auto& d) { d.block_size = 65537; });
  refused([](auto& d) { d.plan = "no such plan"; });
  refused([](auto& d) { d.connections = 2; });  // one-to-one does not choose
  refused([](auto& d) { d.plan = "two-way", d.connections = 2; });
  refused([](auto& d) { d.plan = "pooled", d.connections = 1025; });
  EXPECT_OK(try_render([](auto& d) { d.light_samples = 2; }));
  refused([](auto& d) { d.light_samples = 1025; });
  refused([](auto& d) { d.plan = "mmlt", d.light_samples = 2; });
  refused([](auto& d) { d.plan = "automatic", d.light_samples = 2; });
  refused([](auto& d) { d.plan = "mmlt", d.direct_samples = 2; });
  refused([](auto& d) { d.plan = "mmlt", d.direct_candidates = 2; });
  refused([](auto& d) { d.plan = "mmlt", d.light_selection = BDPT_LIGHT_SELECTION_EACH; });
  refused([](auto& d) { d.plan = "mmlt", d.shadow_roulette = BDPT_SHADOW_ROULETTE_EFFICIENCY; });
  refused([](auto& d) { d.plan = "mmlt", d.connections = 1; });
  refused([](auto& d) { d.pool_passes = 8; });
  refused([](auto& d) { d.plan = "matrix", d.pool_passes = 65; });
  refused([](auto& d) { d.plan = "matrix", d.first_pass = 4; });  // cuts through a pool
  EXPECT_OK(try_render([](auto& d) { d.plan = "pooled", d.pool_selection = BDPT_POOL_SELECTION_IMPORTANCE; }));
  refused([](auto& d) { d.plan = "pooled", d.pool_selection = 2; });
  refused([](auto& d) { d.pool_selection = BDPT_POOL_SELECTION_IMPORTANCE; });
  for (const char* plan : {"one-to-one", "pooled", "matrix", "combinatorial"})
    EXPECT_OK(try_render([=](auto& d) { d.plan = plan, d.correlation_aware = 1; }));
  refused([](auto& d) { d.correlation_aware = 2; });
  for (const char* plan : {"two-way", "mmlt", "automatic"})
    refused([=](auto& d) { d.plan = plan, d.correlation_aware = 1; });
  refused([](auto& d) { d.pool_pixels = 256; });
  refused([](auto& d) { d.plan = "mmlt", d.pool_pixels = 1024; });
  refused([](auto& d) { d.plan = "matrix", d.pool_pixels = 15; });
  refused([](auto& d) { d.plan = "matrix", d.pool_pixels = 65537; });
  EXPECT_OK(try_render([](auto& d) { d.plan = "matrix", d.pool_pixels = 1000, d.matrix = BDPT_MATRIX_ALL_LENGTHS; }));
  refused([](auto& d) { d.matrix = 2; });
  refused([](auto& d) { d.matrix = -1; });
  refused([](auto& d) { d.order = 3; });
  refused([](auto& d) { d.partners = 2; });
  EXPECT_OK(try_render([](auto& d) { d.shadow_roulette = BDPT_SHADOW_ROULETTE_EFFICIENCY; }));
  EXPECT_OK(try_render([](auto& d) { d.shadow_roulette = BDPT_SHADOW_ROULETTE_FIXED, d.shadow_threshold = 0.1f; }));
  refused([](auto& d) { d.shadow_roulette = 3; });
  refused([](auto& d) { d.shadow_threshold = 0.1f; });
  for (float threshold : {0.0f, -1.0f, kNan, std::numeric_limits<float>::infinity()})
    refused([=](auto& d) { d.shadow_roulette = BDPT_SHADOW_ROULETTE_FIXED, d.shadow_threshold = threshold; });
  for (uint32_t i = 0; bdpt_plan_name(i); ++i) {
    if (std::strcmp(bdpt_plan_name(i), "mmlt") == 0) continue;
    EXPECT_OK(try_render([&](auto& d) { d.plan = bdpt_plan_name(i), d.adaptive = BDPT_ADAPTIVE_TWO_STAGES; }));
  }
  refused([](auto& d) { d.adaptive = 2; });
  refused([](auto& d) { d.adaptive = -1; });
  refused([](auto& d) { d.plan = "mmlt", d.adaptive = BDPT_ADAPTIVE_TWO_STAGES; });
  refused([](auto& d) { d.reserved = 1; });
  refused([](auto& d) { d.light_selection = 4; });
  refused([](auto& d) { d.light_selection = -1; });
  refused([](auto& d) { d.direct_samples = 65; });
  refused([](auto& d) { d.direct_candidates = 65; });
  for (bdpt_light_selection s = BDPT_LIGHT_SELECTION_POWER; s <= BDPT_LIGHT_SELECTION_EACH; ++s)
    EXPECT_OK(try_render([&](auto& d) { d.light_selection = s, d.direct_samples = d.direct_candidates = 64; }));
  // Nothing that was refused holds the film.
  EXPECT_NE(nullptr, world_.render());
}

TEST_F(ApiRender, WhatDoesNotFitIsRefused) {
  bdpt_render* render = nullptr;
  const Sensor other_size = make_camera(world_.context.get(), camera_desc(10, 10));
  EXPECT_EQ(BDPT_ERROR_MISMATCH,
            bdpt_render_create(world_.scene.get(), other_size.get(), world_.film.get(), nullptr, &render));
  const World other;
  EXPECT_EQ(BDPT_ERROR_MISMATCH,
            bdpt_render_create(world_.scene.get(), other.sensor.get(), world_.film.get(), nullptr, &render));
  {
    const Render first = world_.render();
    ASSERT_OK(advance(first.get(), 1));
  }
  bdpt_render_desc desc = make<bdpt_render_desc>();
  desc.seed = 1;
  EXPECT_EQ(BDPT_ERROR_MISMATCH,
            bdpt_render_create(world_.scene.get(), world_.sensor.get(), world_.film.get(), &desc, &render));
  desc.seed = 0;
  desc.max_edges = 3;
  EXPECT_EQ(BDPT_ERROR_MISMATCH,
            bdpt_render_create(world_.scene.get(), world_.sensor.get(), world_.film.get(), &desc, &render));
  EXPECT_EQ(nullptr, render);
  ASSERT_OK(bdpt_instance_remove(world_.builder.get(), world_.contents.thing));
  const Scene changed = build(world_.builder.get());
  EXPECT_EQ(BDPT_ERROR_MISMATCH,
            bdpt_render_create(changed.get(), world_.sensor.get(), world_.film.get(), nullptr, &render));
}

TEST_F(ApiRender, AnAdvanceNeedsALimitThatItCanReach) {
  const Render render = world_.render();
  const auto refused = [&](const std::function<void(bdpt_advance_desc&)>& change, bdpt_render* r) {
    bdpt_advance_desc desc = passes(1);
    change(desc);
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_render_advance(r, &desc, nullptr)) << bdpt_last_error();
  };
  refused([](auto& d) { d.passes = 0; }, render.get());
  refused([](auto& d) { d.seconds = -1; }, render.get());
  refused([](auto& d) { d.seconds = std::numeric_limits<double>::infinity(); }, render.get());
  refused([](auto& d) { d.noise = kNan; }, render.get());
  refused([](auto& d) { d.reserved = 1; }, render.get());
  const bdpt_output_sink empty = make<bdpt_output_sink>();
  refused([&](auto& d) { d.sink = &empty; }, render.get());
  EXPECT_EQ(0u, info_of(world_.film.get()).passes);
  bdpt_film_desc one_group = make<bdpt_film_desc>();
  one_group.groups = 1;
  const Film film = make_film(world_.sensor.get(), &one_group);
  const Render blind = world_.render(film.get());
  refused([](auto& d) { d.noise = 0.1; }, blind.get());
}

TEST_F(ApiRender, EachLimitStopsAndTheReportSaysWhich) {
  const Render render = world_.render();
  bdpt_advance_report report = make<bdpt_advance_report>();
  bdpt_advance_desc desc = passes(3);
  ASSERT_OK(bdpt_render_advance(render.get(), &desc, &report));
  EXPECT_EQ(BDPT_STOP_PASSES, report.reason);
  EXPECT_EQ(3u, report.passes);
  EXPECT_EQ(3u, report.next_pass);
  EXPECT_EQ(-1, report.relative_error) << "nobody asked for it";
  desc = passes(0);
  desc.seconds = 1e-3;
  ASSERT_OK(bdpt_render_advance(render.get(), &desc, &report));
  EXPECT_EQ(BDPT_STOP_TIME, report.reason);
  EXPECT_GE(report.passes, 1u);
  desc.seconds = 0;
  desc.noise = 1e6;
  ASSERT_OK(bdpt_render_advance(render.get(), &desc, &report));
  EXPECT_EQ(BDPT_STOP_NOISE, report.reason);
  EXPECT_GT(report.relative_error, 0);
  EXPECT_EQ(report.relative_error, info_of(world_.film.get()).relative_error);
  bdpt_render_stats stats = make<bdpt_render_stats>();
  ASSERT_OK(bdpt_render_get_stats(render.get(), &stats));
  EXPECT_EQ(info_of(world_.film.get()).passes, stats.passes);
  EXPECT_EQ(stats.passes * 24 * 16, stats.samples);
  EXPECT_GT(stats.eye_rays, 0u);
  EXPECT_GT(stats.shadow_rays, 0u);
  EXPECT_GT(stats.seconds, 0);
}

TEST_F(ApiRender, APlanOfPoolsTakesItsPassesAtOnce) {
  bdpt_render_desc desc = make<bdpt_render_desc>();
  desc.plan = "matrix", desc.pool_passes = 4, desc.first_pass = 8;
  const Render render = world_.render(&desc);
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, advance(render.get(), 6));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "multiple of 4")) << bdpt_last_error();
  EXPECT_EQ(0u, info_of(world_.film.get()).passes);
  EXPECT_OK(advance(render.get(), 8));
  EXPECT_EQ(8u, info_of(world_.film.get()).passes);
  bdpt_render_stats stats = make<bdpt_render_stats>();
  ASSERT_OK(bdpt_render_get_stats(render.get(), &stats));
  EXPECT_EQ(8u, stats.passes);
  EXPECT_EQ(8u * 24 * 16, stats.samples);
}

TEST_F(ApiRender, OnlySoManyLightsTakeTurns) {
  bdpt_render_desc desc = make<bdpt_render_desc>();
  desc.light_selection = BDPT_LIGHT_SELECTION_EACH;
  bdpt_light_desc light = make<bdpt_light_desc>();
  light.type = BDPT_LIGHT_POINT;
  light.intensity[0] = 1;
  bdpt_light_id id{};
  for (int lights = 2; lights <= 65; ++lights) {  // the scene has one
    ASSERT_OK(bdpt_light_add(world_.builder.get(), &light, &id));
    if (lights < 64) continue;
    const Scene scene = build(world_.builder.get());
    bdpt_render* render = nullptr;
    EXPECT_EQ(lights == 64 ? BDPT_OK : BDPT_ERROR_INVALID_ARGUMENT,
              bdpt_render_create(scene.get(), world_.sensor.get(), world_.film.get(), &desc, &render));
    bdpt_render_destroy(render);
    ASSERT_OK(bdpt_film_clear(world_.film.get()));
  }
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "BDPT_LIGHT_SELECTION_TREE")) << bdpt_last_error();
}

// A pool over the context's limit is refused before any work.
// What the techniques did adds up to what the render did.
TEST_F(ApiRender, TechniquesAreCounted) {
  bdpt_render_desc desc = make<bdpt_render_desc>();
  desc.shadow_roulette = BDPT_SHADOW_ROULETTE_EFFICIENCY;
  bdpt_render* handle = nullptr;
  ASSERT_OK(bdpt_render_create(world_.scene.get(), world_.sensor.get(), world_.film.get(), &desc, &handle));
  const Render render(handle);
  bdpt_advance_desc advance = passes(4);
  ASSERT_OK(bdpt_render_advance(render.get(), &advance, nullptr));
  bdpt_render_stats stats = make<bdpt_render_stats>();
  ASSERT_OK(bdpt_render_get_stats(render.get(), &stats));
  uint64_t rays = 0, blocked = 0, skipped = 0;
  double energy = 0, squares = 0, seconds = 0;
  for (uint32_t s = 0; s < 32; ++s)
    for (uint32_t t = s < 2 ? 2 - s : 0; t < 32; ++t) {
      bdpt_technique_stats one = make<bdpt_technique_stats>();
      ASSERT_OK(bdpt_render_get_technique_stats(render.get(), s, t, &one)) << s << ' ' << t;
      if (s == 0 || t == 0) {
        EXPECT_EQ(0u, one.shadow_rays + one.contributions);
      }
      EXPECT_EQ(one.contributions, one.shadow_rays + one.shadow_rays_skipped);
      rays += one.shadow_rays, blocked += one.shadow_rays_blocked, skipped += one.shadow_rays_skipped;
      energy += one.energy, squares += one.squares, seconds += one.seconds;
    }
  EXPECT_EQ(stats.shadow_rays, rays);
  EXPECT_EQ(stats.shadow_rays_blocked, blocked);
  EXPECT_EQ(stats.shadow_rays_skipped, skipped);
  EXPECT_GT(skipped, 0u);
  EXPECT_NEAR(1, energy, 1e-9);
  EXPECT_NEAR(1, squares, 1e-9);
  EXPECT_NEAR(stats.seconds_connect + stats.seconds_shadow, seconds, 1e-9 + 0.01 * seconds);
  bdpt_technique_stats one = make<bdpt_technique_stats>();
  for (const auto& [s, t] : std::vector<std::pair<uint32_t, uint32_t>>{{0, 0}, {1, 0}, {0, 1}, {32, 2}, {2, 32}})
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_render_get_technique_stats(render.get(), s, t, &one)) << s << ' ' << t;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_render_get_technique_stats(nullptr, 1, 2, &one));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_render_get_technique_stats(render.get(), 1, 2, nullptr));
}

TEST(ApiRenderPool, OverTheMemoryLimitIsRefused) {
  const World free;
  const uint64_t used = memory_in_use(free.context.get());
  bdpt_context_desc limited = make<bdpt_context_desc>();
  limited.threads = 1;
  bdpt_render_desc desc = make<bdpt_render_desc>();
  desc.plan = "pooled", desc.light_samples = 64, desc.block_size = 1;
  limited.memory_limit = used + 2000000;
  const World world(&limited);
  bdpt_render* render = nullptr;
  EXPECT_EQ(BDPT_ERROR_MEMORY_LIMIT,
            bdpt_render_create(world.scene.get(), world.sensor.get(), world.film.get(), &desc, &render));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "pool of light subpaths")) << bdpt_last_error();
  desc.light_samples = 1;
  EXPECT_OK(bdpt_render_create(world.scene.get(), world.sensor.get(), world.film.get(), &desc, &render));
  bdpt_render_destroy(render);
}

TEST_F(ApiRender, ThePictureIsNotBlack) {
  const Render render = world_.render();
  ASSERT_OK(advance(render.get(), 4));
  double sum = 0;
  for (const float v : pixels_of(world_.film.get())) {
    ASSERT_TRUE(std::isfinite(v));
    sum += v;
  }
  EXPECT_GT(sum, 1);
}

TEST_F(ApiRender, NeitherBlockSizeNorHowItIsCutIntoCallsChangesABit) {
  const Render whole = world_.render();
  ASSERT_OK(advance(whole.get(), 4));
  const std::vector<float> expected = pixels_of(world_.film.get());
  for (const uint32_t block_size : {1u, 7u, 65536u}) {
    bdpt_render_desc desc = make<bdpt_render_desc>();
    desc.block_size = block_size;
    const Film film = world_.new_film();
    const Render render = world_.render(film.get(), &desc);
    for (int i = 0; i < 4; ++i) ASSERT_OK(advance(render.get(), 1));
    EXPECT_EQ(expected, pixels_of(film.get())) << block_size;
  }
}

}  // namespace bdpt_api::api_render_test
