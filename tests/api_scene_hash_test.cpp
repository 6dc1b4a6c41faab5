// The hash of a scene: it changes with every number that decides the picture, and with nothing else.
#include "api_builder.h"

#include <map>

namespace bdpt_api::api_scene_hash_test {

// A square of glass-like stuff that has everything, in a medium, to be changed in one place.
struct Everything {
  bdpt_mesh_desc mesh = square_desc();
  float colors[4][4] = {{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}};
  float tangents[4][4] = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
  uint16_t texels[4][4] = {};
  bdpt_texture_desc texture = texture_desc(texels, 2, 2);
  bdpt_texture_use use = make<bdpt_texture_use>();  // BUMP by default
  bdpt_texture_use opacity = make<bdpt_texture_use>();
  bdpt_material_desc material = grey_desc(), glass = grey_desc();
  bdpt_medium_desc inside = medium_desc(), outside = medium_desc();
  bool has_interior = true, has_outside = true, has_other_texture = false;

  Everything() {
    mesh.colors = view(colors, 4, BDPT_FORMAT_FLOAT4);
    mesh.tangents = view(tangents, 4, BDPT_FORMAT_FLOAT4);
    texture.channels = 4;
    texture.texel = BDPT_TEXEL_UINT16;
    use.slot = BDPT_SLOT_BUMP;
    opacity.slot = BDPT_SLOT_OPACITY;
    material.type = BDPT_MATERIAL_DIELECTRIC;
    material.roughness[0] = material.roughness[1] = 0.5f;
    material.opacity_mode = BDPT_OPACITY_MASK;
    material.opacity = 1;
    glass.type = BDPT_MATERIAL_DIELECTRIC;
  }
};

class ApiSceneHash : public testing::Test {
 protected:
  Context context_ = make_context();

  uint64_t hash(const std::function<void(Everything&)>& change = {}) {
    Everything e;
    if (change) change(e);
    const Builder owner = make_builder(context_.get());
    bdpt_builder* b = owner.get();
    bdpt_shape_id shape{};
    bdpt_texture_id texture{}, other{};
    bdpt_material_id material{};
    bdpt_medium_id inside{}, outside{};
    EXPECT_OK(bdpt_mesh_add(b, &e.mesh, &shape));
    EXPECT_OK(bdpt_texture_add(b, &e.texture, &texture));
    if (e.has_other_texture) {
      e.texels[3][3] = 1;
      EXPECT_OK(bdpt_texture_add(b, &e.texture, &other));
    }
    EXPECT_OK(bdpt_medium_add(b, &e.inside, &inside));
    EXPECT_OK(bdpt_medium_add(b, &e.outside, &outside));
    e.use.texture = e.has_other_texture ? other : texture;
    e.opacity.texture = texture;
    const bdpt_texture_use uses[2] = {e.use, e.opacity};
    e.material.textures = uses, e.material.texture_count = e.material.opacity_mode ? 2 : 1;
    EXPECT_OK(bdpt_material_add(b, &e.material, &material));
    add_instance(b, shape, material);
    if (e.has_interior) e.glass.interior = inside;
    EXPECT_OK(bdpt_material_add(b, &e.glass, &material));
    add_instance(b, shape, material);
    bdpt_build_desc desc = make<bdpt_build_desc>();
    if (e.has_outside) desc.medium = outside;
    bdpt_scene* scene = nullptr;
    EXPECT_OK(bdpt_scene_build(b, &desc, &scene));
    return scene ? scene_hash(Scene(scene).get()) : 0;
  }
};

TEST_F(ApiSceneHash, ChangesWithEveryNumber) {
  std::map<uint64_t, std::string> seen{{hash(), "nothing"}};
  const auto differs = [&](const char* name, const std::function<void(Everything&)>& change) {
    const auto [place, is_new] = seen.try_emplace(hash(change), name);
    EXPECT_TRUE(is_new) << name << " gives the same as " << place->second;
  };
  differs("color", [](auto& e) { e.colors[2][1] = 0.5f; });
  differs("alpha of a color", [](auto& e) { e.colors[2][3] = 0.5f; });
  differs("no colors", [](auto& e) { e.mesh.colors = {}; });
  differs("tangent", [](auto& e) { e.tangents[1][2] = 1; });
  differs("sign of a tangent", [](auto& e) { e.tangents[1][3] = -1; });
  differs("no tangents", [](auto& e) { e.mesh.tangents = {}; });
  differs("neither", [](auto& e) { e.mesh.colors = e.mesh.tangents = {}; });
  differs("texel", [](auto& e) { e.texels[3][3] = 1; });
  differs("encoding", [](auto& e) { e.texture.encoding = BDPT_ENCODING_LINEAR; });
  differs("mip_levels", [](auto& e) { e.texture.mip_levels = 2; });
  differs("another texture", [](auto& e) { e.has_other_texture = true; });
  differs("slot", [](auto& e) { e.use.slot = BDPT_SLOT_NORMAL; });
  // The texture alone counts by its square: alpha is 0.25 in both.
  for (const uint32_t perceptual : {0u, 1u})
    differs(perceptual ? "squared slot ROUGHNESS" : "slot ROUGHNESS", [&](auto& e) {
      e.use.slot = BDPT_SLOT_ROUGHNESS, e.material.perceptual_roughness = perceptual;
      e.material.roughness[0] = e.material.roughness[1] = perceptual ? 0.5f : 0.25f;
    });
  const std::pair<const char*, bdpt_texture_use Everything::*> uses[] = {{"bump", &Everything::use},
                                                                         {"opacity", &Everything::opacity}};
  for (const auto& [name, use] : uses) {
    SCOPED_TRACE(name);
    const auto of = [&, use = use, n = std::string(name)](const char* field, auto&& change) {
      differs((n + ' ' + field).c_str(), [&](Everything& e) { change(e.*use); });
    };
    of("channel", [](auto& u) { u.channel = 2; });
    of("uv_set", [](auto& u) { u.uv_set = 1; });
    of("wrap[0]", [](auto& u) { u.wrap[0] = BDPT_WRAP_MIRROR; });
    of("wrap[1]", [](auto& u) { u.wrap[1] = BDPT_WRAP_MIRROR; });
    of("lookup", [](auto& u) { u.lookup = BDPT_LOOKUP_NEAREST; });
    of("level", [](auto& u) { u.level = 0.5f; });
    for (const int i : {1, 2, 3, 5})
      of(("transform " + std::to_string(i)).c_str(),
         [&](auto& u) { u.transform[0] = u.transform[4] = 1, u.transform[i] = 0.5f; });
    of("transform 0", [&](auto& u) { u.transform[0] = 2, u.transform[4] = 1; });
    of("transform 4", [&](auto& u) { u.transform[0] = 1, u.transform[4] = 2; });
  }
  differs("scale", [](auto& e) { e.use.scale = 2; });
  differs("perceptual_roughness", [](auto& e) { e.material.perceptual_roughness = 1; });
  differs("emission_exponent", [](auto& e) { e.material.emission_exponent = 2; });
  differs("opacity_mode", [](auto& e) { e.material.opacity_mode = BDPT_OPACITY_BLEND; });
  differs("no opacity", [](auto& e) { e.material.opacity_mode = BDPT_OPACITY_OPAQUE; });
  differs("opacity", [](auto& e) { e.material.opacity = 0.5f; });
  differs("opacity_cutoff", [](auto& e) { e.material.opacity_cutoff = 0.75f; });
  differs("type", [](auto& e) { e.material.type = BDPT_MATERIAL_DIFFUSE; });
  const auto film = [&](const char* name, const std::function<void(bdpt_material_desc&)>& change) {
    differs(name, [&](auto& e) {
      e.material.type = BDPT_MATERIAL_PRINCIPLED, e.material.iridescence = 1;
      change(e.material);
    });
  };
  film("iridescence", [](auto&) {});
  film("weak iridescence", [](auto& d) { d.iridescence = 0.5f; });
  film("iridescence_ior", [](auto& d) { d.iridescence_ior = 1.5f; });
  film("iridescence_thickness", [](auto& d) { d.iridescence_thickness = 300; });
  differs("priority", [](auto& e) { e.glass.priority = 1; });
  differs("no interior", [](auto& e) { e.has_interior = false; });
  differs("nothing outside", [](auto& e) { e.has_outside = false; });
  differs("no medium", [](auto& e) { e.has_interior = e.has_outside = false; });
  for (int i = 0; i < 3; ++i) {
    differs("sigma_a inside", [&](auto& e) { e.inside.sigma_a[i] = 3; });
    differs("sigma_s inside", [&](auto& e) { e.inside.sigma_s[i] = 3; });
    differs("sigma_a outside", [&](auto& e) { e.outside.sigma_a[i] = 3; });
    differs("sigma_s outside", [&](auto& e) { e.outside.sigma_s[i] = 3; });
  }
  differs("g inside", [](auto& e) { e.inside.g = 0.5f; });
  differs("g outside", [](auto& e) { e.outside.g = 0.5f; });
}

TEST_F(ApiSceneHash, IsTheSameForWhatLooksTheSame) {
  const uint64_t expected = hash();
  const auto same = [&](const std::function<void(Everything&)>& change) { EXPECT_EQ(expected, hash(change)); };
  same([](auto& e) { e.mesh.label = e.texture.label = e.material.label = e.inside.label = e.outside.label = "other"; });
  same([](auto& e) { e.material.label = e.inside.label = nullptr; });
  same([](auto& e) { e.mesh.colors.ownership = e.mesh.tangents.ownership = BDPT_OWNERSHIP_BORROW; });
  static const float ones[4][3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  same([](auto& e) { e.mesh.colors = view(ones, 4, BDPT_FORMAT_FLOAT3); });
  static const uint16_t padded[2][12] = {};
  same([](auto& e) { e.texture.pixels = padded, e.texture.row_stride = sizeof padded[0]; });
  same([](auto& e) { e.texture.mip_levels = 1; });
  same([](auto& e) { e.use.scale = 1; });
  same([](auto& e) { e.use.transform[0] = e.use.transform[4] = 1; });
  same([](auto& e) { e.material.opacity_cutoff = 0.5f; });
}

}  // namespace bdpt_api::api_scene_hash_test
