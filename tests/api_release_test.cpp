// Borrowed data is given back exactly once, and nothing is read beyond what was lent.
#include "api_scene.h"

#include <array>
#include <limits>

namespace bdpt_api::api_release_test {

// A mesh of one triangle in blocks of exactly its size, each view with a release that counts.
struct LentMesh {
  std::array<int, 7> released{};
  std::unique_ptr<float[]> positions{new float[9]{0, 0, 0, 1, 0, 0, 0, 1, 0}};
  std::unique_ptr<float[]> normals{new float[9]{0, 0, 1, 0, 0, 1, 0, 0, 1}};
  std::unique_ptr<float[]> uv{new float[6]{0, 0, 1, 0, 0, 1}};
  std::unique_ptr<float[]> colors{new float[12]{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}};
  std::unique_ptr<float[]> tangents{new float[12]{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}};
  std::unique_ptr<uint32_t[]> indices{new uint32_t[3]{0, 1, 2}};
  bdpt_mesh_desc desc = make<bdpt_mesh_desc>();

  explicit LentMesh(bdpt_ownership ownership) {
    desc.positions = view(positions.get(), 3, BDPT_FORMAT_FLOAT3);
    desc.indices = view(indices.get(), 1, BDPT_FORMAT_UINT32X3);
    desc.normals = view(normals.get(), 3, BDPT_FORMAT_FLOAT3);
    desc.uv[0] = desc.uv[1] = view(uv.get(), 3, BDPT_FORMAT_FLOAT2);
    desc.colors = view(colors.get(), 3, BDPT_FORMAT_FLOAT4);
    desc.tangents = view(tangents.get(), 3, BDPT_FORMAT_FLOAT4);
    bdpt_data* views[] = {&desc.positions, &desc.indices, &desc.normals, &desc.uv[0],
                          &desc.uv[1],     &desc.colors,  &desc.tangents};
    for (size_t i = 0; i < 7; ++i) {
      views[i]->ownership = ownership;
      views[i]->user = &released[i];
      views[i]->release = [](void* user, const void*) { ++*static_cast<int*>(user); };
    }
  }
  bdpt_result add(bdpt_builder* builder, bdpt_shape_id* shape) const { return bdpt_mesh_add(builder, &desc, shape); }
};

constexpr std::array<int, 7> kNone{}, kOnce{1, 1, 1, 1, 1, 1, 1};

TEST(ApiRelease, CopiedDataIsReleasedDuringTheCall) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  const LentMesh mesh(BDPT_OWNERSHIP_COPY);
  bdpt_shape_id shape{};
  ASSERT_OK(mesh.add(builder.get(), &shape));
  EXPECT_EQ(kOnce, mesh.released);
}

TEST(ApiRelease, BorrowedDataIsReleasedWhenTheLastUserIsGone) {
  const Context context = make_context();
  Builder builder = make_builder(context.get());
  const LentMesh mesh(BDPT_OWNERSHIP_BORROW);
  bdpt_shape_id shape{};
  ASSERT_OK(mesh.add(builder.get(), &shape));
  // Indices without slack behind them were copied; the rest is still lent.
  EXPECT_EQ((std::array<int, 7>{0, 1, 0, 0, 0, 0, 0}), mesh.released);
  const bdpt_instance_id instance = add_instance(builder.get(), shape, add_grey(builder.get()));
  Scene scene = build(builder.get());
  ASSERT_OK(bdpt_instance_remove(builder.get(), instance));
  ASSERT_OK(bdpt_shape_remove(builder.get(), shape));
  builder.reset();
  EXPECT_EQ((std::array<int, 7>{0, 1, 0, 0, 0, 0, 0}), mesh.released);
  scene.reset();
  EXPECT_EQ(kOnce, mesh.released);
}

TEST(ApiRelease, AMeshThatIsRemovedUnusedIsReleasedAtOnce) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  const LentMesh mesh(BDPT_OWNERSHIP_BORROW);
  bdpt_shape_id shape{};
  ASSERT_OK(mesh.add(builder.get(), &shape));
  ASSERT_OK(bdpt_shape_remove(builder.get(), shape));
  EXPECT_EQ(kOnce, mesh.released);
}

TEST(ApiRelease, EveryFailureReleasesEveryViewOnce) {
  const Context context = make_context();
  const Builder owner = make_builder(context.get());
  bdpt_builder* builder = owner.get();
  const auto check = [&](const char* name, auto&& change, bdpt_builder* b, bool has_output = true) {
    for (const bdpt_ownership ownership : {BDPT_OWNERSHIP_COPY, BDPT_OWNERSHIP_BORROW}) {
      SCOPED_TRACE(name);
      LentMesh mesh(ownership);
      change(mesh);
      bdpt_shape_id shape{7};
      EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, mesh.add(b, has_output ? &shape : nullptr));
      EXPECT_EQ(kOnce, mesh.released) << bdpt_last_error();
      EXPECT_EQ(has_output ? 0u : 7u, shape.id);
    }
  };
  const auto nothing = [](LentMesh&) {};
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  check("no builder", nothing, nullptr);
  check("no output", nothing, builder, false);
  check(
      "a longer struct",
      [](LentMesh& m) {  // its tail is the mesh's own memory, which is not zero
        static struct {
          bdpt_mesh_desc desc;
          uint64_t tail[2];
        } longer;
        longer = {m.desc, {1, 1}};
        longer.desc.struct_size = sizeof longer;
        bdpt_shape_id shape{};
        EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_mesh_add(nullptr, &longer.desc, &shape));
        EXPECT_EQ(kOnce, m.released);
        m.released = {};
        m.desc.reserved = 1;
      },
      builder);
  check(
      "reserved", [](LentMesh& m) { m.desc.reserved = 1; }, builder);
  check(
      "format", [](LentMesh& m) { m.desc.positions.format = 99; }, builder);
  check(
      "format of another kind", [](LentMesh& m) { m.desc.normals.format = BDPT_FORMAT_FLOAT2; }, builder);
  check(
      "ownership", [](LentMesh& m) { m.desc.uv[1].ownership = 2; }, builder);
  check(
      "no data", [](LentMesh& m) { m.desc.positions.data = nullptr; }, builder);
  check(
      "no positions", [](LentMesh& m) { m.desc.positions.count = 0; }, builder);
  check(
      "too few positions", [](LentMesh& m) { m.desc.positions.count = 2; }, builder);
  check(
      "count", [](LentMesh& m) { m.desc.positions.count = ~uint64_t(0); }, builder);
  check(
      "stride", [](LentMesh& m) { m.desc.positions.stride = 8; }, builder);
  check(
      "stride not of 4", [](LentMesh& m) { m.desc.positions.stride = 14; }, builder);
  check(
      "huge stride", [](LentMesh& m) { m.desc.positions.stride = ~uint64_t(3); }, builder);
  check(
      "misaligned", [](LentMesh& m) { m.desc.uv[0].data = reinterpret_cast<const char*>(m.uv.get()) + 2; }, builder);
  check(
      "index", [](LentMesh& m) { m.indices[2] = 3; }, builder);
  check(
      "huge index", [](LentMesh& m) { m.indices[2] = ~0u; }, builder);
  check(
      "normals", [](LentMesh& m) { m.desc.normals.count = 2; }, builder);
  check(
      "uv", [](LentMesh& m) { m.desc.uv[0].count = 4; }, builder);
  check(
      "no area", [](LentMesh& m) { m.indices[2] = 1; }, builder);
  check(
      "NaN", [](LentMesh& m) { m.positions[4] = kNan; }, builder);
  check(
      "infinity", [](LentMesh& m) { m.uv[1] = std::numeric_limits<float>::infinity(); }, builder);
  check(
      "NaN normal", [](LentMesh& m) { m.normals[8] = kNan; }, builder);
  check(
      "colors", [](LentMesh& m) { m.desc.colors.count = 2; }, builder);
  check(
      "colors of two floats", [](LentMesh& m) { m.desc.colors.format = BDPT_FORMAT_FLOAT2; }, builder);
  check(
      "NaN color", [](LentMesh& m) { m.colors[11] = kNan; }, builder);
  check(
      "color above 1", [](LentMesh& m) { m.colors[3] = 1.5f; }, builder);
  check(
      "tangents", [](LentMesh& m) { m.desc.tangents.count = 1; }, builder);
  check(
      "tangents of three floats", [](LentMesh& m) { m.desc.tangents.format = BDPT_FORMAT_FLOAT3; }, builder);
  check(
      "zero tangent", [](LentMesh& m) { m.tangents[8] = 0; }, builder);
  check(
      "sign of a tangent", [](LentMesh& m) { m.tangents[11] = 0.5f; }, builder);
  check(
      "zero normal", [](LentMesh& m) { m.normals[8] = 0; }, builder);
}

TEST(ApiRelease, AStructOfNoKnownSizeIsNotReadAtAll) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  for (const uint32_t size : {0u, 295u, 0xFFFFFFFFu}) {
    LentMesh mesh(BDPT_OWNERSHIP_BORROW);
    mesh.desc.struct_size = size;
    bdpt_shape_id shape{};
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, mesh.add(builder.get(), &shape));
    EXPECT_EQ(kNone, mesh.released);
  }
}

TEST(ApiRelease, AnAbsentViewIsReleasedToo) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  LentMesh mesh(BDPT_OWNERSHIP_BORROW);
  mesh.desc.uv[1].count = 0;
  mesh.desc.uv[1].data = nullptr;
  mesh.desc.uv[1].format = BDPT_FORMAT_NONE;
  bdpt_shape_id shape{};
  ASSERT_OK(mesh.add(builder.get(), &shape));
  EXPECT_EQ(1, mesh.released[4]);
}

// Colours of three floats are copied, those of four stay lent.
TEST(ApiRelease, ColorsThatAreCopiedAllTheSameAreReleasedAtOnce) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  LentMesh mesh(BDPT_OWNERSHIP_BORROW);
  mesh.desc.colors.format = BDPT_FORMAT_FLOAT3;
  bdpt_shape_id shape{};
  ASSERT_OK(mesh.add(builder.get(), &shape));
  EXPECT_EQ((std::array<int, 7>{0, 1, 0, 0, 0, 1, 0}), mesh.released);
  ASSERT_OK(bdpt_shape_remove(builder.get(), shape));
  EXPECT_EQ(kOnce, mesh.released);
}

// The fields behind version 1 are not there, whatever the memory behind it holds.
TEST(ApiRelease, AnOlderCallersStructHasNoColorsToRelease) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  LentMesh mesh(BDPT_OWNERSHIP_COPY);
  mesh.desc.struct_size = 296;
  bdpt_shape_id shape{};
  ASSERT_OK(mesh.add(builder.get(), &shape));
  EXPECT_EQ((std::array<int, 7>{1, 1, 1, 1, 1, 0, 0}), mesh.released);
}

TEST(ApiRelease, TheMemoryLimitReleasesToo) {
  bdpt_context_desc desc = make<bdpt_context_desc>();
  desc.threads = 1;
  const Context probe = make_context(&desc);
  desc.memory_limit = memory_in_use(probe.get()) + 100;
  const Context context = make_context(&desc);
  const Builder builder = make_builder(context.get());
  const uint64_t before = memory_in_use(context.get());
  const LentMesh mesh(BDPT_OWNERSHIP_COPY);
  bdpt_shape_id shape{};
  EXPECT_EQ(BDPT_ERROR_MEMORY_LIMIT, mesh.add(builder.get(), &shape));
  EXPECT_EQ(kOnce, mesh.released);
  EXPECT_EQ(before, memory_in_use(context.get()));
}

TEST(ApiRelease, AReleaseMayCallTheBuilderItIsReleasedFrom) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  bdpt_mesh_desc desc = square_desc();
  desc.positions.ownership = BDPT_OWNERSHIP_BORROW;
  desc.positions.user = builder.get();
  desc.positions.release = [](void* user, const void*) { add_square(static_cast<bdpt_builder*>(user)); };
  bdpt_shape_id shape{};
  ASSERT_OK(bdpt_mesh_add(builder.get(), &desc, &shape));
  ASSERT_OK(bdpt_shape_remove(builder.get(), shape));
}

}  // namespace bdpt_api::api_release_test
