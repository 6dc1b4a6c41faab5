// Media: what is refused, and who holds them.
#include "api_builder.h"

namespace bdpt_api::api_medium_test {

using ApiMedium = BuilderTest;

TEST_F(ApiMedium, EveryRefusalNamesFieldValueAndRemedy) {
  EXPECT_OK(try_medium([](auto&) {}));
  EXPECT_OK(try_medium([](auto& d) { d = make<bdpt_medium_desc>(); }));
  EXPECT_OK(try_medium([](auto& d) { d.g = -0.9999f; }));
  const auto refused = [&](std::initializer_list<const char*> parts,
                           const std::function<void(bdpt_medium_desc&)>& change) {
    expect_refused(try_medium(change), parts);
    for (const char* part : {"bdpt_medium_add", "medium \"fog\""})
      EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), part)) << bdpt_last_error();
  };
  refused({"sigma_a[0]", "is -1", "from 0 to 1e+09"}, [](auto& d) { d.sigma_a[0] = -1; });
  refused({"sigma_a[1]", "nan", "from 0 to 1e+09"}, [](auto& d) { d.sigma_a[1] = kNan; });
  refused({"sigma_s[2]", "inf", "from 0 to 1e+09"}, [](auto& d) { d.sigma_s[2] = kInfinity; });
  refused({"sigma_s[1]", "is -1", "from 0 to 1e+09"}, [](auto& d) { d.sigma_s[1] = -1; });
  refused({"sigma_s[0]", "is 3e+38", "from 0 to 1e+09"}, [](auto& d) { d.sigma_s[0] = 3e38f; });
  refused({"g of", "is 1", "from -0.9999 to 0.9999"}, [](auto& d) { d.g = 1; });
  refused({"g of", "is -1", "from -0.9999 to 0.9999"}, [](auto& d) { d.g = -1; });
  refused({"g of", "nan", "from -0.9999 to 0.9999"}, [](auto& d) { d.g = kNan; });
  refused({"reserved of", "is 1", "must be 0"}, [](auto& d) { d.reserved = 1; });
  refused({"reserved2", "is 1", "must be 0"}, [](auto& d) { d.reserved2 = 1; });
}

TEST_F(ApiMedium, StaleZeroAndForeignIdsAreRefused) {
  const Builder other = make_builder(context_.get());
  const bdpt_medium_id removed = add_medium(b_), foreign = add_medium(other.get());
  ASSERT_OK(bdpt_medium_remove(b_, removed));
  const bdpt_material_id grey = add_grey(b_);
  const bdpt_medium_desc fog = medium_desc();
  add_point(b_);
  for (const uint64_t bad : {uint64_t(0), removed.id, foreign.id, grey.id, ~uint64_t(0)}) {
    EXPECT_ID(bdpt_medium_remove(b_, {bad}));
    EXPECT_ID(bdpt_medium_update(b_, {bad}, &fog));
    if (bad == 0) continue;
    expect_refused(try_material([&](auto& d) { d.type = BDPT_MATERIAL_DIELECTRIC, d.interior.id = bad; }),
                   {"interior", "medium"}, BDPT_ERROR_INVALID_ID);
    bdpt_build_desc desc = make<bdpt_build_desc>();
    desc.medium.id = bad;
    bdpt_scene* scene = nullptr;
    expect_refused(bdpt_scene_build(b_, &desc, &scene), {"desc.medium", "medium"}, BDPT_ERROR_INVALID_ID);
    EXPECT_EQ(nullptr, scene);
  }
}

TEST_F(ApiMedium, AMediumInUseStays) {
  const bdpt_medium_id first = add_medium(b_), second = add_medium(b_);
  bdpt_material_desc glass = grey_desc();
  glass.type = BDPT_MATERIAL_DIELECTRIC;
  glass.interior = first;
  bdpt_material_id material{};
  ASSERT_OK(bdpt_material_add(b_, &glass, &material));
  expect_refused(bdpt_medium_remove(b_, first), {"\"fog\"", "used by 1 material", "remove or update"},
                 BDPT_ERROR_IN_USE);
  glass.interior = second, glass.ior = -1;
  EXPECT_NE(BDPT_OK, bdpt_material_update(b_, material, &glass));
  EXPECT_IN_USE(bdpt_medium_remove(b_, first));
  glass.ior = 0;
  ASSERT_OK(bdpt_material_update(b_, material, &glass));
  EXPECT_OK(bdpt_medium_remove(b_, first));
  EXPECT_IN_USE(bdpt_medium_remove(b_, second));
  ASSERT_OK(bdpt_material_update(b_, material, &glass));
  ASSERT_OK(bdpt_material_remove(b_, material));
  EXPECT_OK(bdpt_medium_remove(b_, second));
}

TEST_F(ApiMedium, AnUpdateThatFailsChangesNothing) {
  const Contents contents(b_);
  const bdpt_medium_id fog = add_medium(b_);
  bdpt_material_desc glass = grey_desc();
  glass.type = BDPT_MATERIAL_DIELECTRIC;
  glass.interior = fog;
  ASSERT_OK(bdpt_material_update(b_, contents.grey, &glass));
  const Scene scene = build(b_);
  const uint64_t before = scene_hash(scene.get());
  bdpt_medium_desc thicker = medium_desc();
  thicker.sigma_a[0] = 5;
  thicker.g = 2;
  EXPECT_NE(BDPT_OK, bdpt_medium_update(b_, fog, &thicker));
  EXPECT_EQ(before, scene_hash(build(b_).get()));
  thicker.g = 0.5f;
  ASSERT_OK(bdpt_medium_update(b_, fog, &thicker));
  EXPECT_NE(before, scene_hash(build(b_).get()));
  EXPECT_EQ(before, scene_hash(scene.get()));
}

TEST_F(ApiMedium, NoLightComesFromInfinityThroughAMediumThatIsEverywhere) {
  const Contents contents(b_);
  bdpt_light_desc sky = make<bdpt_light_desc>();
  sky.type = BDPT_LIGHT_ENVIRONMENT;
  sky.label = "sky";
  sky.radiance[0] = 1;
  bdpt_light_id light{};
  ASSERT_OK(bdpt_light_add(b_, &sky, &light));
  bdpt_build_desc desc = make<bdpt_build_desc>();
  desc.medium = add_medium(b_);
  bdpt_scene* scene = nullptr;
  expect_refused(bdpt_scene_build(b_, &desc, &scene), {"\"sky\"", "medium", "remove one"});
  ASSERT_OK(bdpt_light_remove(b_, light));
  ASSERT_OK(bdpt_scene_build(b_, &desc, &scene));
  // The scene keeps what it needs.
  ASSERT_OK(bdpt_medium_remove(b_, desc.medium));
  bdpt_scene_release(scene);
}

}  // namespace bdpt_api::api_medium_test
