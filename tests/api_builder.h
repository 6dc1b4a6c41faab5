// A builder, and calls that add to it with one thing changed.
#pragma once

#include "api_scene.h"

#include <functional>
#include <initializer_list>
#include <limits>

#define EXPECT_ID(call) EXPECT_EQ(BDPT_ERROR_INVALID_ID, (call)) << #call << ": " << bdpt_last_error()
#define EXPECT_IN_USE(call) EXPECT_EQ(BDPT_ERROR_IN_USE, (call)) << #call << ": " << bdpt_last_error()

namespace bdpt_api {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Three channels of 8 bits.
inline bdpt_texture_desc texture_desc(const void* pixels, uint32_t width = 1, uint32_t height = 1) {
  bdpt_texture_desc desc = make<bdpt_texture_desc>();
  desc.channels = 3;
  desc.pixels = pixels;
  desc.width = width;
  desc.height = height;
  return desc;
}

inline bdpt_texture_id add_texture(bdpt_builder* builder) {
  const uint8_t texel[3] = {10, 20, 30};
  const bdpt_texture_desc desc = texture_desc(texel);
  bdpt_texture_id texture{};
  EXPECT_OK(bdpt_texture_add(builder, &desc, &texture));
  return texture;
}

inline bdpt_texture_use texture_use(bdpt_texture_id texture, bdpt_slot slot = BDPT_SLOT_REFLECTANCE) {
  bdpt_texture_use use = make<bdpt_texture_use>();
  use.texture = texture;
  use.slot = slot;
  return use;
}

inline bdpt_medium_desc medium_desc() {
  bdpt_medium_desc desc = make<bdpt_medium_desc>();
  desc.label = "fog";
  for (int i = 0; i < 3; ++i) desc.sigma_a[i] = 0.1f, desc.sigma_s[i] = 0.2f;
  return desc;
}

inline bdpt_medium_id add_medium(bdpt_builder* builder) {
  const bdpt_medium_desc desc = medium_desc();
  bdpt_medium_id medium{};
  EXPECT_OK(bdpt_medium_add(builder, &desc, &medium));
  return medium;
}

inline bdpt_light_id add_point(bdpt_builder* builder) {
  bdpt_light_desc desc = make<bdpt_light_desc>();
  for (float& v : desc.intensity) v = 1;
  bdpt_light_id light{};
  EXPECT_OK(bdpt_light_add(builder, &desc, &light));
  return light;
}

// The call failed with a text that has all these parts.
inline void expect_refused(bdpt_result result, std::initializer_list<const char*> parts,
                           bdpt_result expected = BDPT_ERROR_INVALID_ARGUMENT) {
  const std::string text = bdpt_last_error();
  EXPECT_EQ(expected, result) << text;
  for (const char* part : parts) EXPECT_NE(std::string::npos, text.find(part)) << '"' << part << "\" in: " << text;
}

class BuilderTest : public testing::Test {
 protected:
  Context context_ = make_context();
  Builder owner_ = make_builder(context_.get());
  bdpt_builder* b_ = owner_.get();

  bdpt_result try_material(const std::function<void(bdpt_material_desc&)>& change) {
    return try_add<bdpt_material_id>(bdpt_material_add, grey_desc(), change);
  }
  bdpt_result try_medium(const std::function<void(bdpt_medium_desc&)>& change) {
    return try_add<bdpt_medium_id>(bdpt_medium_add, medium_desc(), change);
  }
  bdpt_result try_light(const std::function<void(bdpt_light_desc&)>& change) {
    bdpt_light_desc desc = make<bdpt_light_desc>();
    desc.type = BDPT_LIGHT_SPOT;
    desc.direction[2] = 5;
    desc.intensity[0] = 1;
    desc.cone_angle = 30;
    desc.cone_falloff = 10;
    return try_add<bdpt_light_id>(bdpt_light_add, desc, change);
  }
  bdpt_result try_texture(const std::function<void(bdpt_texture_desc&)>& change) {
    static const float pixels[64] = {};
    return try_add<bdpt_texture_id>(bdpt_texture_add, texture_desc(pixels, 2, 2), change);
  }

 private:
  // An id is given out exactly if the call succeeds.
  template <class Id, class Add, class Desc>
  bdpt_result try_add(Add add, Desc desc, const std::function<void(Desc&)>& change) {
    change(desc);
    Id id{7};
    const bdpt_result result = add(b_, &desc, &id);
    EXPECT_EQ(result == BDPT_OK, id.id != 0);
    return result;
  }
};

}  // namespace bdpt_api
