// Subdivision surfaces by the C ABI: meshes like others, and what is refused.
#include "api_builder.h"

namespace bdpt_api::api_subdivision_test {

constexpr float kCube[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                               {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
constexpr uint32_t kFaces[24] = {4, 5, 7, 6, 1, 0, 2, 3, 0, 4, 6, 2, 5, 1, 3, 7, 6, 7, 3, 2, 0, 1, 5, 4};
constexpr float kUv[8][2] = {};

bdpt_subdivision_desc cube_desc() {
  bdpt_subdivision_desc desc = make<bdpt_subdivision_desc>();
  desc.label = "pebble";
  desc.level = 4;
  desc.positions = view(kCube, 8, BDPT_FORMAT_FLOAT3);
  desc.indices = view(kFaces, 24, BDPT_FORMAT_UINT32);
  return desc;
}

class ApiSubdivision : public BuilderTest {
 protected:
  bdpt_result add(const std::function<void(bdpt_subdivision_desc&)>& change = [](auto&) {}) {
    bdpt_subdivision_desc desc = cube_desc();
    change(desc);
    shape_.id = 7;
    const bdpt_result result = bdpt_subdivision_add(b_, &desc, &shape_);
    EXPECT_EQ(result == BDPT_OK, shape_.id != 0);
    return result;
  }
  bdpt_shape_id shape_{};
};

TEST_F(ApiSubdivision, IsAMeshThatMayEmitAndMove) {
  for (const uint32_t level : {1u, 5u, 64u}) {
    const Builder owner = make_builder(context_.get());
    bdpt_subdivision_desc desc = cube_desc();
    desc.level = level;
    bdpt_shape_id shape{};
    ASSERT_OK(bdpt_subdivision_add(owner.get(), &desc, &shape));
    add_instance(owner.get(), shape, add_grey(owner.get(), 1));
    const Scene scene = build(owner.get());
    bdpt_scene_info info = make<bdpt_scene_info>();
    ASSERT_OK(bdpt_scene_get_info(scene.get(), &info));
    EXPECT_EQ(12ull * level * level, info.triangles);
    EXPECT_EQ(0u, info.degenerate_triangles);
    EXPECT_EQ(1u, info.lights);
    EXPECT_LT(info.bounds_max[0], 0.9f);
  }
}

TEST_F(ApiSubdivision, DisplacementIsAskedForEachPlaceOnce) {
  struct Asked {
    uint64_t count = 0;
    float farthest = 0;
  } asked;
  ASSERT_OK(add([&](auto& d) {
    d.user = &asked;
    d.displace = [](void* user, uint64_t count, const float* positions, const float* normals, const float*,
                    float* displaced) -> int32_t {
      auto& a = *static_cast<Asked*>(user);
      a.count += count;
      for (uint64_t i = 0; i < 3 * count; ++i) displaced[i] = positions[i] + normals[i];
      return 0;
    };
  }));
  EXPECT_EQ(6u * 16 + 2, asked.count);
  add_instance(b_, shape_, add_grey(b_));
  const Scene scene = build(b_);
  bdpt_scene_info info = make<bdpt_scene_info>();
  ASSERT_OK(bdpt_scene_get_info(scene.get(), &info));
  EXPECT_NEAR(1.8395f, info.bounds_max[0], 1e-3f);
}

TEST_F(ApiSubdivision, ACallbackThatFailsStopsTheCall) {
  expect_refused(add([](auto& d) {
                   d.displace = [](void*, uint64_t, const float*, const float*, const float*, float*) {
                     return int32_t(5);
                   };
                 }),
                 {"displace", "5"}, BDPT_ERROR_CALLBACK_FAILED);
  expect_refused(add([](auto& d) {
                   d.displace = [](void*, uint64_t, const float*, const float*, const float*, float* p) {
                     p[4] = kNan;
                     return int32_t(0);
                   };
                 }),
                 {"displace", "pebble", "nan"}, BDPT_ERROR_CALLBACK_FAILED);
  ASSERT_OK(add([this](auto& d) {
    d.user = b_;
    d.displace = [](void* user, uint64_t, const float*, const float*, const float*, float*) {
      bdpt_shape_id other{};
      const bdpt_subdivision_desc again = cube_desc();
      EXPECT_EQ(BDPT_ERROR_REENTRANT, bdpt_subdivision_add(static_cast<bdpt_builder*>(user), &again, &other));
      return int32_t(0);
    };
  }));
}

TEST_F(ApiSubdivision, RefusalsNameTheFieldAndTheValue) {
  const auto refuse = [&](const std::function<void(bdpt_subdivision_desc&)>& change,
                          std::initializer_list<const char*> parts) {
    expect_refused(add(change), parts);
    expect_refused(BDPT_ERROR_INVALID_ARGUMENT, {"bdpt_subdivision_add", "\"pebble\""});
  };
  for (const uint32_t level : {0u, 65u, 0xFFFFFFFFu}) refuse([&](auto& d) { d.level = level; }, {"level"});
  refuse([](auto& d) { d.boundary = 3; }, {"boundary", "3"});
  refuse([](auto& d) { d.reserved = 1; }, {"reserved"});
  refuse([](auto& d) { d.positions = {}; }, {"indices", "below the count of positions (0)"});
  refuse([](auto& d) { d.positions.count = 7; }, {"indices", "7 in element 2"});
  refuse([](auto& d) { d.indices = {}; }, {"indices.count", "0"});
  refuse([](auto& d) { d.indices.count = 23; }, {"indices.count", "23"});
  refuse([](auto& d) { d.indices.format = BDPT_FORMAT_UINT32X3; }, {"indices.format"});
  float positions[8][3];
  std::memcpy(positions, kCube, sizeof kCube);
  positions[3][1] = kInfinity;
  refuse([&](auto& d) { d.positions.data = positions; }, {"positions", "element 3"});
  positions[3][1] = 2e16f;
  refuse([&](auto& d) { d.positions.data = positions; }, {"positions", "2e+16 in element 3"});

  uint32_t counts[] = {4, 4, 4, 4, 4, 4};
  const auto counted = [&](auto& d) { d.face_counts = view(counts, 6, BDPT_FORMAT_UINT32); };
  counts[2] = 2;
  refuse(counted, {"face_counts", "2 in element 2"});
  counts[2] = 16;
  refuse(counted, {"face_counts", "16 in element 2"});
  counts[2] = 4, counts[5] = 6;
  refuse(counted, {"face_counts", "add up to 26", "24"});
  counts[2] = 3, counts[5] = 5;
  refuse([&](auto& d) { counted(d), d.level = 3; }, {"level", "3", "face 2", "even"});

  uint32_t faces[24];
  const auto changed = [&](uint32_t corner, uint32_t index) {
    std::memcpy(faces, kFaces, sizeof kFaces);
    faces[corner] = index;
    return [&](auto& d) { d.indices.data = faces; };
  };
  refuse(changed(9, 0), {"indices", "0 twice in face 2"});
  refuse(changed(5, 99), {"indices", "99 in element 5"});
  refuse(
      [&](auto& d) {
        std::memcpy(faces, kFaces, sizeof kFaces);
        std::swap(faces[4], faces[6]);
        d.indices.data = faces;
      },
      {"indices", "same direction", "faces"});
  const float bow[7][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}};
  const uint32_t bow_faces[] = {0, 1, 2, 3, 0, 4, 5, 6};
  refuse(
      [&](auto& d) {
        d.positions = view(bow, 7, BDPT_FORMAT_FLOAT3);
        d.indices = view(bow_faces, 8, BDPT_FORMAT_UINT32);
      },
      {"position 0", "share no edge"});
  std::vector<float> fan(3 * 102);
  std::vector<uint32_t> fan_faces, fan_counts(100, 3);
  for (uint32_t i = 0; i < 100; ++i)
    for (uint32_t v : {0u, 1 + i, 2 + i}) fan_faces.push_back(v);
  for (size_t i = 0; i < fan.size(); ++i) fan[i] = float(i % 17);
  refuse(
      [&](auto& d) {
        d.positions = view(fan.data(), 102, BDPT_FORMAT_FLOAT3);
        d.face_counts = view(fan_counts.data(), 100, BDPT_FORMAT_UINT32);
        d.indices = view(fan_faces.data(), 300, BDPT_FORMAT_UINT32);
      },
      {"too many faces", "position 0", "60"});

  refuse([](auto& d) { d.uv = view(kUv, 7, BDPT_FORMAT_FLOAT2); }, {"uv.count", "7"});
  refuse([](auto& d) { d.uv_indices = view(kFaces, 24, BDPT_FORMAT_UINT32); }, {"uv_indices", "without uv"});
  const auto with_uv = [](auto& d, uint64_t count, uint64_t indices) {
    d.uv = view(kUv, count, BDPT_FORMAT_FLOAT2), d.uv_indices = view(kFaces, indices, BDPT_FORMAT_UINT32);
  };
  refuse([&](auto& d) { with_uv(d, 8, 23); }, {"uv_indices.count", "23"});
  refuse([&](auto& d) { with_uv(d, 7, 24); }, {"uv_indices", "7 in element 2"});
  uint32_t edges[] = {0, 1, 1, 0};
  float weights[] = {1, 2};
  const auto creased = [&](uint64_t n, uint64_t m) {
    return [&, n, m](auto& d) {
      d.crease_edges = view(edges, n, BDPT_FORMAT_UINT32), d.crease_weights = view(weights, m, BDPT_FORMAT_FLOAT1);
    };
  };
  refuse(creased(3, 1), {"crease_edges.count", "3"});
  refuse(creased(2, 2), {"crease_weights.count", "2"});
  refuse(creased(4, 2), {"crease_edges", "0 and 1 again in crease 1"});
  edges[1] = 7;
  refuse(creased(2, 1), {"crease_edges", "0 and 7 in crease 0"});
  edges[1] = 8;
  refuse(creased(2, 1), {"crease_edges", "8"});
  edges[1] = 1;
  for (const float bad : {-1.0f, kNan}) {
    weights[0] = bad;
    refuse(creased(2, 1), {"crease_weights", "element 0"});
  }
  weights[0] = kInfinity;
  EXPECT_OK(add(creased(2, 1)));
  const uint32_t corners[] = {3, 3};
  const auto cornered = [&](uint64_t n, uint64_t m) {
    return [&, n, m](auto& d) {
      d.corners = view(corners, n, BDPT_FORMAT_UINT32), d.corner_weights = view(weights, m, BDPT_FORMAT_FLOAT1);
    };
  };
  refuse(cornered(2, 1), {"corner_weights.count", "1"});
  refuse(cornered(2, 2), {"corners", "3 again"});
  EXPECT_OK(add(cornered(1, 1)));
}

TEST_F(ApiSubdivision, MemoryLimitHolds) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.memory_limit = 1 << 20;
  const Context context = make_context(&desc);
  const Builder owner = make_builder(context.get());
  bdpt_subdivision_desc cube = cube_desc();
  cube.level = 64;
  bdpt_shape_id shape{};
  expect_refused(bdpt_subdivision_add(owner.get(), &cube, &shape), {"pebble", "memory_limit"}, BDPT_ERROR_MEMORY_LIMIT);
  cube.level = 4;
  EXPECT_OK(bdpt_subdivision_add(owner.get(), &cube, &shape));
}

TEST_F(ApiSubdivision, EveryReleaseIsCalledOnceDuringTheCall) {
  for (const bool valid : {true, false}) {
    int calls = 0;
    add([&](bdpt_subdivision_desc& d) {
      for (bdpt_data* data : {&d.positions, &d.face_counts, &d.indices, &d.uv, &d.uv_indices, &d.crease_edges,
                              &d.crease_weights, &d.corners, &d.corner_weights}) {
        data->ownership = BDPT_OWNERSHIP_BORROW;
        data->release = [](void* user, const void*) { ++*static_cast<int*>(user); };
        data->user = &calls;
      }
      if (!valid) d.level = 0;
    });
    EXPECT_EQ(9, calls);
  }
}

}  // namespace bdpt_api::api_subdivision_test
