// Textures of the host's by the C ABI: what is refused, and what becomes of a function that fails.
#include "api_builder.h"

#include <atomic>
#include <cmath>

namespace bdpt_api::api_host_texture_test {

// A function, what goes wrong in it, and what it saw.
struct Pattern {
  enum class Fault { None, Error, Throw, Nan, Unset, Stop } fault = Fault::None;
  std::function<void()> inside;
  std::atomic<uint64_t> calls{0}, lookups{0};
  std::atomic<int> dropped{0};
};

float square(const bdpt_texture_place& place) {
  const auto cell = [](float v) { return int(std::floor(v * 4)); };
  return (cell(place.uv[0]) + cell(place.uv[1])) % 2 ? 0.9f : 0.3f;
}

int32_t look_up(void* user, uint32_t count, const bdpt_texture_place* places, float (*colors)[4]) {
  Pattern& p = *static_cast<Pattern*>(user);
  ++p.calls;
  p.lookups += count;
  EXPECT_GT(count, 0u);
  if (p.inside) p.inside();
  if (p.fault == Pattern::Fault::Error) return 42;
  if (p.fault == Pattern::Fault::Throw) throw 7;
  for (uint32_t i = 0; i < count; ++i) {
    EXPECT_NE(0u, places[i].instance.id);
    if (p.fault == Pattern::Fault::Unset) continue;
    const float v = square(places[i]);
    for (int c = 0; c < 4; ++c) colors[i][c] = v;
    if (p.fault == Pattern::Fault::Nan) colors[i][1] = kNan;
  }
  return 0;
}

bdpt_host_texture_desc pattern_desc(Pattern& pattern) {
  bdpt_host_texture_desc desc = make<bdpt_host_texture_desc>();
  desc.label = "squares";
  desc.look_up = look_up;
  desc.user = &pattern;
  desc.drop = [](void* user) { ++static_cast<Pattern*>(user)->dropped; };
  return desc;
}

// The world with squares on its floor, the function's or an image's.
class ApiHostTexture : public BuilderTest {
 protected:
  Pattern pattern_;

  bdpt_result try_pattern(const std::function<void(bdpt_host_texture_desc&)>& change) {
    bdpt_host_texture_desc desc = pattern_desc(pattern_);
    change(desc);
    bdpt_texture_id id{7};
    const bdpt_result result = bdpt_host_texture_add(b_, &desc, &id);
    EXPECT_EQ(result == BDPT_OK, id.id != 0);
    return result;
  }
  bdpt_texture_id add_pattern() {
    const bdpt_host_texture_desc desc = pattern_desc(pattern_);
    bdpt_texture_id id{};
    EXPECT_OK(bdpt_host_texture_add(b_, &desc, &id));
    return id;
  }
  bdpt_texture_id add_image() {
    float texels[16];
    for (int i = 0; i < 16; ++i) texels[i] = (i % 4 + i / 4) % 2 ? 0.3f : 0.9f;  // row 0 is v = 1
    bdpt_texture_desc desc = texture_desc(texels, 4, 4);
    desc.channels = 1, desc.texel = BDPT_TEXEL_FLOAT, desc.encoding = BDPT_ENCODING_LINEAR;
    bdpt_texture_id id{};
    EXPECT_OK(bdpt_texture_add(b_, &desc, &id));
    return id;
  }
  Scene world_of(bdpt_texture_id texture, bdpt_lookup lookup) {
    const Contents contents(b_);
    bdpt_texture_use use = texture_use(texture);
    use.lookup = lookup;
    use.uv_set = 1;
    bdpt_material_desc desc = grey_desc();
    desc.textures = &use, desc.texture_count = 1;
    bdpt_material_id material{};
    EXPECT_OK(bdpt_material_add(b_, &desc, &material));
    const bdpt_instance_desc floor = instance_desc(contents.square, material, 3);
    EXPECT_OK(bdpt_instance_update(b_, contents.floor, &floor));
    return build(b_);
  }
  Scene world_of_pattern() { return world_of(add_pattern(), 0); }
};

TEST_F(ApiHostTexture, EveryRefusalNamesFieldValueAndRemedy) {
  EXPECT_OK(try_pattern([](auto&) {}));
  EXPECT_OK(try_pattern([](auto& d) { d.maximum = 20, d.step[0] = 1, d.step[1] = 1e-6f, d.label = nullptr; }));
  const auto refused = [&](std::initializer_list<const char*> parts,
                           const std::function<void(bdpt_host_texture_desc&)>& change) {
    expect_refused(try_pattern(change), parts);
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "\"squares\"")) << bdpt_last_error();
  };
  refused({"look_up", "is NULL", "give the function"}, [](auto& d) { d.look_up = nullptr; });
  refused({"maximum", "is -1"}, [](auto& d) { d.maximum = -1; });
  refused({"maximum", "nan"}, [](auto& d) { d.maximum = kNan; });
  refused({"maximum", "inf"}, [](auto& d) { d.maximum = kInfinity; });
  refused({"step", "is 0"}, [](auto& d) { d.step[0] = 0.1f; });
  refused({"step", "is 1.5"}, [](auto& d) { d.step[0] = 0.1f, d.step[1] = 1.5f; });
  EXPECT_EQ(6, pattern_.dropped);
}

TEST_F(ApiHostTexture, IsRefusedWhereTexelsAreNeeded) {
  const bdpt_texture_id texture = add_pattern();
  bdpt_host_texture_desc desc = pattern_desc(pattern_);
  desc.maximum = 2;
  bdpt_texture_id bright{};
  ASSERT_OK(bdpt_host_texture_add(b_, &desc, &bright));
  const auto refused = [&](std::initializer_list<const char*> parts,
                           const std::function<void(bdpt_texture_use&, bdpt_material_desc&)>& change) {
    bdpt_texture_use use = texture_use(texture);
    expect_refused(try_material([&](bdpt_material_desc& d) {
                     d.textures = &use, d.texture_count = 1;
                     change(use, d);
                   }),
                   parts);
  };
  refused({"slot", "OPACITY", "\"squares\"", "one by one"}, [](auto& u, auto& d) {
    u.slot = BDPT_SLOT_OPACITY;
    d.opacity_mode = BDPT_OPACITY_BLEND;
  });
  refused({"slot", "EMISSION", "by texels"}, [](auto& u, auto& d) {
    u.slot = BDPT_SLOT_EMISSION;
    d.emission[0] = 1;
  });
  refused({"wrap", "as they are"}, [](auto& u, auto&) { u.wrap[1] = BDPT_WRAP_CLAMP; });
  refused({"lookup", "no texels"}, [](auto& u, auto&) { u.lookup = BDPT_LOOKUP_NEAREST; });
  refused({"level", "no mip levels"}, [](auto& u, auto&) { u.level = 1; });
  refused({"a maximum of 2", "REFLECTANCE", "at most 1"}, [&](auto& u, auto&) { u.texture = bright; });
  expect_refused(try_material([&](auto& d) { d.reflectance_texture = bright; }), {"a maximum of 2", "REFLECTANCE"});
  EXPECT_OK(try_material([&](auto& d) { d.reflectance_texture = texture; }));
  const bdpt_texture_use bump = texture_use(bright, BDPT_SLOT_BUMP);
  EXPECT_OK(try_material([&](auto& d) { d.textures = &bump, d.texture_count = 1; }));
  expect_refused(try_light([&](auto& d) { d.texture = texture; }), {"texture", "\"squares\"", "the host's"});
  expect_refused(try_light([&](auto& d) { d.type = BDPT_LIGHT_ENVIRONMENT, d.texture = texture; }), {"the host's"});
}

TEST_F(ApiHostTexture, ShowsWhatTheImageShows) {
  const auto picture = [&](const Scene& scene) {
    const Sensor camera = make_camera(context_.get());
    const Film film = make_film(camera.get());
    EXPECT_OK(advance(make_render(scene.get(), camera.get(), film.get()).get(), 4));
    return pixels_of(film.get());
  };
  const std::vector<float> of_host = picture(world_of_pattern());
  owner_ = make_builder(context_.get());
  b_ = owner_.get();
  EXPECT_EQ(picture(world_of(add_image(), BDPT_LOOKUP_NEAREST)), of_host);
  EXPECT_GT(pattern_.lookups, 10 * pattern_.calls) << pattern_.calls << " calls";
}

TEST_F(ApiHostTexture, AFailureStopsTheCallAndIsTold) {
  const Scene scene = world_of_pattern();
  const Sensor camera = make_camera(context_.get());
  const Film film = make_film(camera.get()), other = make_film(camera.get());
  const Render render = make_render(scene.get(), camera.get(), film.get());
  for (const auto& [fault, part] :
       {std::pair(Pattern::Fault::Error, "returned 42"), {Pattern::Fault::Throw, "threw"}}) {
    pattern_.fault = fault;
    expect_refused(advance(render.get(), 4), {"look_up", "\"squares\"", part}, BDPT_ERROR_CALLBACK_FAILED);
    EXPECT_EQ(0u, info_of(film.get()).passes);
  }
  // Pools of light subpaths are traced before the first pass, too.
  bdpt_render_desc pooled = make<bdpt_render_desc>();
  pooled.plan = "pooled";
  bdpt_render* none = nullptr;
  expect_refused(bdpt_render_create(scene.get(), camera.get(), other.get(), &pooled, &none), {"threw"},
                 BDPT_ERROR_CALLBACK_FAILED);
  EXPECT_EQ(nullptr, none);
  pattern_.fault = Pattern::Fault::None;  // the next call begins the pass anew
  EXPECT_OK(advance(render.get(), 4));
  EXPECT_OK(advance(make_render(scene.get(), camera.get(), other.get()).get(), 4));
  EXPECT_EQ(pixels_of(other.get()), pixels_of(film.get()));
}

TEST_F(ApiHostTexture, ColorsThatAreNoneAreCounted) {
  const Scene scene = world_of_pattern();
  const Sensor camera = make_camera(context_.get());
  for (const Pattern::Fault fault : {Pattern::Fault::Nan, Pattern::Fault::Unset}) {
    pattern_.fault = fault;
    const Film film = make_film(camera.get());
    const Render render = make_render(scene.get(), camera.get(), film.get());
    EXPECT_OK(advance(render.get(), 4));
    EXPECT_GT(info_of(film.get()).rejected, 100u);
    bdpt_render_stats stats = make<bdpt_render_stats>();
    EXPECT_OK(bdpt_render_get_stats(render.get(), &stats));
    EXPECT_GE(stats.rejected, info_of(film.get()).rejected);
    for (float v : pixels_of(film.get())) EXPECT_TRUE(std::isfinite(v));
  }
}

TEST_F(ApiHostTexture, InsideItRenderAndFilmAreClosed) {
  const Scene scene = world_of_pattern();
  const Sensor camera = make_camera(context_.get());
  const Film film = make_film(camera.get());
  bdpt_render_desc pooled = make<bdpt_render_desc>();
  pooled.plan = "pooled";
  std::atomic<bdpt_render*> render{nullptr};
  pattern_.inside = [&] {
    const bdpt_advance_desc desc = passes(1);
    if (bdpt_render* r = render) {
      EXPECT_EQ(BDPT_ERROR_REENTRANT, bdpt_render_advance(r, &desc, nullptr));
    }
    bdpt_render* none = nullptr;
    EXPECT_EQ(BDPT_ERROR_REENTRANT, bdpt_render_create(scene.get(), camera.get(), film.get(), nullptr, &none));
  };
  const Render owner = make_render(scene.get(), camera.get(), film.get(), &pooled);
  EXPECT_GT(pattern_.calls, 0u);
  render = owner.get();
  EXPECT_OK(advance(owner.get(), 1));
}

TEST_F(ApiHostTexture, ACancelFromInsideKeepsWhatIsDone) {
  const Scene scene = world_of_pattern();
  const Sensor camera = make_camera(context_.get(), camera_desc(96, 64));
  const Film film = make_film(camera.get()), whole = make_film(camera.get());
  const Cancel cancel = make_cancel();
  const Render render = make_render(scene.get(), camera.get(), film.get());
  pattern_.inside = [&] {
    if (pattern_.calls == 20) bdpt_cancel_request(cancel.get());
  };
  bdpt_advance_desc desc = passes(2);
  desc.cancel = cancel.get();
  EXPECT_EQ(BDPT_CANCELLED, bdpt_render_advance(render.get(), &desc, nullptr));
  pattern_.inside = nullptr;
  EXPECT_OK(advance(render.get(), 2 - info_of(film.get()).passes));
  EXPECT_OK(advance(make_render(scene.get(), camera.get(), whole.get()).get(), 2));
  EXPECT_EQ(pixels_of(whole.get()), pixels_of(film.get()));
}

TEST_F(ApiHostTexture, IsDroppedOnceWhenNothingNeedsItAnyMore) {
  const bdpt_texture_id unused = add_pattern();
  EXPECT_OK(bdpt_texture_remove(b_, unused));
  EXPECT_EQ(1, pattern_.dropped);
  const bdpt_texture_id texture = add_pattern();
  Scene scene = world_of(texture, 0);
  EXPECT_IN_USE(bdpt_texture_remove(b_, texture));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "\"squares\"")) << bdpt_last_error();
  owner_.reset();
  EXPECT_EQ(1, pattern_.dropped);
  scene.reset();
  EXPECT_EQ(2, pattern_.dropped);
}

}  // namespace bdpt_api::api_host_texture_test
