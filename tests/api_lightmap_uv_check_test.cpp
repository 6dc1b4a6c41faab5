// Lightmap coordinates: what is found, by hand-made layouts, and what is refused.
#include "lightmap_meshes.h"

#include <functional>
#include <limits>
#include <numeric>

namespace bdpt_api::api_lightmap_uv_check_test {

constexpr uint32_t kWidth = 32, kHeight = 16;
constexpr AtlasSide kAtlas{kWidth, kHeight};

struct Check {
  std::vector<uint32_t> triangle_charts, texel_charts, texel_claims, texel_overlaps;
  bdpt_uv_report report = make<bdpt_uv_report>();
};

Check check(
    const std::vector<bdpt_uv_instance>& instances,
    const std::function<void(bdpt_uv_check_desc&)>& change = [](auto&) {}) {
  bdpt_uv_check_desc desc = make<bdpt_uv_check_desc>();
  desc.instance_count = uint32_t(instances.size());
  desc.instances = instances.data();
  desc.width = kWidth;
  desc.height = kHeight;
  change(desc);
  Check result;
  size_t triangles = 0;
  for (const bdpt_uv_instance& i : instances) triangles += size_t(i.mesh->indices.count);
  const size_t texels = size_t(desc.width) * desc.height;
  bdpt_uv_maps maps = make<bdpt_uv_maps>();
  const auto buffer = [](std::vector<uint32_t>& values, size_t n, uint32_t*& data, uint64_t& capacity) {
    values.assign(n, 77);
    data = values.data();
    capacity = n * sizeof(uint32_t);
  };
  buffer(result.triangle_charts, triangles, maps.triangle_charts, maps.triangle_charts_capacity);
  buffer(result.texel_charts, texels, maps.texel_charts, maps.texel_charts_capacity);
  buffer(result.texel_claims, texels, maps.texel_claims, maps.texel_claims_capacity);
  buffer(result.texel_overlaps, texels, maps.texel_overlaps, maps.texel_overlaps_capacity);
  EXPECT_OK(bdpt_uv_check(&desc, &maps, &result.report));
  return result;
}

Check check(
    const LightmapMesh& mesh, const std::function<void(bdpt_uv_check_desc&)>& change = [](auto&) {}) {
  const bdpt_mesh_desc desc = mesh.desc();
  return check(std::vector{uv_instance(desc)}, change);
}

uint64_t sum(const std::vector<uint32_t>& v) { return std::accumulate(v.begin(), v.end(), uint64_t(0)); }

TEST(ApiLightmapUvCheck, AQuadInTwoChartsIsFoundAsItIs) {
  LightmapMesh mesh;
  add_quad(mesh, kAtlas, 2, 3, 10, 13, 0.5f);
  add_quad(mesh, kAtlas, 13, 3, 20, 13, 0.5f, 4);
  const Check c = check(mesh);
  EXPECT_EQ(4u, c.report.triangles);
  EXPECT_EQ(2u, c.report.charts);
  EXPECT_EQ(3, c.report.padding);
  EXPECT_EQ(80u + 70u, c.report.texels_claimed);
  EXPECT_EQ(0u, c.report.texels_shared);
  EXPECT_EQ(0u, c.report.outside_rect + c.report.outside_atlas);
  EXPECT_EQ(0u, c.report.zero_area_uv + c.report.zero_area_world + c.report.mirrored);
  EXPECT_EQ(0u, c.report.overlaps_within + c.report.overlaps_between + c.report.overlaps_cut);
  EXPECT_EQ(0, c.report.overlap_area_within + c.report.overlap_area_between);
  EXPECT_NEAR(2, c.report.density_min, 1e-5);
  EXPECT_NEAR(2, c.report.density_mean, 1e-5);
  EXPECT_NEAR(2, c.report.density_max, 1e-5);
  EXPECT_EQ((std::vector<uint32_t>{1, 1, 2, 2}), c.triangle_charts);
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      const bool rows = y >= 3 && y < 13;
      const uint32_t chart = rows && x >= 2 && x < 10 ? 1 : rows && x >= 13 && x < 20 ? 2 : 0;
      EXPECT_EQ(chart, c.texel_charts[y * kWidth + x]) << x << " " << y;
      EXPECT_EQ(chart ? 1u : 0u, c.texel_claims[y * kWidth + x]) << x << " " << y;
    }
  EXPECT_EQ(0u, sum(c.texel_overlaps));
}

TEST(ApiLightmapUvCheck, PaddingIsFoundAsFarAsItIsLookedFor) {
  for (const uint32_t reach : {1u, 4u, 5u, 16u})
    for (int dx = 0; dx <= 17; ++dx)
      for (int dy = 0; dy <= 7; ++dy) {
        LightmapMesh mesh;
        add_quad(mesh, kAtlas, 1, 1, 5, 4, 1);
        add_quad(mesh, kAtlas, float(5 + dx), float(4 + dy), float(8 + dx), float(6 + dy), 1, 100);
        const int padding = std::max(dx, dy);
        const bdpt_uv_report r = check(mesh, [&](auto& d) { d.padding_reach = reach; }).report;
        EXPECT_EQ(padding <= int(reach) ? padding : -1, r.padding) << dx << " " << dy << " " << reach;
      }
}

TEST(ApiLightmapUvCheck, ATexelOfTwoChartsIsSharedWithoutOverlap) {
  LightmapMesh mesh;
  add_quad(mesh, kAtlas, 2, 3, 10.25f, 13, 1);
  add_quad(mesh, kAtlas, 10.25f, 3, 20, 13, 1, 100);
  const Check c = check(mesh);
  EXPECT_EQ(10u, c.report.texels_shared);
  EXPECT_EQ(0, c.report.padding);
  EXPECT_EQ(0u, c.report.overlaps_between);
  EXPECT_EQ(2u, c.texel_claims[5 * kWidth + 10]);
  EXPECT_EQ(2u, c.texel_charts[5 * kWidth + 10]);  // three quarters of it
}

TEST(ApiLightmapUvCheck, AChartWithinATexelOfAnotherLeavesNoPadding) {
  LightmapMesh mesh;
  add_quad(mesh, kAtlas, 2, 3, 10.25f, 13, 1);
  add_quad(mesh, kAtlas, 10.5f, 5.25f, 10.75f, 5.5f, 1, 100);
  const Check c = check(mesh);
  EXPECT_EQ(1u, c.report.texels_shared);
  EXPECT_EQ(1u, c.texel_charts[5 * kWidth + 10]);
  EXPECT_EQ(0, c.report.padding);
}

TEST(ApiLightmapUvCheck, APairOverlapsInATexelOnce) {
  // A star of two triangles: they share a hexagon.
  LightmapMesh mesh;
  add_triangle(mesh, kAtlas, {{{4.3f, 4.2f}, {8.2f, 10.7f}, {12.1f, 4.2f}}});
  add_triangle(mesh, kAtlas, {{{8.2f, 2.1f}, {4.3f, 8.6f}, {12.1f, 8.6f}}}, 1);
  const Check c = check(mesh);
  EXPECT_EQ(1u, c.report.overlaps_between);
  EXPECT_GT(sum(c.texel_overlaps), c.report.overlap_area_between);
  for (const uint32_t n : c.texel_overlaps) EXPECT_LE(n, 1u);
}

TEST(ApiLightmapUvCheck, RoundingClaimsNoTexelButAHundredthDoes) {
  for (const float beyond : {1e-4f, 1e-2f}) {
    LightmapMesh mesh;
    add_quad(mesh, kAtlas, 2, 3, 10 + beyond, 13, 1);
    EXPECT_EQ(beyond < 1e-3f ? 80u : 90u, check(mesh).report.texels_claimed);
  }
}

TEST(ApiLightmapUvCheck, AFoldWithinAChartOverlapsByTheAreaBothShare) {
  // Two triangles on the same side of their common edge: they share the one with corners (4,4), (12,4), (8,8).
  LightmapMesh mesh;
  add_triangle(mesh, kAtlas, {{{4, 4}, {4, 12}, {12, 4}}});
  add_triangle(mesh, kAtlas, {{{4, 4}, {12, 4}, {12, 12}}});
  const Check c = check(mesh);
  EXPECT_EQ(1u, c.report.charts);
  EXPECT_EQ(1u, c.report.overlaps_within);
  EXPECT_EQ(0u, c.report.overlaps_between);
  EXPECT_NEAR(16, c.report.overlap_area_within, 1e-5);
  EXPECT_EQ(1u, c.report.mirrored);
  EXPECT_EQ(0u, c.report.texels_shared);
  // Rows of 8, 6, 4 and 2 texels.
  EXPECT_EQ(20u, sum(c.texel_overlaps));
  EXPECT_EQ(1u, c.texel_overlaps[4 * kWidth + 4]);
  EXPECT_EQ(0u, c.texel_overlaps[8 * kWidth + 8]);
}

TEST(ApiLightmapUvCheck, TrianglesOfTwoChartsOverlapByTheAreaBothShare) {
  LightmapMesh mesh;
  add_quad(mesh, kAtlas, 2, 2, 10, 10, 1);
  add_quad(mesh, kAtlas, 7, 8, 12, 14, 1, 100);
  const Check c = check(mesh);
  EXPECT_EQ(2u, c.report.charts);
  EXPECT_EQ(0u, c.report.overlaps_within);
  EXPECT_NEAR(6, c.report.overlap_area_between, 1e-5);
  EXPECT_EQ(6u, c.report.texels_shared);
  EXPECT_EQ(0, c.report.padding);
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      const bool both = x >= 7 && x < 10 && y >= 8 && y < 10;
      EXPECT_EQ(both, c.texel_overlaps[y * kWidth + x] > 0) << x << " " << y;
    }
}

TEST(ApiLightmapUvCheck, NeighboursWithRoundedCornersDoNotOverlap) {
  // A fan of thin triangles whose corners are of no exact binary value.
  LightmapMesh mesh;
  for (int i = 0; i < 90; ++i) {
    const auto corner = [](int k) -> std::array<float, 2> {
      return {15.3f + 7.1f * std::cos(0.0697f * float(k)), 8.1f + 7.1f * std::sin(0.0697f * float(k))};
    };
    add_triangle(mesh, kAtlas, {{{15.3f, 8.1f}, corner(i + 1), corner(i)}});
  }
  const bdpt_uv_report r = check(mesh).report;
  EXPECT_EQ(1u, r.charts);
  EXPECT_EQ(0u, r.overlaps_within);
}

TEST(ApiLightmapUvCheck, TrianglesWithoutAreaAreCounted) {
  LightmapMesh mesh;
  add_quad(mesh, kAtlas, 2, 2, 10, 10, 1);
  const auto quad = mesh;
  mesh.triangles.push_back({0, 1, 1});                        // neither area
  add_triangle(mesh, kAtlas, {{{12, 2}, {14, 2}, {13, 4}}});  // no area in the world
  mesh.positions[6] = mesh.positions[5];
  add_triangle(mesh, kAtlas, {{{20, 2}, {24, 2}, {22, 4}}});  // none in the atlas
  mesh.uv[9] = mesh.uv[8];
  const bdpt_uv_report r = check(mesh).report;
  EXPECT_EQ(5u, r.triangles);
  EXPECT_EQ(2u, r.zero_area_uv);
  EXPECT_EQ(2u, r.zero_area_world);
  EXPECT_EQ(0u, r.overlaps_within + r.overlaps_between);
  EXPECT_FLOAT_EQ(check(quad).report.density_mean, r.density_mean);
}

TEST(ApiLightmapUvCheck, DensityIsThatOfEachTriangleAndOfAll) {
  LightmapMesh mesh;
  add_quad(mesh, kAtlas, 0, 0, 4, 4, 1);            // 16 texels on 16
  add_quad(mesh, kAtlas, 8, 0, 12, 4, 0.25f, 100);  // 16 texels on 1
  const bdpt_uv_report r = check(mesh).report;
  EXPECT_NEAR(1, r.density_min, 1e-5);
  EXPECT_NEAR(4, r.density_max, 1e-5);
  EXPECT_NEAR(std::sqrt(32.0 / 17), r.density_mean, 1e-5);
}

TEST(ApiLightmapUvCheck, ATransformChangesTheDensityAndAReflectionTheSide) {
  LightmapMesh mesh;
  add_quad(mesh, kAtlas, 0, 0, 4, 4, 1);
  const bdpt_mesh_desc desc = mesh.desc();
  bdpt_uv_instance instance = uv_instance(desc);
  const float larger[12] = {2, 0, 0, 5, 0, 2, 0, 0, 0, 0, 3, 0}, reflected[12] = {-2, 0, 0, 5, 0, 2, 0, 0, 0, 0, 3, 0};
  std::memcpy(instance.transform, larger, sizeof larger);
  EXPECT_NEAR(0.5, check({instance}).report.density_mean, 1e-6);
  EXPECT_EQ(0u, check({instance}).report.mirrored);
  std::memcpy(instance.transform, reflected, sizeof reflected);
  EXPECT_EQ(2u, check({instance}).report.mirrored);
  instance.uv_scale[0] = -1, instance.uv_scale[1] = 1, instance.uv_offset[0] = 1;
  EXPECT_EQ(0u, check({instance}).report.mirrored);
  EXPECT_EQ(0u, check({instance}).report.outside_rect);
}

TEST(ApiLightmapUvCheck, InstancesInOneRectangleOverlapAndInTheirOwnDoNot) {
  LightmapMesh mesh;
  add_quad(mesh, {16, 16}, 2, 2, 14, 14, 1);
  const bdpt_mesh_desc desc = mesh.desc();
  std::vector<bdpt_uv_instance> instances(2, uv_instance(desc));
  for (bdpt_uv_instance& i : instances) i.uv_scale[0] = 0.5f, i.uv_scale[1] = 1;
  const Check twice = check(instances);
  EXPECT_EQ(2u, twice.report.charts);
  EXPECT_NEAR(144, twice.report.overlap_area_between, 1e-4);
  EXPECT_EQ(144u, twice.report.texels_shared);
  EXPECT_EQ((std::vector<uint32_t>{1, 1, 2, 2}), twice.triangle_charts);
  instances[1].uv_offset[0] = 0.5f;
  const Check apart = check(instances);
  EXPECT_EQ(0u, apart.report.overlaps_between + apart.report.outside_rect + apart.report.outside_atlas);
  EXPECT_EQ(4, apart.report.padding);
  EXPECT_EQ(288u, apart.report.texels_claimed);
  instances[1].uv_offset[0] = 0;
  instances[1].atlas = 1;
  const Check elsewhere = check(instances);
  EXPECT_EQ(2u, elsewhere.report.triangles);
  EXPECT_EQ(0u, elsewhere.report.overlaps_between);
  EXPECT_EQ((std::vector<uint32_t>{1, 1, 0, 0}), elsewhere.triangle_charts);
  const Check other = check(instances, [](auto& d) { d.atlas = 1; });
  EXPECT_EQ((std::vector<uint32_t>{0, 0, 1, 1}), other.triangle_charts);
}

TEST(ApiLightmapUvCheck, WhatLeavesTheRectangleOrTheAtlasIsCounted) {
  LightmapMesh mesh;
  add_quad(mesh, {16, 16}, 2, 2, 17, 14, 1);
  const bdpt_mesh_desc desc = mesh.desc();
  bdpt_uv_instance instance = uv_instance(desc);
  instance.uv_scale[0] = 0.5f, instance.uv_scale[1] = 1;
  EXPECT_EQ(2u, check({instance}).report.outside_rect);
  EXPECT_EQ(0u, check({instance}).report.outside_atlas);
  instance.uv_offset[0] = 0.5f;
  EXPECT_EQ(2u, check({instance}).report.outside_atlas);
}

TEST(ApiLightmapUvCheck, TheSearchForOverlapsEndsWhereItIsToldTo) {
  LightmapMesh mesh;
  for (int i = 0; i < 6; ++i) add_triangle(mesh, kAtlas, {{{4, 4}, {12, 4}, {4, 12}}}, float(i));
  bdpt_uv_report r = check(mesh).report;
  EXPECT_EQ(15u, r.overlaps_between);
  EXPECT_NEAR(15 * 32, r.overlap_area_between, 1e-3);
  EXPECT_EQ(0u, r.overlaps_cut);
  r = check(mesh, [](auto& d) { d.max_overlaps = 15; }).report;
  EXPECT_EQ(0u, r.overlaps_cut);
  r = check(mesh, [](auto& d) { d.max_overlaps = 14; }).report;
  EXPECT_EQ(14u, r.overlaps_between);
  EXPECT_EQ(1u, r.overlaps_cut);
}

TEST(ApiLightmapUvCheck, EveryIndexFormatAndStrideIsTheSame) {
  LightmapMesh mesh;
  add_quad(mesh, kAtlas, 2, 3, 10, 13, 0.5f);
  bdpt_mesh_desc desc = mesh.desc();
  const Check expected = check({uv_instance(desc)});
  const uint16_t narrow[2][3] = {{0, 1, 2}, {0, 2, 3}};
  desc.indices = view(narrow, 2, BDPT_FORMAT_UINT16X3);
  EXPECT_EQ(expected.texel_charts, check({uv_instance(desc)}).texel_charts);
  struct Vertex {
    float p[3], uv[2], more;
  } vertices[4];
  for (size_t i = 0; i < 4; ++i) {
    std::memcpy(vertices[i].p, mesh.positions[i].data(), sizeof vertices[i].p);
    std::memcpy(vertices[i].uv, mesh.uv[i].data(), sizeof vertices[i].uv);
  }
  desc.positions = view(vertices[0].p, 4, BDPT_FORMAT_FLOAT3);
  desc.uv[1] = view(vertices[0].uv, 4, BDPT_FORMAT_FLOAT2);
  desc.positions.stride = desc.uv[1].stride = sizeof(Vertex);
  EXPECT_EQ(expected.texel_charts, check({uv_instance(desc)}).texel_charts);
}

TEST(ApiLightmapUvCheck, ReleasesOfTheMeshAreNotCalled) {
  LightmapMesh mesh;
  add_quad(mesh, kAtlas, 2, 3, 10, 13, 0.5f);
  bdpt_mesh_desc desc = mesh.desc();
  int released = 0;
  for (bdpt_data* d : {&desc.positions, &desc.indices, &desc.uv[1]}) {
    d->user = &released;
    d->release = [](void* user, const void*) { ++*static_cast<int*>(user); };
  }
  check({uv_instance(desc)});
  EXPECT_EQ(0, released);
}

struct Refusal {
  LightmapMesh mesh;
  bdpt_mesh_desc mesh_desc{};
  bdpt_uv_instance instance{};
  bdpt_uv_check_desc desc = make<bdpt_uv_check_desc>();
  std::vector<uint32_t> buffer = std::vector<uint32_t>(kWidth * kHeight, 77);
  bdpt_uv_maps maps = make<bdpt_uv_maps>();
  bdpt_uv_report report = make<bdpt_uv_report>();

  Refusal() {
    add_quad(mesh, kAtlas, 2, 3, 10, 13, 0.5f);
    mesh_desc = mesh.desc();
    instance = uv_instance(mesh_desc);
    desc.instance_count = 1;
    desc.instances = &instance;
    desc.width = kWidth, desc.height = kHeight;
    maps.texel_charts = buffer.data();
    maps.texel_charts_capacity = buffer.size() * sizeof(uint32_t);
  }
};

void expect_refused(const char* word, const std::function<void(Refusal&)>& change) {
  SCOPED_TRACE(word);
  Refusal r;
  change(r);
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_uv_check(&r.desc, &r.maps, &r.report));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), word)) << bdpt_last_error();
  EXPECT_EQ(std::vector<uint32_t>(r.buffer.size(), 77), r.buffer);
  EXPECT_EQ(0u, r.report.triangles);
}

TEST(ApiLightmapUvCheck, BadInputIsRefusedAndNothingWritten) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
  Refusal good;
  EXPECT_OK(bdpt_uv_check(&good.desc, &good.maps, &good.report));
  EXPECT_OK(bdpt_uv_check(&good.desc, nullptr, &good.report));
  expect_refused("width", [](Refusal& r) { r.desc.width = 0; });
  expect_refused("height", [](Refusal& r) { r.desc.height = 0; });
  expect_refused("width", [](Refusal& r) { r.desc.width = 65537; });
  expect_refused("texels", [](Refusal& r) { r.desc.width = r.desc.height = 65536; });
  expect_refused("padding_reach", [](Refusal& r) { r.desc.padding_reach = 1025; });
  expect_refused("reserved", [](Refusal& r) { r.desc.reserved = 1; });
  expect_refused("instance_count", [](Refusal& r) { r.desc.instance_count = 0; });
  expect_refused("instances", [](Refusal& r) { r.desc.instances = nullptr; });
  expect_refused("instance_stride", [](Refusal& r) { r.desc.instance_stride = 72; });
  expect_refused("instance_stride", [](Refusal& r) { r.desc.instance_stride = 84; });
  expect_refused("reserved", [](Refusal& r) { r.instance.reserved = 1; });
  expect_refused("instances[0].mesh", [](Refusal& r) { r.instance.mesh = nullptr; });
  expect_refused("struct_size", [](Refusal& r) { r.mesh_desc.struct_size = 0; });
  expect_refused("transform", [](Refusal& r) { r.instance.transform[0] = 1; });
  expect_refused("transform", [](Refusal& r) {
    const float far[12] = {1e30f, 0, 0, 0, 0, 1e30f, 0, 0, 0, 0, 1e30f, 0};
    std::memcpy(r.instance.transform, far, sizeof far);
  });
  expect_refused("uv_scale", [](Refusal& r) { r.instance.uv_scale[0] = 1; });
  expect_refused("uv_scale", [](Refusal& r) { r.instance.uv_scale[0] = r.instance.uv_scale[1] = kNan; });
  expect_refused("uv_offset", [](Refusal& r) { r.instance.uv_offset[1] = kInfinity; });
  expect_refused("uv[1].count", [](Refusal& r) { r.mesh_desc.uv[1] = {}; });
  expect_refused("uv[1].count", [](Refusal& r) { r.mesh_desc.uv[1].count = 3; });
  expect_refused("uv[1]", [](Refusal& r) { r.mesh.uv[2][1] = kNan; });
  expect_refused("uv[1]", [](Refusal& r) { r.mesh.uv[2][0] = kInfinity; });
  expect_refused("positions", [](Refusal& r) { r.mesh.positions[2][0] = kNan; });
  expect_refused("positions.count", [](Refusal& r) { r.mesh_desc.positions.count = 2; });
  expect_refused("positions.count", [](Refusal& r) { r.mesh_desc.indices = {}; });
  expect_refused("indices", [](Refusal& r) { r.mesh.triangles[1][2] = 4; });
  expect_refused("indices", [](Refusal& r) { r.mesh.triangles[1][2] = ~0u; });
  expect_refused("normals.count", [](Refusal& r) {
    r.mesh_desc.normals = r.mesh_desc.positions;
    r.mesh_desc.normals.count = 3;
  });
  expect_refused("length zero", [](Refusal& r) { r.mesh_desc.normals = r.mesh_desc.positions; });
  expect_refused("format", [](Refusal& r) { r.mesh_desc.uv[1].format = BDPT_FORMAT_FLOAT3; });
  expect_refused("format", [](Refusal& r) { r.mesh_desc.uv[1].format = 99; });
  expect_refused("texel_charts_capacity", [](Refusal& r) { --r.maps.texel_charts_capacity; });
  expect_refused("triangle_charts_capacity", [](Refusal& r) {
    r.maps.triangle_charts = r.buffer.data();
    r.maps.triangle_charts_capacity = 7;
  });
  expect_refused("texel_overlaps", [](Refusal& r) {
    r.maps.texel_overlaps = reinterpret_cast<uint32_t*>(reinterpret_cast<char*>(r.buffer.data()) + 2);
    r.maps.texel_overlaps_capacity = r.maps.texel_charts_capacity;
  });
  expect_refused("times", [](Refusal& r) {
    r.mesh = {};
    for (int i = 0; i < 257; ++i) add_quad(r.mesh, kAtlas, 0, 0, kWidth + 1, kHeight, 1, 0, float(i));
    r.mesh_desc = r.mesh.desc();
  });
}

TEST(ApiLightmapUvCheck, InstancesMayBeOfALaterAndLongerKind) {
  struct Longer {
    bdpt_uv_instance instance;
    uint64_t more;
  } instances[2];
  Refusal r;
  instances[0] = instances[1] = {r.instance, 1};
  r.desc.instance_count = 2;
  r.desc.instances = &instances[0].instance;
  r.desc.instance_stride = sizeof(Longer);
  EXPECT_OK(bdpt_uv_check(&r.desc, nullptr, &r.report));
  EXPECT_EQ(4u, r.report.triangles);
}

TEST(ApiLightmapUvCheck, ACubeWhoseFacesAllFillTheAtlasOverlapsWithItselfThroughout) {
  LightmapMesh mesh = read_obj(BDPT_SHARED_DIR "/scenes/lightmap/xatlas-models/cube.obj");
  if (mesh.positions.empty()) GTEST_SKIP() << "no shared scenes";
  const Check c = check(mesh);
  EXPECT_EQ(12u, c.report.triangles);
  EXPECT_EQ(0u, c.report.outside_atlas + c.report.zero_area_uv + c.report.zero_area_world);
  EXPECT_NEAR(15.0 * kWidth * kHeight, c.report.overlap_area_within + c.report.overlap_area_between, 1e-2);
  EXPECT_EQ(kWidth * kHeight, c.report.texels_claimed);
}

TEST(ApiLightmapUvCheck, AFaceWithoutAreaIsFound) {
  const std::string folder = BDPT_SHARED_DIR "/scenes/lightmap/xatlas-models/";
  const auto zero_area = [&](const char* name) {
    LightmapMesh mesh = read_obj(folder + name);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
      mesh.uv[i] = {0.5f + 0.25f * mesh.positions[i][0], 0.5f + 0.25f * mesh.positions[i][2]};
    return check(mesh).report;
  };
  if (read_obj(folder + "zero_area_face.obj").positions.empty()) GTEST_SKIP() << "no shared scenes";
  EXPECT_EQ(1u, zero_area("zero_area_face.obj").zero_area_world);
  EXPECT_EQ(1u, zero_area("zero_area_face.obj").zero_area_uv);
  EXPECT_EQ(1u, zero_area("degenerate_edge.obj").zero_area_world);
  EXPECT_EQ(1u, zero_area("zero_length_edge.obj").zero_area_world);
  EXPECT_EQ(0u, zero_area("double_sided.obj").zero_area_world);
  EXPECT_EQ(2u, zero_area("double_sided.obj").overlaps_within);
  EXPECT_EQ(2u, zero_area("double_sided.obj").mirrored);
}

TEST(ApiLightmapUvCheck, AnUnwrappedModelIsFoundInOrder) {
  const LightmapMesh mesh = read_obj(BDPT_SHARED_DIR "/scenes/lightmap/ands-gazebo/gazebo.obj");
  if (mesh.positions.empty()) GTEST_SKIP() << "no shared scenes";
  const bdpt_uv_report r = check(mesh, [](auto& d) { d.width = d.height = 654; }).report;
  EXPECT_EQ(mesh.triangles.size(), r.triangles);
  EXPECT_EQ(0u, r.outside_atlas);
  EXPECT_EQ(0u, r.overlaps_within + r.overlaps_between);
  EXPECT_EQ(0u, r.texels_shared);
  EXPECT_EQ(419u, r.charts);
  EXPECT_EQ(3, r.padding);
  EXPECT_NEAR(256, r.density_min, 0.1);
  EXPECT_NEAR(256, r.density_max, 0.1);
}

}  // namespace bdpt_api::api_lightmap_uv_check_test
