// Seams: found where they are, closed where both sides have values, and nothing else touched.
#include "lightmap_meshes.h"

#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace bdpt_api::api_lightmap_seams_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Atlas {
  uint32_t width, height, channels;
  std::vector<float> pixels;
  std::vector<uint8_t> mask;  // empty = none is given

  Atlas(uint32_t w, uint32_t h, uint32_t c = 1) : width(w), height(h), channels(c), pixels(size_t(w) * h * c) {}
  AtlasSide side() const { return {float(width), float(height)}; }
  float& at(uint32_t x, uint32_t y, uint32_t c = 0) { return pixels[(size_t(y) * width + x) * channels + c]; }
  void fill(const std::function<float(uint32_t x, uint32_t y, uint32_t c)>& value) {
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x)
        for (uint32_t c = 0; c < channels; ++c) at(x, y, c) = value(x, y, c);
  }
};

bdpt_lightmap_seams_report fix(
    const std::vector<bdpt_uv_instance>& instances, std::vector<Atlas*> atlases,
    const std::function<void(bdpt_lightmap_seams_desc&)>& change = [](auto&) {}) {
  std::vector<bdpt_lightmap_image> images;
  for (Atlas* a : atlases)
    images.push_back({a->pixels.data(), a->pixels.size() * sizeof(float), a->mask.empty() ? nullptr : a->mask.data(),
                      a->mask.size(), a->width, a->height});
  bdpt_lightmap_seams_desc desc = make<bdpt_lightmap_seams_desc>();
  desc.instance_count = uint32_t(instances.size());
  desc.instances = instances.data();
  desc.image_count = uint32_t(images.size());
  desc.images = images.data();
  desc.channels = atlases.at(0)->channels;
  change(desc);
  bdpt_lightmap_seams_report report = make<bdpt_lightmap_seams_report>();
  EXPECT_OK(bdpt_lightmap_fix_seams(&desc, &report));
  return report;
}

bdpt_lightmap_seams_report fix(
    const LightmapMesh& mesh, Atlas& atlas,
    const std::function<void(bdpt_lightmap_seams_desc&)>& change = [](auto&) {}) {
  const bdpt_mesh_desc desc = mesh.desc();
  return fix({uv_instance(desc)}, {&atlas}, change);
}

// Unrolled to texels [4, 60] x [4, 20], cut at angle 0.
LightmapMesh cylinder(const AtlasSide& atlas, bool smooth, int segments = 32) {
  LightmapMesh mesh;
  for (int i = 0; i <= segments; ++i)
    for (int end = 0; end < 2; ++end) {
      const float angle = float(2 * std::numbers::pi * i / segments);
      mesh.positions.push_back({std::cos(angle), std::sin(angle), float(end)});
      mesh.normals.push_back({std::cos(angle), std::sin(angle), 0});
      mesh.uv.push_back(atlas.uv(4 + 56 * float(i) / float(segments), end ? 4 : 20));
    }
  for (uint32_t i = 0; i < uint32_t(segments); ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
  }
  if (!smooth) mesh.normals.clear();
  return mesh;
}

TEST(ApiLightmapSeams, ACylindersSeamClosesAndTheRestStays) {
  Atlas atlas(64, 24, 3);
  atlas.fill([](uint32_t x, uint32_t y, uint32_t c) { return float(x + y * c); });
  Atlas before = atlas;
  const bdpt_lightmap_seams_report r = fix(cylinder(atlas.side(), true), atlas);
  EXPECT_EQ(1u, r.seams);
  EXPECT_EQ(32u, r.samples);
  EXPECT_EQ(0u, r.samples_skipped + r.not_finite);
  EXPECT_EQ(1u, r.converged);
  EXPECT_GT(r.iterations, 0u);
  EXPECT_NEAR(56, r.error_before, 1e-3);
  EXPECT_LT(r.error_after, 0.02 * r.error_before);
  EXPECT_GT(r.error_after, 0);
  uint64_t changed = 0;
  for (uint32_t y = 0; y < 24; ++y)
    for (uint32_t x = 0; x < 64; ++x) {
      const bool near = (x == 3 || x == 4 || x == 59 || x == 60) && y >= 3 && y <= 20;
      for (uint32_t c = 0; c < 3; ++c) EXPECT_EQ(!near, before.at(x, y, c) == atlas.at(x, y, c)) << x << " " << y;
      changed += near;
    }
  EXPECT_EQ(changed, r.texels);
  // Both sides meet half way.
  EXPECT_NEAR(31.5, 0.5f * (atlas.at(3, 12) + atlas.at(4, 12)), 1);
  EXPECT_NEAR(31.5, 0.5f * (atlas.at(59, 12) + atlas.at(60, 12)), 1);
}

TEST(ApiLightmapSeams, TheSameInputGivesTheSameBits) {
  Atlas first(64, 24, 3);
  std::mt19937 random(1);
  for (float& v : first.pixels) v = float(random() % 1000);
  Atlas second = first;
  const LightmapMesh mesh = cylinder(first.side(), true);
  fix(mesh, first);
  fix(mesh, second);
  EXPECT_EQ(first.pixels, second.pixels);
}

TEST(ApiLightmapSeams, WhereBothSidesAgreeNothingChanges) {
  Atlas atlas(64, 24, 2);
  atlas.fill([](uint32_t, uint32_t y, uint32_t c) { return 0.1f * float(y) + float(c); });
  const Atlas before = atlas;
  const bdpt_lightmap_seams_report r = fix(cylinder(atlas.side(), true), atlas);
  EXPECT_EQ(1u, r.seams);
  EXPECT_EQ(1u, r.converged);
  EXPECT_NEAR(0, r.error_before, 1e-6);
  for (size_t i = 0; i < atlas.pixels.size(); ++i) EXPECT_NEAR(before.pixels[i], atlas.pixels[i], 1e-6);
}

TEST(ApiLightmapSeams, FlatTrianglesAreJoinedUpToTheAngle) {
  Atlas atlas(64, 24);
  atlas.fill([](uint32_t x, uint32_t, uint32_t) { return float(x); });
  const LightmapMesh mesh = cylinder(atlas.side(), false, 18);  // 20 degrees from side to side
  EXPECT_EQ(0u, fix(mesh, atlas).seams);
  EXPECT_EQ(0u, fix(mesh, atlas, [](auto& d) { d.angle = 19.9f; }).seams);
  EXPECT_EQ(1u, fix(mesh, atlas, [](auto& d) { d.angle = 20.1f; }).seams);
}

// Two quads side by side in the world, the second turned by half a circle in the atlas. Their common edge is half a
// texel long, and its one sample lies on a row of centres.
LightmapMesh two_quads(const AtlasSide& atlas) {
  LightmapMesh mesh;
  add_quad(mesh, atlas, 2, 2.25f, 6.5f, 2.75f, 1);
  add_quad(mesh, atlas, 10.5f, 6.25f, 15, 6.75f, 1, 4.5f);
  // Half a circle: opposite corners change places.
  std::swap(mesh.uv[4], mesh.uv[6]);
  std::swap(mesh.uv[5], mesh.uv[7]);
  return mesh;
}

TEST(ApiLightmapSeams, ASampleBetweenTwoTexelsIsSolvedExactly) {
  // The edge is at x = 6.5 on one side and, turned, at x = 15 on the other: texels (6, 2), and half (14, 6) and (15,
  // 6).
  Atlas atlas(32, 16);
  atlas.fill([](uint32_t, uint32_t y, uint32_t) { return y < 5 ? 1.0f : 3.0f; });
  for (const float lambda : {0.0f, 0.5f}) {
    Atlas fixed = atlas;
    const bdpt_lightmap_seams_report r = fix(two_quads(atlas.side()), fixed, [&](auto& d) { d.lambda = lambda; });
    EXPECT_EQ(1u, r.seams);
    EXPECT_EQ(1u, r.samples);
    EXPECT_EQ(3u, r.texels);
    EXPECT_NEAR(2, r.error_before, 1e-6);
    // One row of least squares, a = (1, -1/2, -1/2), |a|^2 = 3/2, and weight 1/2.
    const double l = lambda > 0 ? double(lambda) : 0.01, error = 2 * l / (l + 0.5 * 1.5), pull = (2 - error) / 1.5;
    EXPECT_NEAR(error, r.error_after, 1e-5);
    EXPECT_NEAR(1 + pull, fixed.at(6, 2), 1e-5);
    EXPECT_NEAR(3 - pull / 2, fixed.at(14, 6), 1e-5);
    EXPECT_NEAR(3 - pull / 2, fixed.at(15, 6), 1e-5);
  }
}

TEST(ApiLightmapSeams, SidesThatRunTheOtherWayAreComparedPointByPoint) {
  // Along the edge both sides have the same values, from opposite ends.
  LightmapMesh mesh;
  const AtlasSide side{40, 20};
  add_quad(mesh, side, 2, 2, 10, 18, 1);
  add_quad(mesh, side, 20, 2, 28, 18, 1, 8);
  std::swap(mesh.uv[4], mesh.uv[6]);
  std::swap(mesh.uv[5], mesh.uv[7]);
  Atlas atlas(40, 20);
  atlas.fill([](uint32_t x, uint32_t y, uint32_t) { return x < 15 ? float(y) : 19 - float(y); });
  const bdpt_lightmap_seams_report r = fix(mesh, atlas);
  EXPECT_EQ(1u, r.seams);
  EXPECT_NEAR(0, r.error_before, 1e-4);
}

TEST(ApiLightmapSeams, InstancesInTheirOwnAtlasesAreJoined) {
  Atlas left(20, 20, 2), right(40, 16, 2);
  left.fill([](uint32_t, uint32_t, uint32_t c) { return 1 + float(c); });
  right.fill([](uint32_t, uint32_t, uint32_t c) { return 5 + float(c); });
  LightmapMesh mesh;
  add_quad(mesh, {16, 16}, 2, 2, 14, 14, 1);
  const bdpt_mesh_desc desc = mesh.desc();
  bdpt_uv_instance a = uv_instance(desc), b = a;
  b.atlas = 1;
  b.uv_scale[0] = 0.5f, b.uv_scale[1] = 1, b.uv_offset[0] = 0.25f;
  const float moved[12] = {1, 0, 0, 12, 0, 1, 0, 0, 0, 0, 1, 0};
  std::memcpy(b.transform, moved, sizeof moved);
  const bdpt_lightmap_seams_report r = fix({a, b}, {&left, &right});
  EXPECT_EQ(1u, r.seams);
  EXPECT_NEAR(4, r.error_before, 1e-5);
  EXPECT_LT(r.error_after, 0.1);
  // 14/16 of 20 texels, and 10 + 2/16 of 20 texels.
  EXPECT_GT(left.at(17, 10), 2);
  EXPECT_LT(right.at(12, 8), 4);
  EXPECT_GT(left.at(17, 10, 1), 3);
  EXPECT_EQ(1, left.at(5, 10));
  EXPECT_EQ(5, right.at(20, 8));
}

TEST(ApiLightmapSeams, ReflectedInstancesKeepTheirFronts) {
  // One square and its mirror image make a rectangle whose front is one side.
  Atlas atlas(40, 20);
  atlas.fill([](uint32_t x, uint32_t, uint32_t) { return x < 20 ? 1.0f : 2.0f; });
  for (const bool normals : {false, true}) {
    LightmapMesh mesh;
    add_quad(mesh, {20, 20}, 2, 2, 18, 18, 1);
    if (normals) mesh.normals.assign(4, {0, 0, 2});
    const bdpt_mesh_desc desc = mesh.desc();
    bdpt_uv_instance a = uv_instance(desc), b = a;
    a.uv_scale[0] = b.uv_scale[0] = 0.5f, a.uv_scale[1] = b.uv_scale[1] = 1, b.uv_offset[0] = 0.5f;
    const float mirrored[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    std::memcpy(b.transform, mirrored, sizeof mirrored);
    Atlas fixed = atlas;
    EXPECT_EQ(1u, fix({a, b}, {&fixed}).seams);
    // Seen from behind, it is another surface.
    const float turned[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0};
    std::memcpy(b.transform, turned, sizeof turned);
    EXPECT_EQ(0u, fix({a, b}, {&fixed}).seams);
  }
}

TEST(ApiLightmapSeams, NormalsAreReflectedWithTheirMesh) {
  Atlas atlas(40, 20);
  LightmapMesh mesh;
  add_quad(mesh, {20, 20}, 2, 2, 18, 18, 1);
  const float mirrored[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const auto seams = [&](float nx, float ny) {
    mesh.normals.assign(4, {nx, ny, 2});
    const bdpt_mesh_desc desc = mesh.desc();
    bdpt_uv_instance a = uv_instance(desc), b = a;
    a.uv_scale[0] = b.uv_scale[0] = 0.5f, a.uv_scale[1] = b.uv_scale[1] = 1, b.uv_offset[0] = 0.5f;
    std::memcpy(b.transform, mirrored, sizeof mirrored);
    return fix({a, b}, {&atlas}).seams;
  };
  EXPECT_EQ(1u, seams(0, 1));
  EXPECT_EQ(0u, seams(1, 0));  // they lean apart
}

TEST(ApiLightmapSeams, CornersAreOneWithinTheTolerance) {
  Atlas atlas(40, 20);
  LightmapMesh mesh;
  add_quad(mesh, atlas.side(), 2, 2, 10, 18, 1);
  add_quad(mesh, atlas.side(), 20, 2, 28, 18, 1, 8.01f);
  EXPECT_EQ(0u, fix(mesh, atlas).seams);
  EXPECT_EQ(0u, fix(mesh, atlas, [](auto& d) { d.position_tolerance = 0.009f; }).seams);
  EXPECT_EQ(1u, fix(mesh, atlas, [](auto& d) { d.position_tolerance = 0.011f; }).seams);
}

TEST(ApiLightmapSeams, TexelsWithoutValueAreNeitherReadNorWritten) {
  for (const bool by_mask : {true, false}) {
    Atlas atlas(64, 24, 2);
    atlas.fill([](uint32_t x, uint32_t, uint32_t) { return float(x); });
    if (by_mask) {
      atlas.mask.assign(64 * 24, 1);
      atlas.mask[10 * 64 + 4] = 0;
    }
    atlas.at(4, 10, 1) = kNan;
    const bdpt_lightmap_seams_report r = fix(cylinder(atlas.side(), true), atlas);
    EXPECT_EQ(4u, r.samples_skipped);  // two in its own row, one in each beside it
    EXPECT_EQ(28u, r.samples);
    EXPECT_EQ(by_mask ? 0u : 1u, r.not_finite);
    EXPECT_LT(r.error_after, 0.02 * r.error_before);
    size_t not_finite = 0;
    for (const float v : atlas.pixels) not_finite += !std::isfinite(v);
    EXPECT_EQ(1u, not_finite);
    EXPECT_EQ(4, atlas.at(4, 10, 0));
  }
}

TEST(ApiLightmapSeams, WhatLiesOutsideTheAtlasIsLeftOut) {
  Atlas atlas(64, 24);
  atlas.fill([](uint32_t x, uint32_t, uint32_t) { return float(x); });
  const LightmapMesh mesh = cylinder(atlas.side(), true);
  const bdpt_mesh_desc whole = mesh.desc();
  bdpt_uv_instance instance = uv_instance(whole);
  instance.uv_scale[0] = instance.uv_scale[1] = 1;
  instance.uv_offset[1] = 0.5f;  // twelve texels up: rows -8 to 8
  const bdpt_lightmap_seams_report r = fix({instance}, {&atlas});
  EXPECT_EQ(16u, r.samples);
  EXPECT_EQ(16u, r.samples_skipped);
  instance.uv_scale[0] = 1e30f;
  EXPECT_EQ(0u, fix({instance}, {&atlas}).samples);
}

TEST(ApiLightmapSeams, RunningOutOfIterationsIsToldAndStillHelps) {
  Atlas atlas(64, 24);
  std::mt19937 random(1);
  for (float& v : atlas.pixels) v = float(random() % 1000);
  const bdpt_lightmap_seams_report r = fix(cylinder(atlas.side(), true), atlas, [](auto& d) { d.max_iterations = 1; });
  EXPECT_EQ(0u, r.converged);
  EXPECT_EQ(1u, r.iterations);
  EXPECT_LT(r.error_after, r.error_before);
}

TEST(ApiLightmapSeams, AClosedSurfaceWithOneChartHasNone) {
  Atlas atlas(32, 32);
  LightmapMesh mesh;
  add_quad(mesh, atlas.side(), 2, 2, 30, 30, 1);
  const bdpt_lightmap_seams_report r = fix(mesh, atlas);
  EXPECT_EQ(0u, r.seams + r.samples + r.texels);
  EXPECT_EQ(1u, r.converged);
  EXPECT_EQ(0, r.error_before);
}

TEST(ApiLightmapSeams, TrianglesWithoutAreaMakeNone) {
  Atlas atlas(32, 32);
  LightmapMesh mesh;
  add_triangle(mesh, atlas.side(), {{{2, 2}, {2, 10}, {10, 2}}});
  add_triangle(mesh, atlas.side(), {{{22, 2}, {22, 10}, {30, 2}}});
  mesh.positions[3] = mesh.positions[0];
  mesh.positions[4] = mesh.positions[1];
  EXPECT_EQ(1u, fix(mesh, atlas).seams);
  LightmapMesh thin = mesh;
  thin.positions[5] = mesh.positions[1];
  EXPECT_EQ(0u, fix(thin, atlas).seams);
  thin.normals.assign(6, {0, 0, 1});
  EXPECT_EQ(0u, fix(thin, atlas).seams);
  thin = mesh;
  thin.uv[5] = mesh.uv[4];
  EXPECT_EQ(0u, fix(thin, atlas).seams);
}

TEST(ApiLightmapSeams, AnUnwrappedModelsSeamsCloseByTheStatedFactor) {
  LightmapMesh mesh = read_obj(BDPT_SHARED_DIR "/scenes/lightmap/ands-gazebo/gazebo.obj");
  if (mesh.positions.empty()) GTEST_SKIP() << "no shared scenes";
  Atlas atlas(654, 654);
  std::mt19937 random(1);
  for (float& v : atlas.pixels) v = float(random() % 1000) / 1000;
  const Atlas before = atlas;
  const bdpt_lightmap_seams_report r = fix(mesh, atlas);
  EXPECT_GT(r.seams, 50u);
  EXPECT_EQ(1u, r.converged);
  EXPECT_LT(r.error_after, 0.1 * r.error_before);
  uint64_t changed = 0;
  for (size_t i = 0; i < atlas.pixels.size(); ++i) changed += atlas.pixels[i] != before.pixels[i];
  EXPECT_LE(changed, r.texels);
}

TEST(ApiLightmapSeams, BadInputIsRefusedAndNothingWritten) {
  struct Input {
    Atlas atlas{64, 24};
    LightmapMesh mesh = cylinder(atlas.side(), true);
    bdpt_mesh_desc mesh_desc = mesh.desc();
    bdpt_uv_instance instance = uv_instance(mesh_desc);
    std::vector<uint8_t> mask = std::vector<uint8_t>(64 * 24, 1);
    bdpt_lightmap_image image{atlas.pixels.data(), 64 * 24 * 4, mask.data(), mask.size(), 64, 24};
    bdpt_lightmap_seams_desc desc = make<bdpt_lightmap_seams_desc>();
  };
  const auto refused = [](const char* word, const std::function<void(Input&)>& change) {
    SCOPED_TRACE(word);
    Input in;
    in.atlas.fill([](uint32_t x, uint32_t, uint32_t) { return float(x); });
    const std::vector<float> before = in.atlas.pixels;
    in.desc.instance_count = in.desc.image_count = in.desc.channels = 1;
    in.desc.instances = &in.instance;
    in.desc.images = &in.image;
    change(in);
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_fix_seams(&in.desc, nullptr));
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), word)) << bdpt_last_error();
    EXPECT_EQ(before, in.atlas.pixels);
  };
  refused("instance_count", [](Input& in) { in.desc.instance_count = 0; });
  refused("desc.instances", [](Input& in) { in.desc.instances = nullptr; });
  refused("instance_stride", [](Input& in) { in.desc.instance_stride = 81; });
  refused("image_count", [](Input& in) { in.desc.image_count = 0; });
  refused("desc.images", [](Input& in) { in.desc.images = nullptr; });
  refused("image_stride", [](Input& in) { in.desc.image_stride = 32; });
  refused("channels", [](Input& in) { in.desc.channels = 0; });
  refused("channels", [](Input& in) { in.desc.channels = 4097; });
  refused("capacity", [](Input& in) { in.desc.channels = 2; });
  refused("capacity", [](Input& in) { --in.image.capacity; });
  refused("mask_capacity", [](Input& in) { --in.image.mask_capacity; });
  refused("pixels", [](Input& in) { in.image.pixels = nullptr; });
  refused("width", [](Input& in) { in.image.width = 0; });
  refused("height", [](Input& in) { in.image.height = 0; });
  refused("atlas", [](Input& in) { in.instance.atlas = 1; });
  refused("position_tolerance", [](Input& in) { in.desc.position_tolerance = -1; });
  refused("position_tolerance", [](Input& in) { in.desc.position_tolerance = kNan; });
  refused("angle", [](Input& in) { in.desc.angle = 181; });
  refused("angle", [](Input& in) { in.desc.angle = kNan; });
  refused("lambda", [](Input& in) { in.desc.lambda = -1; });
  refused("lambda", [](Input& in) { in.desc.lambda = 2e6f; });
  refused("lambda", [](Input& in) { in.desc.lambda = kNan; });
  refused("mesh", [](Input& in) { in.instance.mesh = nullptr; });
  refused("uv[1]", [](Input& in) { in.mesh.uv[3][0] = kNan; });
  refused("indices", [](Input& in) { in.mesh.triangles[3][0] = 66; });
  refused("normals", [](Input& in) { in.mesh.normals[3] = {}; });
}

}  // namespace bdpt_api::api_lightmap_seams_test
