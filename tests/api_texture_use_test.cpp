// The textures of a material, slot by slot.
#include "api_builder.h"

#include <cstdlib>
#include <vector>

namespace bdpt_api::api_texture_use_test {

class ApiTextureUse : public BuilderTest {
 protected:
  bdpt_texture_id texture_ = add_texture(b_);

  // One use that is changed, of a material that can be.
  bdpt_result try_use(const std::function<void(bdpt_texture_use&)>& change,
                      const std::function<void(bdpt_material_desc&)>& change_material = {}) {
    bdpt_texture_use use = texture_use(texture_);
    change(use);
    return try_material([&](bdpt_material_desc& d) {
      d.textures = &use, d.texture_count = 1;
      if (change_material) change_material(d);
    });
  }
  bdpt_texture_id bright() {
    const float pixels[3] = {0, 1.5f, 0};
    bdpt_texture_desc desc = texture_desc(pixels);
    desc.texel = BDPT_TEXEL_FLOAT;
    desc.encoding = BDPT_ENCODING_LINEAR;
    bdpt_texture_id texture{};
    EXPECT_OK(bdpt_texture_add(b_, &desc, &texture));
    return texture;
  }
};

const std::function<void(bdpt_material_desc&)> kMetal = [](bdpt_material_desc& d) {
  d.type = BDPT_MATERIAL_CONDUCTOR;
  d.roughness[0] = d.roughness[1] = 0.5f;
  for (float& v : d.k) v = 1;
};
const std::function<void(bdpt_material_desc&)> kMask = [](bdpt_material_desc& d) {
  d.opacity_mode = BDPT_OPACITY_MASK;
  d.opacity = 1;
};

TEST_F(ApiTextureUse, EverySlotIsTakenByWhatHasItsNumber) {
  EXPECT_OK(try_use([](auto&) {}));
  EXPECT_OK(try_use([](auto&) {}, [](auto& d) { d.type = BDPT_MATERIAL_MIRROR; }));
  EXPECT_OK(try_use([](auto& u) { u.slot = BDPT_SLOT_ROUGHNESS, u.channel = 3; }, kMetal));
  EXPECT_OK(try_use([](auto& u) { u.slot = BDPT_SLOT_NORMAL, u.scale = -2; }));
  EXPECT_OK(try_use([](auto& u) { u.slot = BDPT_SLOT_BUMP, u.scale = 0.1f, u.channel = 1; }));
  EXPECT_OK(try_use([](auto& u) { u.slot = BDPT_SLOT_OPACITY, u.channel = 3; }, kMask));
  EXPECT_OK(try_use([](auto& u) { u.slot = BDPT_SLOT_EMISSION; }, [](auto& d) { d.emission[0] = 1; }));
  EXPECT_OK(try_use([](auto& u) { u.level = 16, u.uv_set = 1, u.wrap[0] = u.wrap[1] = BDPT_WRAP_CLAMP; }));
}

TEST_F(ApiTextureUse, EveryRefusalNamesFieldValueAndRemedy) {
  const auto refused = [&](std::initializer_list<const char*> parts,
                           const std::function<void(bdpt_texture_use&)>& change,
                           const std::function<void(bdpt_material_desc&)>& material = {}) {
    expect_refused(try_use(change, material), parts);
    for (const char* part : {"bdpt_material_add", "textures[0]", "material \"grey\""})
      EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), part)) << bdpt_last_error();
  };
  refused({"slot", "is 1000", "none of the constants"}, [](auto& u) { u.slot = 1000; });
  refused({"slot", "is -1", "none of the constants"}, [](auto& u) { u.slot = -1; });
  refused({"reserved", "is 1", "must be 0"}, [](auto& u) { u.reserved = 1; });
  refused({"uv_set", "is 2", "from 0 to 1"}, [](auto& u) { u.uv_set = 2; });
  refused({"channel", "is 1", "from 0 to 0"}, [](auto& u) { u.channel = 1; });
  refused({"channel", "is 1", "from 0 to 0"}, [](auto& u) { u.slot = BDPT_SLOT_NORMAL, u.channel = 1; });
  refused({"channel", "is 4", "from 0 to 3"}, [](auto& u) { u.slot = BDPT_SLOT_BUMP, u.channel = 4; });
  refused({"scale", "nan", "finite"}, [](auto& u) { u.slot = BDPT_SLOT_BUMP, u.scale = kNan; });
  refused({"scale", "is 2", "REFLECTANCE give 0"}, [](auto& u) { u.scale = 2; });
  refused(
      {"scale", "is 2", "ROUGHNESS give 0"}, [](auto& u) { u.slot = BDPT_SLOT_ROUGHNESS, u.scale = 2; }, kMetal);
  refused(
      {"scale", "is 2", "OPACITY give 0"}, [](auto& u) { u.slot = BDPT_SLOT_OPACITY, u.scale = 2; }, kMask);
  refused({"slot", "is ROUGHNESS", "no use for"}, [](auto& u) { u.slot = BDPT_SLOT_ROUGHNESS; });
  refused(
      {"slot", "is REFLECTANCE", "no use for"}, [](auto&) {}, kMetal);
  const auto interface = [](bdpt_material_desc& d) { d.type = BDPT_MATERIAL_INTERFACE; };
  refused(
      {"slot", "is NORMAL", "no use for"}, [](auto& u) { u.slot = BDPT_SLOT_NORMAL; }, interface);
  refused(
      {"slot", "is BUMP", "no use for"}, [](auto& u) { u.slot = BDPT_SLOT_BUMP; }, interface);
  refused(
      {"slot", "is EMISSION", "no use for"}, [](auto& u) { u.slot = BDPT_SLOT_EMISSION; }, interface);
  refused({"channel", "is 1", "from 0 to 0"}, [](auto& u) { u.slot = BDPT_SLOT_EMISSION, u.channel = 1; });
  refused({"scale", "is 2", "EMISSION give 0"}, [](auto& u) { u.slot = BDPT_SLOT_EMISSION, u.scale = 2; });
  refused({"slot", "is OPACITY", "choose MASK or BLEND"}, [](auto& u) { u.slot = BDPT_SLOT_OPACITY; });
  refused({"wrap[0]", "is 3", "0 to 2"}, [](auto& u) { u.wrap[0] = 3; });
  refused({"wrap[1]", "is -1", "0 to 2"}, [](auto& u) { u.wrap[1] = -1; });
  refused({"lookup", "is 3", "0 to 2"}, [](auto& u) { u.lookup = 3; });
  refused({"level", "is -1", "from 0 to 16"}, [](auto& u) { u.level = -1; });
  refused({"level", "is 16.5", "from 0 to 16"}, [](auto& u) { u.level = 16.5f; });
  refused({"level", "nan", "from 0 to 16"}, [](auto& u) { u.level = kNan; });
  refused({"transform[4]", "inf", "finite"}, [](auto& u) { u.transform[4] = kInfinity; });
  refused({"transform", "is singular", "inverted", "six zeros"}, [](auto& u) { u.transform[2] = 1; });
  refused({"transform", "is singular"},
          [](auto& u) { u.transform[0] = 1, u.transform[1] = 2, u.transform[3] = 2, u.transform[4] = 4; });
}

TEST_F(ApiTextureUse, TexturesAreOfThisBuilderAndAlive) {
  const auto refused = [&](std::initializer_list<const char*> parts, uint64_t id) {
    expect_refused(try_use([&](auto& u) { u.texture.id = id; }), parts, BDPT_ERROR_INVALID_ID);
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "texture of the textures[0] of material \"grey\""))
        << bdpt_last_error();
    expect_refused(try_material([&](auto& d) { d.reflectance_texture.id = id ? id : 99; }), {"reflectance_texture of"},
                   BDPT_ERROR_INVALID_ID);
  };
  const Builder other = make_builder(context_.get());
  const bdpt_texture_id removed = add_texture(b_);
  ASSERT_OK(bdpt_texture_remove(b_, removed));
  refused({"is zero"}, 0);
  refused({"was removed"}, removed.id);
  refused({"another builder"}, add_texture(other.get()).id);
  refused({"something else"}, add_grey(b_).id);
}

TEST_F(ApiTextureUse, WhatReflectsMoreThanAllIsRefusedWhereThatCounts) {
  const bdpt_texture_id texture = bright();
  const auto use = [&](bdpt_slot slot) { return [=](bdpt_texture_use& u) { u.texture = texture, u.slot = slot; }; };
  const auto parts = {"texture of the textures[0]", "up to 1.5", "at most 1"};
  expect_refused(try_use(use(BDPT_SLOT_REFLECTANCE)), parts);
  expect_refused(try_use(use(BDPT_SLOT_ROUGHNESS), kMetal), parts);
  expect_refused(try_use(use(BDPT_SLOT_OPACITY), kMask), parts);
  expect_refused(try_material([&](auto& d) { d.reflectance_texture = texture; }),
                 {"reflectance_texture of material \"grey\"", "up to 1.5", "at most 1"});
  EXPECT_OK(try_use(use(BDPT_SLOT_BUMP)));
  EXPECT_OK(try_use(use(BDPT_SLOT_EMISSION), [](auto& d) { d.emission[0] = 1; }));
  expect_refused(try_use(use(BDPT_SLOT_EMISSION), [](auto& d) { d.emission[0] = 3e38f; }),
                 {"texture of the textures[0]", "up to 1.5", "no finite number", "give less"});
}

// What is multiplied by 0 is 0 whatever the texture says.
TEST_F(ApiTextureUse, WhatIsZeroHasNoTexture) {
  const auto with = [&](bdpt_slot slot, const std::function<void(bdpt_material_desc&)>& change) {
    return try_use([=](auto& u) { u.slot = slot; },
                   [&](auto& d) {
                     d.type = BDPT_MATERIAL_PRINCIPLED;
                     change(d);
                   });
  };
  const auto check = [&](bdpt_slot slot, const char* name, const std::function<void(bdpt_material_desc&)>& set) {
    expect_refused(with(slot, [](auto&) {}), {"slot", name, "which multiplies", "is 0: set it"});
    EXPECT_OK(with(slot, set)) << name;
  };
  check(BDPT_SLOT_ROUGHNESS, "ROUGHNESS", [](auto& d) { d.roughness[0] = d.roughness[1] = 0.1f; });
  check(BDPT_SLOT_DIFFUSE_ROUGHNESS, "DIFFUSE_ROUGHNESS", [](auto& d) { d.diffuse_roughness = 1; });
  check(BDPT_SLOT_TRANSMITTANCE, "TRANSMITTANCE", [](auto& d) { d.transmittance[2] = 1; });
  check(BDPT_SLOT_METALNESS, "METALNESS", [](auto& d) { d.metalness = 1; });
  check(BDPT_SLOT_COAT, "COAT", [](auto& d) { d.coat = 1; });
  check(BDPT_SLOT_COAT_ROUGHNESS, "COAT_ROUGHNESS", [](auto& d) { d.coat_roughness = 1; });
  check(BDPT_SLOT_SHEEN_COLOR, "SHEEN_COLOR", [](auto& d) { d.sheen_color[1] = 1; });
  check(BDPT_SLOT_SHEEN_ROUGHNESS, "SHEEN_ROUGHNESS", [](auto& d) { d.sheen_roughness = 1; });
  check(BDPT_SLOT_TRANSMISSION, "TRANSMISSION", [](auto& d) { d.transmission = 1; });
  check(BDPT_SLOT_DIFFUSE_TRANSMISSION, "DIFFUSE_TRANSMISSION", [](auto& d) { d.diffuse_transmission = 1; });
  check(BDPT_SLOT_ANISOTROPY, "ANISOTROPY", [](auto& d) { d.anisotropy = 1; });
  check(BDPT_SLOT_IRIDESCENCE, "IRIDESCENCE", [](auto& d) { d.iridescence = 1; });
  check(BDPT_SLOT_IRIDESCENCE_THICKNESS, "IRIDESCENCE_THICKNESS",
        [](auto& d) { d.iridescence = 1, d.iridescence_thickness_minimum = 100; });
}

TEST_F(ApiTextureUse, EachSlotIsGivenOnce) {
  bdpt_texture_use uses[2] = {texture_use(texture_), texture_use(texture_)};
  const auto both = [&](bdpt_material_desc& d) { d.textures = uses, d.texture_count = 2; };
  expect_refused(try_material(both), {"slot of the textures[1]", "is REFLECTANCE for a second time", "each slot once"});
  uses[1].slot = BDPT_SLOT_BUMP;
  EXPECT_OK(try_material(both));
  expect_refused(try_material([&](auto& d) { both(d), d.reflectance_texture = texture_; }),
                 {"reflectance_texture", "beside a use of slot REFLECTANCE", "give one of them"});
}

TEST_F(ApiTextureUse, TheArrayIsCheckedAsAWhole) {
  const bdpt_texture_use use = texture_use(texture_);
  expect_refused(try_material([](auto& d) { d.texture_count = 1; }), {"desc.textures", "NULL"});
  for (const uint32_t count : {65u, 0xFFFFFFFFu})
    expect_refused(try_material([&](auto& d) { d.textures = &use, d.texture_count = count; }),
                   {"texture_count", "from 0 to 64"});
  for (const uint32_t stride : {1u, 64u, 74u, 76u, 0xFFFFFFFFu})
    expect_refused(try_material([&](auto& d) { d.textures = &use, d.texture_count = 1, d.texture_stride = stride; }),
                   {"texture_stride", std::to_string(stride).c_str(), "multiple of 8 from 72"});
  for (const uint32_t size : {0u, 71u, 0xFFFFFFF8u}) {
    bdpt_texture_use bad = use;
    bad.struct_size = size;
    expect_refused(try_material([&](auto& d) { d.textures = &bad, d.texture_count = 1; }),
                   {"textures[0]", "struct_size"});
  }
}

// In a block that ends with the last of them.
TEST_F(ApiTextureUse, EveryStrideAndSizeGivesTheSameMaterial) {
  const auto hash_of = [&](uint32_t size, uint32_t stride, bool says_stride) {
    auto* block = static_cast<unsigned char*>(std::calloc(1, stride + size));
    for (uint32_t i = 0; i < 2; ++i) {
      bdpt_texture_use use = texture_use(texture_, i == 0 ? BDPT_SLOT_BUMP : BDPT_SLOT_REFLECTANCE);
      use.struct_size = size;
      std::memcpy(block + i * stride, &use, std::min<size_t>(size, sizeof use));
    }
    const Builder builder = make_builder(context_.get());
    const bdpt_texture_id texture = add_texture(builder.get());
    for (uint32_t i = 0; i < 2; ++i)
      std::memcpy(block + i * stride + offsetof(bdpt_texture_use, texture), &texture, sizeof texture);
    bdpt_material_desc desc = grey_desc();
    desc.textures = reinterpret_cast<const bdpt_texture_use*>(block);
    desc.texture_count = 2;
    desc.texture_stride = says_stride ? stride : 0;
    bdpt_material_id material{};
    EXPECT_OK(bdpt_material_add(builder.get(), &desc, &material));
    std::free(block);
    add_instance(builder.get(), add_square(builder.get()), material);
    return scene_hash(build(builder.get()).get());
  };
  constexpr uint32_t kOwn = sizeof(bdpt_texture_use);
  const uint64_t expected = hash_of(kOwn, kOwn, false);
  EXPECT_EQ(expected, hash_of(kOwn, kOwn, true));
  EXPECT_EQ(expected, hash_of(kOwn, kOwn + 8, true));
  EXPECT_EQ(expected, hash_of(kOwn, 4096, true));
  EXPECT_EQ(expected, hash_of(kOwn + 16, kOwn + 16, false));
  EXPECT_EQ(expected, hash_of(kOwn, kOwn, true));
}

TEST_F(ApiTextureUse, AnOddSizeOfTheFirstIsNoStride) {
  std::vector<unsigned char> block(4 * sizeof(bdpt_texture_use));
  bdpt_texture_use use = texture_use(texture_);
  use.struct_size = sizeof use + 4;
  std::memcpy(block.data(), &use, sizeof use);
  expect_refused(try_material([&](auto& d) {
                   d.textures = reinterpret_cast<const bdpt_texture_use*>(block.data()), d.texture_count = 2;
                 }),
                 {"texture_stride", "struct_size of the first", "multiple of 8"});
}

TEST_F(ApiTextureUse, ATextureInUseStays) {
  const bdpt_texture_id second = add_texture(b_);
  const bdpt_texture_use uses[2] = {texture_use(texture_), texture_use(second, BDPT_SLOT_OPACITY)};
  bdpt_material_desc desc = grey_desc();
  desc.textures = uses, desc.texture_count = 2;
  kMask(desc);
  bdpt_material_id material{};
  ASSERT_OK(bdpt_material_add(b_, &desc, &material));
  expect_refused(bdpt_texture_remove(b_, texture_), {"used by 1 material", "remove or update"}, BDPT_ERROR_IN_USE);
  EXPECT_IN_USE(bdpt_texture_remove(b_, second));
  // The update takes the old uses back, and only then.
  desc.texture_count = 1, desc.opacity = 2;
  EXPECT_NE(BDPT_OK, bdpt_material_update(b_, material, &desc));
  EXPECT_IN_USE(bdpt_texture_remove(b_, second));
  desc.opacity = 1;
  ASSERT_OK(bdpt_material_update(b_, material, &desc));
  EXPECT_OK(bdpt_texture_remove(b_, second));
  EXPECT_IN_USE(bdpt_texture_remove(b_, texture_));
  ASSERT_OK(bdpt_material_update(b_, material, &desc));
  EXPECT_IN_USE(bdpt_texture_remove(b_, texture_));
  ASSERT_OK(bdpt_material_remove(b_, material));
  EXPECT_OK(bdpt_texture_remove(b_, texture_));
}

}  // namespace bdpt_api::api_texture_use_test
