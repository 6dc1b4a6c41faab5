// However a mesh is laid out in memory, it is the same mesh.
#include "api_builder.h"

#include <cmath>
#include <cstdlib>

namespace bdpt_api::api_mesh_test {

// An array of elements `stride` bytes apart in a block that ends with the last of them, or slack bytes later.
class Strided {
 public:
  Strided(const void* elements, size_t count, size_t size, size_t stride, size_t slack = 0)
      : bytes_(static_cast<unsigned char*>(std::malloc((count - 1) * stride + size + slack))) {
    std::memset(bytes_, 0xFF, (count - 1) * stride + size + slack);
    for (size_t i = 0; i < count; ++i)
      std::memcpy(bytes_ + i * stride, static_cast<const unsigned char*>(elements) + i * size, size);
  }
  ~Strided() { std::free(bytes_); }
  const void* data() const { return bytes_; }

 private:
  unsigned char* bytes_;
};

struct Result {
  uint64_t hash;
  std::vector<float> pixels;
  bool operator==(const Result&) const = default;
};

// A picture of the mesh under an even sky, once as it is and twice as an instance.
Result picture(const bdpt_mesh_desc& desc) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  bdpt_shape_id shape{};
  EXPECT_OK(bdpt_mesh_add(builder.get(), &desc, &shape));
  const bdpt_material_id grey = add_grey(builder.get());
  bdpt_light_desc sky = make<bdpt_light_desc>();
  sky.type = BDPT_LIGHT_ENVIRONMENT;
  for (float& v : sky.radiance) v = 1;
  bdpt_light_id light{};
  EXPECT_OK(bdpt_light_add(builder.get(), &sky, &light));
  add_instance(builder.get(), shape, grey);
  Scene scene = build(builder.get());
  const Sensor sensor = make_camera(context.get());
  const Film film = make_film(sensor.get());
  {
    const Render render = make_render(scene.get(), sensor.get(), film.get());
    EXPECT_OK(advance(render.get(), 2));
  }
  std::vector<float> pixels = pixels_of(film.get());
  add_instance(builder.get(), shape, grey, 0.5f, 0.5f);
  add_instance(builder.get(), shape, grey, 0.25f, 1);
  const uint64_t hash = scene_hash(scene.get());
  scene = build(builder.get());
  const Film second = make_film(sensor.get());
  const Render render = make_render(scene.get(), sensor.get(), second.get());
  EXPECT_OK(advance(render.get(), 2));
  for (const float v : pixels_of(second.get())) pixels.push_back(v);
  return {hash, pixels};
}

TEST(ApiMesh, EveryStrideOwnershipAndIndexFormatGivesTheSamePicture) {
  const Result expected = picture(square_desc());
  EXPECT_NE(std::vector<float>(expected.pixels.size()), expected.pixels);
  for (const bdpt_ownership ownership : {BDPT_OWNERSHIP_COPY, BDPT_OWNERSHIP_BORROW})
    for (const size_t stride : {12, 16, 20, 64})
      for (const size_t slack : {0, 15, 16}) {
        SCOPED_TRACE(testing::Message() << "ownership " << ownership << ", stride " << stride << ", slack " << slack);
        const Strided positions(kSquare, 4, 12, stride, slack), indices(kSquareIndices, 2, 12, stride, slack);
        bdpt_mesh_desc desc = square_desc();
        desc.positions = view(positions.data(), 4, BDPT_FORMAT_FLOAT3);
        desc.indices = view(indices.data(), 2, BDPT_FORMAT_UINT32X3);
        for (bdpt_data* v : {&desc.positions, &desc.indices}) {
          v->ownership = ownership;
          v->stride = stride;
          v->slack_bytes = slack;
        }
        EXPECT_EQ(expected, picture(desc));
      }
  const uint16_t narrow[2][3] = {{0, 1, 2}, {0, 2, 3}};
  for (const size_t stride : {6, 8, 10}) {
    const Strided indices(narrow, 2, 6, stride);
    bdpt_mesh_desc desc = square_desc();
    desc.indices = view(indices.data(), 2, BDPT_FORMAT_UINT16X3);
    desc.indices.stride = stride;
    EXPECT_EQ(expected, picture(desc)) << stride;
  }
}

TEST(ApiMesh, WithoutIndicesEachThreeVerticesAreATriangle) {
  const float* s[6] = {kSquare[0], kSquare[1], kSquare[2], kSquare[0], kSquare[2], kSquare[3]};
  float soup[6][3];
  for (int i = 0; i < 6; ++i) std::memcpy(soup[i], s[i], sizeof soup[i]);
  bdpt_mesh_desc desc = square_desc();
  desc.positions = view(soup, 6, BDPT_FORMAT_FLOAT3);
  desc.indices = desc.uv[1] = bdpt_data{};
  EXPECT_EQ(picture(square_desc()).pixels, picture(desc).pixels);
  desc.positions.count = 5;
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  bdpt_shape_id shape{};
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_mesh_add(builder.get(), &desc, &shape));
}

TEST(ApiMesh, NormalsWeighAlikeWhateverTheirLengthAndOwnership) {
  float normals[4][3] = {{0.3f, 1, 0}, {0, 1, 0.3f}, {-0.3f, 1, 0}, {0, 1, -0.3f}}, longer[4][3];
  for (auto& n : normals) {
    const float l = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (float& v : n) v /= l;
  }
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) longer[i][j] = normals[i][j] * float(4 << i);
  bdpt_mesh_desc desc = square_desc();
  desc.normals = view(normals, 4, BDPT_FORMAT_FLOAT3);
  const Result expected = picture(desc);
  desc.normals.ownership = BDPT_OWNERSHIP_BORROW;
  EXPECT_EQ(expected, picture(desc));
  desc.normals = view(longer, 4, BDPT_FORMAT_FLOAT3);
  const Result copied = picture(desc);
  desc.normals.ownership = BDPT_OWNERSHIP_BORROW;
  EXPECT_EQ(copied, picture(desc));
  double difference = 0;
  for (size_t i = 0; i < copied.pixels.size(); ++i) difference += std::fabs(copied.pixels[i] - expected.pixels[i]);
  EXPECT_LT(difference / double(copied.pixels.size()), 1e-3);
}

TEST(ApiMesh, TrianglesWithoutAreaAreDroppedAndCounted) {
  const uint32_t indices[4][3] = {{0, 1, 2}, {1, 1, 2}, {0, 2, 3}, {3, 3, 3}};
  bdpt_mesh_desc desc = square_desc();
  desc.indices = view(indices, 4, BDPT_FORMAT_UINT32X3);
  desc.indices.ownership = BDPT_OWNERSHIP_BORROW;
  desc.indices.slack_bytes = 0;
  EXPECT_EQ(picture(square_desc()).pixels, picture(desc).pixels);
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  bdpt_shape_id shape{};
  ASSERT_OK(bdpt_mesh_add(builder.get(), &desc, &shape));
  const bdpt_material_id grey = add_grey(builder.get());
  for (int i = 0; i < 2; ++i) add_instance(builder.get(), shape, grey);
  const Scene scene = build(builder.get());
  bdpt_scene_info info = make<bdpt_scene_info>();
  ASSERT_OK(bdpt_scene_get_info(scene.get(), &info));
  EXPECT_EQ(2u, info.instances);
  EXPECT_EQ(4u, info.triangles);
  EXPECT_EQ(4u, info.degenerate_triangles);
}

TEST(ApiMesh, ColorsAndTangentsAreTheSameInEveryLayout) {
  const float rgba[4][4] = {{1, 0.5f, 0, 1}, {0, 1, 0.25f, 1}, {0.5f, 0.5f, 1, 1}, {0, 0, 0, 1}};
  const float tangents[4][4] = {{1, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 2, -1}, {0, 0, 2, -1}};
  float rgb[4][3];
  for (int i = 0; i < 4; ++i) std::memcpy(rgb[i], rgba[i], sizeof rgb[i]);
  bdpt_mesh_desc desc = square_desc();
  desc.colors = view(rgba, 4, BDPT_FORMAT_FLOAT4);
  desc.tangents = view(tangents, 4, BDPT_FORMAT_FLOAT4);
  const Result expected = picture(desc);
  EXPECT_NE(picture(square_desc()).pixels, expected.pixels);
  for (const bdpt_ownership ownership : {BDPT_OWNERSHIP_COPY, BDPT_OWNERSHIP_BORROW}) {
    for (const size_t stride : {16, 20, 64}) {
      const Strided colors(rgba, 4, 16, stride), directions(tangents, 4, 16, stride);
      desc.colors = view(colors.data(), 4, BDPT_FORMAT_FLOAT4);
      desc.tangents = view(directions.data(), 4, BDPT_FORMAT_FLOAT4);
      desc.colors.ownership = desc.tangents.ownership = ownership;
      desc.colors.stride = desc.tangents.stride = stride;
      EXPECT_EQ(expected, picture(desc)) << ownership << ' ' << stride;
    }
    for (const size_t stride : {12, 16, 28}) {
      const Strided colors(rgb, 4, 12, stride);
      desc.colors = view(colors.data(), 4, BDPT_FORMAT_FLOAT3);
      desc.colors.ownership = ownership;
      desc.colors.stride = stride;
      desc.tangents = view(tangents, 4, BDPT_FORMAT_FLOAT4);
      EXPECT_EQ(expected, picture(desc)) << ownership << ' ' << stride;
    }
  }
}

TEST(ApiMesh, ErrorsOfColorsAndTangentsNameTheElement) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  float colors[4][4] = {}, tangents[4][4] = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
  const auto refused = [&](std::initializer_list<const char*> parts, auto&& change) {
    bdpt_mesh_desc desc = square_desc();
    desc.colors = view(colors, 4, BDPT_FORMAT_FLOAT4);
    desc.tangents = view(tangents, 4, BDPT_FORMAT_FLOAT4);
    bdpt_shape_id shape{};
    EXPECT_OK(bdpt_mesh_add(builder.get(), &desc, &shape));
    const float first = colors[2][3], direction = tangents[2][0], sign = tangents[2][3];
    change(desc);
    expect_refused(bdpt_mesh_add(builder.get(), &desc, &shape), parts);
    expect_refused(BDPT_ERROR_INVALID_ARGUMENT, {"bdpt_mesh_add", "mesh \"square\""});
    colors[2][3] = first, tangents[2][0] = direction, tangents[2][3] = sign;
  };
  refused({"colors.count", "is 3", "as many as positions (4)"}, [](auto& d) { d.colors.count = 3; });
  refused({"colors.count", "18446744073709551615", "at most"}, [](auto& d) { d.colors.count = ~uint64_t(0); });
  refused({"colors.format", "is 1", "something else"}, [](auto& d) { d.colors.format = BDPT_FORMAT_FLOAT2; });
  refused({"colors.stride", "is 12", "multiple of 4 from 16"}, [](auto& d) { d.colors.stride = 12; });
  refused({"colors.stride", "is 18", "multiple of 4 from 16"}, [](auto& d) { d.colors.stride = 18; });
  refused({"colors.data", "is NULL"}, [](auto& d) { d.colors.data = nullptr; });
  refused({"colors", "1.5 in element 2", "[0,1]"}, [&](auto&) { colors[2][3] = 1.5f; });
  refused({"colors", "-1 in element 2", "[0,1]"}, [&](auto&) { colors[2][3] = -1; });
  refused({"colors", "nan in element 2", "finite"}, [&](auto&) { colors[2][3] = std::nanf(""); });
  refused({"tangents.count", "is 1", "as many as positions (4)"}, [](auto& d) { d.tangents.count = 1; });
  refused({"tangents.format", "is 2", "something else"}, [](auto& d) { d.tangents.format = BDPT_FORMAT_FLOAT3; });
  refused({"tangents.data", "align it to 4"},
          [](auto& d) { d.tangents.data = static_cast<const char*>(d.tangents.data) + 2; });
  refused({"tangents", "in element 2", "any length but zero"}, [&](auto&) { tangents[2][0] = 0; });
  refused({"tangents", "0.5) in element 2", "sign of 1 or -1"}, [&](auto&) { tangents[2][3] = 0.5f; });
  refused({"tangents", "inf in element 2", "finite"}, [&](auto&) { tangents[2][0] = INFINITY; });
}

TEST(ApiMesh, AnErrorNamesFunctionFieldObjectAndValue) {
  const Context context = make_context();
  const Builder builder = make_builder(context.get());
  const uint32_t indices[1][3] = {{0, 1, 17}};
  bdpt_mesh_desc desc = square_desc();
  desc.label = "left wall";
  desc.indices = view(indices, 1, BDPT_FORMAT_UINT32X3);
  bdpt_shape_id shape{};
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_mesh_add(builder.get(), &desc, &shape));
  const std::string text = bdpt_last_error();
  for (const char* part : {"bdpt_mesh_add", "indices", "left wall", "17"})
    EXPECT_NE(std::string::npos, text.find(part)) << text;
}

}  // namespace bdpt_api::api_mesh_test
