// A scene with a texture in each slot, opacity, vertex colours and media gives the same picture on any threads and in
// any ranges of passes.
#include "api_builder.h"

#include <algorithm>
#include <cmath>

namespace bdpt_api::api_contents_render_test {

struct Furnished {
  Context context;
  Builder builder;
  Scene scene;
  Sensor sensor;

  explicit Furnished(uint32_t threads) {
    bdpt_context_desc desc = make<bdpt_context_desc>();
    desc.threads = threads;
    context = make_context(&desc);
    builder = make_builder(context.get());
    bdpt_builder* b = builder.get();
    texture = add_checks(b);
    const bdpt_shape_id square = add_coloured_square(b), ball = add_sphere(b);
    add_instance(b, add_square(b), add_grey(b, 4), 0.5f, 2, true);  // the lamp
    add_instance(b, square, material(BDPT_MATERIAL_DIFFUSE, {BDPT_SLOT_REFLECTANCE, BDPT_SLOT_BUMP}), 3);
    add_instance(b, ball, material(BDPT_MATERIAL_CONDUCTOR, {BDPT_SLOT_ROUGHNESS, BDPT_SLOT_NORMAL}), 1, 0.5f);
    add_instance(b, square, material(BDPT_MATERIAL_DIFFUSE, {BDPT_SLOT_OPACITY}, BDPT_OPACITY_BLEND), 0.7f, 1.2f);
    add_instance(b, square, material(BDPT_MATERIAL_DIFFUSE, {BDPT_SLOT_OPACITY}, BDPT_OPACITY_MASK), 0.8f, 1.5f);
    add_instance(b, ball, fog(), 3, 0.5f);
    bdpt_build_desc options = make<bdpt_build_desc>();
    options.medium = add_medium(b);
    bdpt_scene* built = nullptr;
    EXPECT_OK(bdpt_scene_build(b, &options, &built));
    scene.reset(built);
    sensor = make_camera(context.get());
  }
  Film passes(uint64_t first, uint64_t n) const {
    Film film = make_film(sensor.get());
    bdpt_render_desc desc = make<bdpt_render_desc>();
    desc.first_pass = first;
    const Render render = make_render(scene.get(), sensor.get(), film.get(), &desc);
    EXPECT_OK(advance(render.get(), n));
    return film;
  }

 private:
  bdpt_texture_id texture;

  static bdpt_texture_id add_checks(bdpt_builder* b) {
    static const uint8_t texels[4][4] = {
        {255, 128, 64, 255}, {128, 200, 255, 60}, {90, 140, 250, 0}, {130, 120, 240, 160}};
    bdpt_texture_desc desc = texture_desc(texels, 2, 2);
    desc.channels = 4;
    desc.encoding = BDPT_ENCODING_LINEAR;
    bdpt_texture_id id{};
    EXPECT_OK(bdpt_texture_add(b, &desc, &id));
    return id;
  }
  static bdpt_shape_id add_coloured_square(bdpt_builder* b) {
    static const float colors[4][4] = {{1, 0.5f, 0, 1}, {0, 1, 0.5f, 0.5f}, {1, 1, 1, 1}, {0.5f, 0.5f, 1, 0.75f}};
    bdpt_mesh_desc desc = square_desc();
    desc.uv[0] = view(kSquareUv, 4, BDPT_FORMAT_FLOAT2);
    desc.colors = view(colors, 4, BDPT_FORMAT_FLOAT4);
    bdpt_shape_id shape{};
    EXPECT_OK(bdpt_mesh_add(b, &desc, &shape));
    return shape;
  }
  bdpt_material_id material(bdpt_material_type type, std::initializer_list<bdpt_slot> slots,
                            bdpt_opacity_mode mode = BDPT_OPACITY_OPAQUE) {
    std::vector<bdpt_texture_use> uses;
    for (const bdpt_slot slot : slots) {
      uses.push_back(texture_use(texture, slot));
      if (slot == BDPT_SLOT_BUMP) uses.back().scale = 0.05f;
      if (slot == BDPT_SLOT_OPACITY) uses.back().channel = 3;
    }
    bdpt_material_desc desc = grey_desc();
    desc.type = type;
    desc.textures = uses.data(), desc.texture_count = uint32_t(uses.size());
    desc.roughness[0] = desc.roughness[1] = 0.4f;
    for (float& v : desc.k) v = 2;
    desc.opacity_mode = mode;
    desc.opacity = mode ? 1.0f : 0.0f;
    bdpt_material_id id{};
    EXPECT_OK(bdpt_material_add(builder.get(), &desc, &id));
    return id;
  }
  bdpt_material_id fog() {
    bdpt_medium_desc thick = medium_desc();
    thick.sigma_s[0] = 0.6f, thick.g = 0.5f;
    bdpt_material_desc desc = grey_desc();
    desc.type = BDPT_MATERIAL_INTERFACE;
    desc.priority = 1;
    EXPECT_OK(bdpt_medium_add(builder.get(), &thick, &desc.interior));
    bdpt_material_id id{};
    EXPECT_OK(bdpt_material_add(builder.get(), &desc, &id));
    return id;
  }
};

TEST(ApiContentsRender, ThePictureDependsNeitherOnThreadsNorOnRanges) {
  const Furnished one(1), two(2);
  EXPECT_EQ(scene_hash(one.scene.get()), scene_hash(two.scene.get()));
  const std::vector<float> expected = pixels_of(one.passes(0, 4).get());
  EXPECT_TRUE(std::all_of(expected.begin(), expected.end(), [](float v) { return std::isfinite(v) && v >= 0; }));
  EXPECT_LT(expected.size() / 2,
            size_t(std::count_if(expected.begin(), expected.end(), [](float v) { return v > 0; })));
  EXPECT_EQ(expected, pixels_of(two.passes(0, 4).get()));
  const Film merged = one.passes(0, 1), rest = two.passes(1, 3);
  ASSERT_OK(bdpt_film_merge(merged.get(), rest.get()));
  EXPECT_EQ(expected, pixels_of(merged.get()));
}

// A material that is changed after the scene was built changes the next scene only.
TEST(ApiContentsRender, AnUpdateLeavesBuiltScenesAlone) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  bdpt_builder* b = builder.get();
  const Contents contents(b);
  const Sensor sensor = make_camera(context.get());
  const auto picture = [&](const Scene& scene) {
    const Film film = make_film(sensor.get());
    const Render render = make_render(scene.get(), sensor.get(), film.get());
    EXPECT_OK(advance(render.get(), 1));
    return pixels_of(film.get());
  };
  const bdpt_texture_use use = texture_use(add_texture(b));
  bdpt_material_desc textured = grey_desc();
  textured.textures = &use, textured.texture_count = 1;
  ASSERT_OK(bdpt_material_update(b, contents.grey, &textured));
  const Scene scene = build(b);
  const std::vector<float> before = picture(scene);
  const bdpt_material_desc plain = grey_desc();
  ASSERT_OK(bdpt_material_update(b, contents.grey, &plain));
  ASSERT_OK(bdpt_texture_remove(b, use.texture));
  EXPECT_EQ(before, picture(scene));
  EXPECT_NE(before, picture(build(b)));
}

}  // namespace bdpt_api::api_contents_render_test
