// Descriptions drawn at random from usual, extreme and wrong numbers: a call takes them or says why not, and whatever
// was taken gives a finite picture.
#include "api_builder.h"

#include <cmath>
#include <random>

namespace bdpt_api::api_fuzz_test {

constexpr float kBright = 1e6f;

class Fuzz {
 public:
  explicit Fuzz(uint32_t seed) : random_(seed) {}
  uint32_t below(uint32_t n) { return uint32_t(random_() % n); }
  bool one_in(uint32_t n) { return below(n) == 0; }
  // Mostly in [0,1].
  float number() {
    constexpr float kOdd[] = {0, 1, -1, 2, 1e-6f, 1e-38f, 1e-45f, 1e6f, 1e18f, 3e38f, -3e38f, kInfinity, kNan};
    return one_in(12) ? kOdd[below(std::size(kOdd))] : unit();
  }
  float unit() { return float(below(1025)) / 1024; }
  float finite() {
    const float v = number();
    return std::isfinite(v) ? v : 0.5f;
  }
  int32_t choice(int32_t n) { return one_in(40) ? n + int32_t(below(3)) : int32_t(below(uint32_t(n))); }

  bdpt_texture_id texture(bdpt_builder* b) {
    float texels[16 * 4];
    for (float& v : texels) {
      v = one_in(4) ? 0 : one_in(100) ? finite() : unit();
      is_bright |= v > kBright;
    }
    bdpt_texture_desc desc = texture_desc(texels, 1 + below(4), 1 + below(4));
    desc.channels = 1 + below(4);
    desc.texel = choice(4);
    desc.encoding = int32_t(below(2));
    desc.mip_levels = below(4);
    bdpt_texture_id id{};
    return taken(bdpt_texture_add(b, &desc, &id)) ? id : add_texture(b);
  }
  bdpt_shape_id shape(bdpt_builder* b) {
    if (one_in(4)) return add_sphere(b);
    float uv[4][2], colors[4][4], tangents[4][4];
    for (auto& v : uv)
      for (float& c : v) c = number();
    for (auto& v : colors)
      for (float& c : v) c = unit();
    for (auto& v : tangents) {
      for (float& c : v) c = finite();
      v[3] = one_in(2) ? 1.0f : -1.0f;
    }
    bdpt_mesh_desc desc = square_desc();
    if (one_in(2)) desc.uv[0] = view(uv, 4, BDPT_FORMAT_FLOAT2);
    if (one_in(2)) desc.colors = view(colors, 4, BDPT_FORMAT_FLOAT4);
    if (one_in(2)) desc.tangents = view(tangents, 4, BDPT_FORMAT_FLOAT4);
    bdpt_shape_id id{};
    return taken(bdpt_mesh_add(b, &desc, &id)) ? id : add_square(b);
  }
  bdpt_medium_id medium(bdpt_builder* b) {
    bdpt_medium_desc desc = medium_desc();
    for (int i = 0; i < 3; ++i) desc.sigma_a[i] = number(), desc.sigma_s[i] = number();
    desc.g = one_in(4) ? 0.9999f : one_in(4) ? -0.9999f : number() * 2 - 1;
    bdpt_medium_id id{};
    return taken(bdpt_medium_add(b, &desc, &id)) ? id : add_medium(b);
  }
  bdpt_material_id material(bdpt_builder* b) {
    bdpt_material_desc desc = grey_desc();
    desc.type = choice(5);
    for (float& v : desc.reflectance) v = number();
    for (int i = 0; i < 3; ++i) desc.eta[i] = number() + 0.1f, desc.k[i] = number();
    if (one_in(2)) desc.roughness[0] = number(), desc.roughness[1] = number();
    desc.one_sided = one_in(8);
    desc.perceptual_roughness = one_in(2);
    desc.emission_exponent = one_in(8) ? number() * 4 - 1 : 0;
    desc.opacity_mode = one_in(2) ? choice(3) : 0;
    desc.opacity = number(), desc.opacity_cutoff = number();
    if (one_in(4)) desc.emission[below(3)] = number();
    for (const float v : desc.emission) is_bright |= v > kBright;
    if (one_in(2) && desc.type >= BDPT_MATERIAL_DIELECTRIC) desc.interior = medium(b), desc.priority = below(3);
    bdpt_texture_use uses[3] = {};
    for (bdpt_texture_use& use : uses) use = this->use(b);
    desc.textures = uses, desc.texture_count = below(4);
    bdpt_material_id id{};
    return taken(bdpt_material_add(b, &desc, &id)) ? id : add_grey(b);
  }
  int taken_count = 0, refused_count = 0;
  bool is_bright = false;  // something shines so much that a film need not take it

 private:
  bdpt_texture_use use(bdpt_builder* b) {
    bdpt_texture_use use = texture_use(texture(b), choice(6));
    const bool has_channel =
        use.slot == BDPT_SLOT_ROUGHNESS || use.slot == BDPT_SLOT_BUMP || use.slot == BDPT_SLOT_OPACITY;
    if (has_channel) use.channel = below(4);
    if (use.slot == BDPT_SLOT_NORMAL || use.slot == BDPT_SLOT_BUMP) use.scale = one_in(2) ? number() : -unit();
    use.uv_set = below(2);
    if (one_in(2))
      for (float& v : use.transform) v = number() * 4 - 2;
    use.wrap[0] = choice(3), use.wrap[1] = choice(3), use.lookup = choice(3);
    use.level = unit() * 4;
    return use;
  }
  bool taken(bdpt_result result) {
    if (result == BDPT_OK) return ++taken_count;
    ++refused_count;
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, result) << bdpt_last_error();
    EXPECT_LT(20u, std::strlen(bdpt_last_error()));
    return false;
  }

  std::minstd_rand random_;
};

TEST(ApiFuzz, WhateverIsTakenGivesAFinitePicture) {
  bdpt_context_desc one_thread = make<bdpt_context_desc>();
  one_thread.threads = 1;
  const Context context = make_context(&one_thread);
  const Sensor sensor = make_camera(context.get(), camera_desc(8, 8));
  const uint64_t before = memory_in_use(context.get());
  int taken = 0, refused = 0;
  for (uint32_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const Builder owner = make_builder(context.get());
    bdpt_builder* b = owner.get();
    Fuzz fuzz(seed);
    add_instance(b, add_square(b), add_grey(b, 4), 0.5f, 2, true);
    for (int i = 0; i < 4; ++i) add_instance(b, fuzz.shape(b), fuzz.material(b), 0.5f + float(i), 0.4f * float(i));
    taken += fuzz.taken_count, refused += fuzz.refused_count;
    bdpt_build_desc options = make<bdpt_build_desc>();
    if (fuzz.one_in(3)) options.medium = fuzz.medium(b);
    bdpt_scene* built = nullptr;
    if (const bdpt_result result = bdpt_scene_build(b, &options, &built); result != BDPT_OK) {
      expect_refused(result, {"is a sphere", "EMISSION"});
      continue;
    }
    const Scene scene(built);
    const Film film = make_film(sensor.get());
    {
      const Render render = make_render(scene.get(), sensor.get(), film.get());
      ASSERT_OK(advance(render.get(), 1));
    }
    bdpt_film_info info = make<bdpt_film_info>();
    ASSERT_OK(bdpt_film_get_info(film.get(), &info));
    if (!fuzz.is_bright) {
      EXPECT_EQ(0u, info.rejected);
    }
    for (const float v : pixels_of(film.get())) ASSERT_TRUE(std::isfinite(v) && v >= 0) << v;
  }
  EXPECT_LT(1000, taken);
  EXPECT_LT(100, refused);
  EXPECT_EQ(before, memory_in_use(context.get()));
}

}  // namespace bdpt_api::api_fuzz_test
