// Curves by the C ABI: what they hold, what is refused, and that host data is released.
#include "api_builder.h"

#include <cmath>

namespace bdpt_api::api_curves_test {

constexpr float kPoints[8][4] = {{0, 0, 0, 0.1f},  {1, 0, 0, 0.1f},    {2, 1, 0, 0.2f},    {3, 1, 0, 0.1f},
                                 {0, 0, 1, 0.05f}, {1, 0.5f, 1, 0.1f}, {2, 0.5f, 1, 0.1f}, {3, 0, 1, 0.05f}};
constexpr uint32_t kCounts[2] = {4, 4};

bdpt_data strided(const void* data, uint64_t count, bdpt_format format) {
  bdpt_data d = view(data, count, format);
  d.stride = 16;
  return d;
}

bdpt_curves_desc curves_desc(bdpt_curve_basis basis = BDPT_CURVE_LINEAR) {
  bdpt_curves_desc desc = make<bdpt_curves_desc>();
  desc.label = "fur";
  desc.basis = basis;
  desc.positions = strided(kPoints, 8, BDPT_FORMAT_FLOAT3);
  desc.radii = strided(&kPoints[0][3], 8, BDPT_FORMAT_FLOAT1);
  desc.counts = view(kCounts, 2, BDPT_FORMAT_UINT32);
  return desc;
}

class ApiCurves : public BuilderTest {
 protected:
  bdpt_result add(const std::function<void(bdpt_curves_desc&)>& change = [](auto&) {}) {
    bdpt_curves_desc desc = curves_desc();
    change(desc);
    shape_.id = 7;
    const bdpt_result result = bdpt_curves_add(b_, &desc, &shape_);
    EXPECT_EQ(result == BDPT_OK, shape_.id != 0);
    return result;
  }
  bdpt_scene_info info() {
    const Scene scene = build(b_);
    bdpt_scene_info info = make<bdpt_scene_info>();
    EXPECT_OK(bdpt_scene_get_info(scene.get(), &info));
    return info;
  }
  bdpt_shape_id shape_{};
};

TEST_F(ApiCurves, SegmentsAreCountedForEachInstance) {
  const struct {
    bdpt_curve_basis basis;
    uint64_t segments;
  } cases[] = {{BDPT_CURVE_LINEAR, 6}, {BDPT_CURVE_BEZIER, 2}, {BDPT_CURVE_BSPLINE, 2}, {BDPT_CURVE_CATMULL_ROM, 2}};
  uint64_t expected = 0, hash = 0;
  for (const auto& c : cases) {
    ASSERT_OK(add([&](auto& d) { d.basis = c.basis; }));
    const bdpt_material_id grey = add_grey(b_);
    add_instance(b_, shape_, grey);
    add_instance(b_, shape_, grey, 0.5f, 1);
    expected += 2 * c.segments;
    const bdpt_scene_info now = info();
    EXPECT_EQ(expected, now.curves);
    EXPECT_EQ(0u, now.triangles);
    EXPECT_NE(hash, now.hash);
    hash = now.hash;
  }
}

TEST_F(ApiCurves, BoundsHoldTheTubes) {
  ASSERT_OK(add());
  add_instance(b_, shape_, add_grey(b_), 2, 1);
  const bdpt_scene_info bounds = info();
  const float low[] = {-0.2f, 0.8f, -0.4f}, high[] = {6.2f, 3.4f, 2.2f};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(low[i], bounds.bounds_min[i], 1e-5f) << i;
    EXPECT_NEAR(high[i], bounds.bounds_max[i], 1e-5f) << i;
  }
}

// A hash of all that decides the picture.
TEST_F(ApiCurves, HashTellsCurvesApartAndStridesDoNot) {
  const auto hash = [&](const std::function<void(bdpt_curves_desc&)>& change) {
    const Builder owner = make_builder(context_.get());
    bdpt_curves_desc desc = curves_desc();
    change(desc);
    bdpt_shape_id shape{};
    EXPECT_OK(bdpt_curves_add(owner.get(), &desc, &shape));
    add_instance(owner.get(), shape, add_grey(owner.get()));
    const Scene scene = build(owner.get());
    bdpt_scene_info info = make<bdpt_scene_info>();
    EXPECT_OK(bdpt_scene_get_info(scene.get(), &info));
    return info.hash;
  };
  float positions[8][3], radii[8];
  for (int i = 0; i < 8; ++i) std::memcpy(positions[i], kPoints[i], 12), radii[i] = kPoints[i][3];
  const uint64_t first = hash([](auto&) {});
  EXPECT_EQ(first, hash([&](auto& d) {
              d.positions = view(positions, 8, BDPT_FORMAT_FLOAT3);
              d.radii = view(radii, 8, BDPT_FORMAT_FLOAT1);
            }));
  positions[3][1] += 0.1f;
  EXPECT_NE(first, hash([&](auto& d) { d.positions = view(positions, 8, BDPT_FORMAT_FLOAT3); }));
  radii[3] *= 2;
  EXPECT_NE(first, hash([&](auto& d) { d.radii = view(radii, 8, BDPT_FORMAT_FLOAT1); }));
  EXPECT_NE(first, hash([](auto& d) { d.counts = {}; }));
  EXPECT_NE(first, hash([](auto& d) { d.basis = BDPT_CURVE_BSPLINE; }));
  EXPECT_NE(hash([](auto& d) { d.basis = BDPT_CURVE_CATMULL_ROM; }),
            hash([](auto& d) { d.basis = BDPT_CURVE_BSPLINE; }));
}

TEST_F(ApiCurves, OneRadiusIsThatOfAllPoints) {
  const float thick = 0.25f;
  ASSERT_OK(add([&](auto& d) { d.radii = view(&thick, 1, BDPT_FORMAT_FLOAT1); }));
  add_instance(b_, shape_, add_grey(b_));
  EXPECT_EQ(-0.25f, info().bounds_min[0]);
}

TEST_F(ApiCurves, SegmentsWithoutLengthOrRadiusAreDroppedAndCounted) {
  float points[6][4] = {{0, 0, 0, 0.1f}, {0, 0, 0, 0.3f}, {1, 0, 0, 0.1f}, {1, 0, 0, 0.1f}, {2, 0, 0, 0}, {3, 0, 0, 0}};
  ASSERT_OK(add([&](auto& d) {
    d.positions = strided(points, 6, BDPT_FORMAT_FLOAT3);
    d.radii = strided(&points[0][3], 6, BDPT_FORMAT_FLOAT1);
    d.counts = {};
  }));
  add_instance(b_, shape_, add_grey(b_));
  const bdpt_scene_info now = info();
  EXPECT_EQ(2u, now.curves);
  EXPECT_EQ(3u, now.degenerate_triangles);
  EXPECT_NEAR(-0.3f, now.bounds_min[0], 1e-6f);
}

TEST_F(ApiCurves, LongLinesAreCutToSixtyFourRadii) {
  const float points[2][4] = {{0, 0, 0, 0.001f}, {1, 0, 0, 0.001f}};
  ASSERT_OK(add([&](auto& d) {
    d.positions = strided(points, 2, BDPT_FORMAT_FLOAT3);
    d.radii = strided(&points[0][3], 2, BDPT_FORMAT_FLOAT1);
    d.counts = {};
  }));
  add_instance(b_, shape_, add_grey(b_));
  EXPECT_EQ(16u, info().curves);
}

TEST_F(ApiCurves, RefusalsNameTheFieldAndTheValue) {
  float points[8][4];
  std::memcpy(points, kPoints, sizeof points);
  const auto refuse = [&](const std::function<void(bdpt_curves_desc&)>& change,
                          std::initializer_list<const char*> parts) {
    expect_refused(add(change), parts);
    expect_refused(BDPT_ERROR_INVALID_ARGUMENT, {"bdpt_curves_add", "curves \"fur\""});
  };
  refuse([](auto& d) { d.basis = 4; }, {"basis", "4"});
  refuse([](auto& d) { d.basis = -1; }, {"basis", "-1"});
  refuse(
      [](auto& d) {
        d.positions = {};
        d.counts = {};
      },
      {"radii.count", "8"});
  refuse(
      [](auto& d) {
        d.positions = d.counts = {};
        d.radii.count = 1;
      },
      {"positions.count", "0"});
  refuse([](auto& d) { d.positions.format = BDPT_FORMAT_FLOAT4; }, {"positions.format"});
  refuse([](auto& d) { d.positions.format = 8; }, {"positions.format", "8"});
  refuse([](auto& d) { d.positions.data = nullptr; }, {"positions.data", "NULL"});
  refuse([](auto& d) { d.radii = {}; }, {"radii.count", "0"});
  refuse([](auto& d) { d.radii.count = 3; }, {"radii.count", "3"});
  refuse([](auto& d) { d.radii.format = BDPT_FORMAT_UINT32; }, {"radii.format"});
  refuse([](auto& d) { d.counts.format = BDPT_FORMAT_UINT32X3; }, {"counts.format"});
  const uint32_t more[] = {4, 5}, one[] = {7, 1}, four[] = {5, 3}, huge[] = {4, 0xFFFFFFFF};
  refuse([&](auto& d) { d.counts.data = more; }, {"counts", "9", "8"});
  refuse([&](auto& d) { d.counts.data = huge; }, {"counts", "4294967299"});
  refuse([&](auto& d) { d.counts.data = one; }, {"counts", "1 in element 1", "2 control points"});
  refuse([&](auto& d) { d.counts.data = four, d.basis = BDPT_CURVE_BSPLINE; }, {"counts", "3 in element 1"});
  refuse([&](auto& d) { d.counts = {}, d.basis = BDPT_CURVE_BEZIER; }, {"positions.count", "8", "3 more"});
  for (const float bad : {kNan, kInfinity}) {
    points[5][1] = bad;
    refuse([&](auto& d) { d.positions.data = points; }, {"positions", "element 5"});
    points[5][1] = 0;
  }
  for (const float bad : {kNan, kInfinity, -0.1f}) {
    points[6][3] = bad;
    refuse([&](auto& d) { d.radii.data = &points[0][3]; }, {"radii", "element 6"});
    points[6][3] = 0.1f;
  }
  const float none = 0;
  refuse([&](auto& d) { d.radii = view(&none, 1, BDPT_FORMAT_FLOAT1); }, {"none of which has"});
  for (auto& p : points) p[0] = p[1] = p[2] = 1;
  refuse([&](auto& d) { d.positions.data = points; }, {"none of which has"});
  const float swinging[4][4] = {{0, 0, 0, 5}, {1, 0, 0, 0.1f}, {2, 0, 0, 0.1f}, {3, 0, 0, 5}};
  refuse(
      [&](auto& d) {
        d.basis = BDPT_CURVE_CATMULL_ROM, d.counts = {};
        d.positions = strided(swinging, 4, BDPT_FORMAT_FLOAT3);
        d.radii = strided(&swinging[0][3], 4, BDPT_FORMAT_FLOAT1);
      },
      {"radii", "segment 0"});
}

TEST_F(ApiCurves, WhatCurvesCannotDoIsRefusedByTheSceneOrItsSensors) {
  ASSERT_OK(add());
  const bdpt_instance_id lamp = add_instance(b_, shape_, add_grey(b_, 1));
  bdpt_scene* scene = nullptr;
  expect_refused(bdpt_scene_build(b_, nullptr, &scene), {"is of curves", "emits"});
  ASSERT_OK(bdpt_instance_remove(b_, lamp));
  expect_refused(bdpt_shape_remove(b_, {shape_.id + 99}), {"shape"}, BDPT_ERROR_INVALID_ID);

  const bdpt_instance_id hair = add_instance(b_, shape_, add_grey(b_));
  EXPECT_IN_USE(bdpt_shape_remove(b_, shape_));
  EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), "fur"));
  const Scene built = build(b_);
  bdpt_lightmap_instance place = make<bdpt_lightmap_instance>();
  place.instance = hair;
  bdpt_lightmap_desc map = make<bdpt_lightmap_desc>();
  map.width = map.height = 8;
  map.instances = &place, map.instance_count = 1;
  bdpt_sensor* sensor = nullptr;
  expect_refused(bdpt_lightmap_create(built.get(), &map, &sensor), {"curves"});
  bdpt_vertex_instance receiver = make<bdpt_vertex_instance>();
  receiver.instance = hair;
  bdpt_vertices_desc vertices = make<bdpt_vertices_desc>();
  vertices.instances = &receiver, vertices.instance_count = 1;
  expect_refused(bdpt_vertices_create(built.get(), &vertices, &sensor), {"curves"});
}

TEST_F(ApiCurves, MemoryLimitHolds) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.memory_limit = 64 << 10;
  const Context context = make_context(&desc);
  const Builder owner = make_builder(context.get());
  std::vector<float> points(4 * 10000);
  for (size_t i = 0; i < points.size(); ++i) points[i] = i % 4 == 3 ? 0.1f : float(i);
  bdpt_curves_desc curves = curves_desc();
  curves.positions = strided(points.data(), 10000, BDPT_FORMAT_FLOAT3);
  curves.radii = strided(&points[3], 10000, BDPT_FORMAT_FLOAT1);
  curves.counts = {};
  bdpt_shape_id shape{};
  expect_refused(bdpt_curves_add(owner.get(), &curves, &shape), {"fur", "memory_limit"}, BDPT_ERROR_MEMORY_LIMIT);
  curves.positions.count = curves.radii.count = 100;
  EXPECT_OK(bdpt_curves_add(owner.get(), &curves, &shape));
}

TEST_F(ApiCurves, EveryReleaseIsCalledOnceDuringTheCall) {
  for (const bool valid : {true, false})
    for (const bdpt_ownership ownership : {BDPT_OWNERSHIP_COPY, BDPT_OWNERSHIP_BORROW}) {
      int calls = 0;
      add([&](bdpt_curves_desc& d) {
        for (bdpt_data* data : {&d.positions, &d.radii, &d.counts}) {
          data->ownership = ownership;
          data->release = [](void* user, const void*) { ++*static_cast<int*>(user); };
          data->user = &calls;
        }
        if (!valid) d.basis = 9;
      });
      EXPECT_EQ(3, calls);
    }
}

}  // namespace bdpt_api::api_curves_test
