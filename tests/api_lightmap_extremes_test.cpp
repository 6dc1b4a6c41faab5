// Coordinates and values of all magnitudes: a result or a refusal, never anything else.
#include "lightmap_meshes.h"

#include <cfloat>
#include <random>

namespace bdpt_api::api_lightmap_extremes_test {

// Of either sign; now and then zero, the largest, or a denormal.
float wild(std::mt19937& random, float exponent) {
  std::uniform_real_distribution<float> number(-1, 1);
  switch (random() % 12) {
    case 0:
      return 0;
    case 1:
      return exponent > 30 ? FLT_MAX : 1;
    case 2:
      return 1e-42f;
    default:
      return number(random) * std::pow(10.0f, exponent * number(random));
  }
}

LightmapMesh wild_mesh(std::mt19937& random, float exponent) {
  LightmapMesh mesh;
  const uint32_t vertices = 3 + random() % 12;
  for (uint32_t i = 0; i < vertices; ++i) {
    const float e = std::min(exponent, 17.0f);
    mesh.positions.push_back({wild(random, e), wild(random, e), wild(random, e)});
    mesh.uv.push_back({wild(random, exponent), wild(random, exponent)});
    mesh.normals.push_back({wild(random, exponent), 1, wild(random, exponent)});
  }
  for (uint32_t i = 0; i < 1 + random() % 20; ++i)
    mesh.triangles.push_back(
        {uint32_t(random() % vertices), uint32_t(random() % vertices), uint32_t(random() % vertices)});
  if (random() % 2) mesh.normals.clear();
  return mesh;
}

TEST(ApiLightmapExtremes, ChecksAndSeamsTakeCoordinatesOfAllMagnitudes) {
  std::mt19937 random(1);
  int checked = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const float exponent = float(trial % 3) * 19;
    const LightmapMesh mesh = wild_mesh(random, exponent);
    const bdpt_mesh_desc mesh_desc = mesh.desc();
    std::vector<bdpt_uv_instance> instances(1 + random() % 2, uv_instance(mesh_desc));
    for (float& v : instances.back().uv_scale) v = wild(random, exponent) + 1e-3f;
    for (float& v : instances.back().uv_offset) v = wild(random, exponent);
    bdpt_uv_check_desc check = make<bdpt_uv_check_desc>();
    check.instance_count = uint32_t(instances.size()), check.instances = instances.data();
    check.width = 1 + random() % 40, check.height = 1 + random() % 40;
    bdpt_uv_report r = make<bdpt_uv_report>();
    const bdpt_result result = bdpt_uv_check(&check, nullptr, &r);
    EXPECT_TRUE(result == BDPT_OK || result == BDPT_ERROR_INVALID_ARGUMENT) << bdpt_last_error();
    checked += result == BDPT_OK;
    EXPECT_TRUE(std::isfinite(r.overlap_area_within) && std::isfinite(r.overlap_area_between));
    EXPECT_TRUE(std::isfinite(r.density_min) && std::isfinite(r.density_mean) && std::isfinite(r.density_max));
    EXPECT_LE(r.texels_claimed, uint64_t(check.width) * check.height);

    std::vector<float> pixels(size_t(check.width) * check.height);
    for (float& v : pixels) v = wild(random, exponent);
    const bdpt_lightmap_image image{pixels.data(), pixels.size() * 4, nullptr, 0, check.width, check.height};
    bdpt_lightmap_seams_desc seams = make<bdpt_lightmap_seams_desc>();
    seams.instance_count = check.instance_count, seams.instances = check.instances;
    seams.image_count = seams.channels = 1, seams.images = &image;
    seams.angle = 180, seams.max_iterations = 50;
    seams.position_tolerance = std::abs(wild(random, exponent));
    bdpt_lightmap_seams_report s = make<bdpt_lightmap_seams_report>();
    EXPECT_EQ(result == BDPT_OK, bdpt_lightmap_fix_seams(&seams, &s) == BDPT_OK) << bdpt_last_error();
    EXPECT_TRUE(std::isfinite(s.error_before) && std::isfinite(s.error_after));
    for (const float v : pixels) EXPECT_TRUE(std::isfinite(v));
  }
  EXPECT_GT(checked, 300);
}

TEST(ApiLightmapExtremes, EncodingsOfFiniteValuesAreFinite) {
  std::mt19937 random(2);
  std::vector<float> pixels(27 * 500);
  for (float& v : pixels) v = wild(random, 38);
  for (const bdpt_lightmap_encoding encoding : {BDPT_LIGHTMAP_ENCODING_DOMINANT, BDPT_LIGHTMAP_ENCODING_MONO_SH,
                                                BDPT_LIGHTMAP_ENCODING_H4, BDPT_LIGHTMAP_ENCODING_H6}) {
    std::vector<float> encoded(18 * 500);
    bdpt_lightmap_encode_desc desc = make<bdpt_lightmap_encode_desc>();
    desc.encoding = encoding;
    desc.texels = 500, desc.texel_stride = 27;
    desc.pixels = pixels.data(), desc.pixels_capacity = pixels.size() * 4;
    desc.encoded = encoded.data(), desc.encoded_capacity = encoded.size() * 4;
    bdpt_lightmap_encode_report report = make<bdpt_lightmap_encode_report>();
    EXPECT_OK(bdpt_lightmap_encode(&desc, &report));
    EXPECT_EQ(0u, report.not_finite);
    EXPECT_GT(report.clipped, 0u);
    for (const float v : encoded) EXPECT_TRUE(std::isfinite(v));
  }
}

TEST(ApiLightmapExtremes, DilatedValuesAreFinite) {
  std::vector<float> pixels(64, FLT_MAX);
  std::vector<uint8_t> mask(64);
  for (size_t i = 0; i < 64; i += 3) mask[i] = 1;
  bdpt_lightmap_dilate_desc desc = make<bdpt_lightmap_dilate_desc>();
  desc.width = desc.height = 8, desc.channels = 1;
  desc.pixels = pixels.data(), desc.pixels_capacity = 256, desc.mask = mask.data(), desc.mask_capacity = 64;
  EXPECT_OK(bdpt_lightmap_dilate(&desc, nullptr));
  EXPECT_EQ(std::vector<float>(64, FLT_MAX), pixels);
}

}  // namespace bdpt_api::api_lightmap_extremes_test
