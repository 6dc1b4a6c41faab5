// Encodings: each is decoded here, by what the header says of it.
#include "api_scene.h"

#include <Imath/half.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace bdpt_api::api_lightmap_encode_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
constexpr double kPi = std::numbers::pi;

struct Encoder {
  bdpt_lightmap_encode_desc desc = make<bdpt_lightmap_encode_desc>();
  bdpt_lightmap_encode_report report = make<bdpt_lightmap_encode_report>();

  explicit Encoder(bdpt_lightmap_encoding encoding) { desc.encoding = encoding; }
  template <class T>
  std::vector<T> run(const std::vector<float>& pixels, uint64_t texels, size_t values) {
    std::vector<T> encoded(values);
    desc.texels = texels;
    desc.pixels = pixels.data(), desc.pixels_capacity = pixels.size() * sizeof(float);
    desc.encoded = encoded.data(), desc.encoded_capacity = encoded.size() * sizeof(T);
    EXPECT_OK(bdpt_lightmap_encode(&desc, &report));
    return encoded;
  }
};

TEST(ApiLightmapEncode, HalvesAreTheNearestAndClipAtTheEndOfTheirRange) {
  const std::vector<float> pixels{0,      1,     0.1f, -2.5f, 65504, 65519,     65521,    -1e30f,
                                  1e-10f, 6e-8f, kNan, 1,     3,     kInfinity, 1.0f / 3, -0.0f};
  Encoder encoder(BDPT_LIGHTMAP_ENCODING_HALF);
  encoder.desc.channels = 2;
  const std::vector<uint16_t> encoded = encoder.run<uint16_t>(pixels, 8, 16);
  const auto decoded = [&](size_t i) {
    Imath::half h;
    h.setBits(encoded[i]);
    return float(h);
  };
  for (const size_t i : {0, 1, 2, 3, 4, 8, 9, 14}) EXPECT_EQ(float(Imath::half(pixels[i])), decoded(i)) << i;
  EXPECT_NEAR(0.1, decoded(2), 0.1 / 2048);
  for (const size_t i : {4, 5, 6}) EXPECT_EQ(65504, decoded(i)) << i;
  EXPECT_EQ(-65504, decoded(7));
  for (const size_t i : {10, 11, 12, 13}) EXPECT_EQ(0, encoded[i]) << i;
  EXPECT_EQ(2u, encoder.report.clipped);
  EXPECT_EQ(2u, encoder.report.not_finite);
}

// Colours over all magnitudes up to range, and its borders.
std::vector<float> colours(float range, size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> number(0, 1);
  std::vector<float> pixels{range, range, range, range, 0, 0, 0, 0, 0, range, range / 2, range / 255};
  while (pixels.size() < 3 * count) {
    const float scale = range * std::pow(10.0f, -6 * number(random));
    for (int c = 0; c < 3; ++c) pixels.push_back(scale * number(random));
  }
  return pixels;
}

TEST(ApiLightmapEncode, RgbmKeepsTheErrorItStates) {
  for (const float range : {0.0f, 1.0f, 34.49f}) {
    constexpr size_t kCount = 20000;
    const float r = range > 0 ? range : 8;
    const std::vector<float> pixels = colours(r, kCount);
    Encoder encoder(BDPT_LIGHTMAP_ENCODING_RGBM);
    encoder.desc.range = range;
    const std::vector<uint8_t> encoded = encoder.run<uint8_t>(pixels, kCount, 4 * kCount);
    EXPECT_EQ(0u, encoder.report.clipped + encoder.report.not_finite);
    for (size_t i = 0; i < kCount; ++i) {
      const double m = encoded[4 * i + 3] / 255.0,
                   largest = std::max({pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]});
      EXPECT_LE(m, largest / r + 1.0001 / 255);
      for (size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(pixels[3 * i + c], r * m * encoded[4 * i + c] / 255.0, 1.0001 * r * m / 510) << i;
    }
  }
}

TEST(ApiLightmapEncode, RgbdKeepsTheErrorItStates) {
  for (const float range : {0.0f, 16.0f}) {
    constexpr size_t kCount = 20000;
    const float r = range > 0 ? range : 255;
    const std::vector<float> pixels = colours(r, kCount);
    Encoder encoder(BDPT_LIGHTMAP_ENCODING_RGBD);
    encoder.desc.range = range;
    const std::vector<uint8_t> encoded = encoder.run<uint8_t>(pixels, kCount, 4 * kCount);
    EXPECT_EQ(0u, encoder.report.clipped + encoder.report.not_finite);
    for (size_t i = 0; i < kCount; ++i) {
      const int d = encoded[4 * i + 3];
      ASSERT_GE(d, 1);
      const double largest = std::max({pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]});
      for (size_t c = 0; c < 3; ++c) {
        const double decoded = r / d * encoded[4 * i + c] / 255.0;
        EXPECT_NEAR(pixels[3 * i + c], decoded, 1.0001 * r / d / 510) << i;
        if (largest >= r / 255) {
          EXPECT_NEAR(pixels[3 * i + c], decoded, 1.0001 * largest / 255) << i;
        }
      }
    }
  }
}

TEST(ApiLightmapEncode, BytesClipAtBothEndsOfTheRangeAndCountTexels) {
  const std::vector<float> pixels{8.01f, 9, 4, -1, 2, 0, kNan, 1, 1, 1, 1, -kInfinity, 8, 0, 8};
  for (const bdpt_lightmap_encoding encoding : {BDPT_LIGHTMAP_ENCODING_RGBM, BDPT_LIGHTMAP_ENCODING_RGBD}) {
    Encoder encoder(encoding);
    encoder.desc.range = 8;
    const std::vector<uint8_t> e = encoder.run<uint8_t>(pixels, 5, 20);
    EXPECT_EQ(2u, encoder.report.clipped);
    EXPECT_EQ(2u, encoder.report.not_finite);
    EXPECT_EQ(255, e[0]);
    EXPECT_EQ(255, e[1]);
    EXPECT_EQ(128, e[2]);
    EXPECT_EQ(0, e[4]);
    for (const size_t i : {8, 9, 10, 12, 13, 14}) EXPECT_EQ(0, e[i]);
    EXPECT_EQ(255, e[16]);
    EXPECT_EQ(0, e[17]);
  }
}

// Real spherical harmonics.
std::array<double, 9> sh(double x, double y, double z) {
  return {0.282095,
          0.488603 * y,
          0.488603 * z,
          0.488603 * x,
          1.092548 * x * y,
          1.092548 * y * z,
          0.315392 * (3 * z * z - 1),
          1.092548 * x * z,
          0.546274 * (x * x - y * y)};
}
constexpr double kLobe[9] = {kPi, 2 * kPi / 3, 2 * kPi / 3, 2 * kPi / 3, kPi / 4, kPi / 4, kPi / 4, kPi / 4, kPi / 4};

// Coefficients of radiance of light of the given power [W/m2 across its direction] from (x, y, z), all nine, RGB.
std::vector<float> beam(double x, double y, double z, const std::array<double, 3>& power) {
  std::vector<float> result;
  for (const double k : sh(x, y, z))
    for (const double p : power) result.push_back(float(p * k));
  return result;
}

// Random, with the first coefficient the largest by far, as light from all around has it; grey.
std::vector<float> grey_moments(std::mt19937& random) {
  std::uniform_real_distribution<float> number(-0.2f, 0.2f);
  std::vector<float> result;
  for (int k = 0; k < 9; ++k) {
    const float v = k == 0 ? 1 : number(random);
    result.insert(result.end(), 3, v);
  }
  return result;
}

double irradiance(const std::vector<float>& radiance, int channel, int coefficients, double x, double y, double z) {
  const std::array<double, 9> basis = sh(x, y, z);
  double sum = 0;
  for (int k = 0; k < coefficients; ++k) sum += kLobe[k] * radiance[size_t(3 * k + channel)] * basis[size_t(k)];
  return sum;
}

std::array<double, 3> direction(std::mt19937& random) {
  std::uniform_real_distribution<double> number(0, 1);
  const double z = 2 * number(random) - 1, phi = 2 * kPi * number(random), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

TEST(ApiLightmapEncode, ABeamIsAllDominantAndFromWhereItComes) {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const auto [x, y, z] = direction(random);
    const std::vector<float> moments = beam(x, y, z, {2, 3, 1});
    Encoder dominant(BDPT_LIGHTMAP_ENCODING_DOMINANT), mono(BDPT_LIGHTMAP_ENCODING_MONO_SH);
    dominant.desc.texel_stride = mono.desc.texel_stride = 27;
    const std::vector<float> d = dominant.run<float>(moments, 1, 7), m = mono.run<float>(moments, 1, 6);
    EXPECT_EQ(0u, dominant.report.clipped + mono.report.clipped);
    const double power[3] = {2, 3, 1}, expected[3] = {x, y, z};
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(irradiance(moments, int(c), 4, x, y, z), d[c], 1e-5);
      EXPECT_NEAR(expected[c], d[3 + c], 1e-5);
      EXPECT_NEAR(power[c] / 4, m[c], 1e-5);  // a ball's mean
      EXPECT_NEAR(expected[c], m[3 + c], 1e-5);
    }
    EXPECT_NEAR(1, d[6], 1e-5);
  }
}

TEST(ApiLightmapEncode, EvenLightHasNoDirection) {
  std::vector<float> moments(12);
  for (size_t c = 0; c < 3; ++c) moments[c] = float(2 * 4 * kPi * 0.282095);
  Encoder dominant(BDPT_LIGHTMAP_ENCODING_DOMINANT), mono(BDPT_LIGHTMAP_ENCODING_MONO_SH);
  const std::vector<float> d = dominant.run<float>(moments, 1, 7), m = mono.run<float>(moments, 1, 6);
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(2 * kPi, d[c], 1e-4);
    EXPECT_NEAR(2 * kPi, m[c], 1e-4);
    EXPECT_EQ(0, d[3 + c]);
    EXPECT_EQ(0, m[3 + c]);
  }
  EXPECT_EQ(0, d[6]);
}

TEST(ApiLightmapEncode, GreyLightIsWhatItsFirstTwoBandsSay) {
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    const std::vector<float> moments = grey_moments(random);
    Encoder mono(BDPT_LIGHTMAP_ENCODING_MONO_SH);
    mono.desc.texel_stride = 27;
    const std::vector<float> m = mono.run<float>(moments, 1, 6);
    const auto [x, y, z] = direction(random);
    for (size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(irradiance(moments, int(c), 4, x, y, z), m[c] * (1 + 2 * (m[3] * x + m[4] * y + m[5] * z)), 1e-5);
  }
}

TEST(ApiLightmapEncode, MoreDirectionThanABeamHasIsClippedAndCounted) {
  std::vector<float> moments = beam(0, 0.6, 0.8, {1, 1, 1});
  for (size_t i = 3; i < 12; ++i) moments[i] *= 1.5f;
  std::vector<float> black(27, 0.0f), dark = moments;
  for (size_t c = 0; c < 3; ++c) dark[c] = -1;
  moments.insert(moments.end(), black.begin(), black.end());
  moments.insert(moments.end(), dark.begin(), dark.end());
  Encoder mono(BDPT_LIGHTMAP_ENCODING_MONO_SH);
  mono.desc.texel_stride = 27;
  const std::vector<float> m = mono.run<float>(moments, 3, 18);
  EXPECT_EQ(2u, mono.report.clipped);
  EXPECT_NEAR(0.6, m[4], 1e-6);
  EXPECT_NEAR(0.8, m[5], 1e-6);
  for (size_t i = 6; i < 12; ++i) EXPECT_EQ(0, m[i]);
  for (size_t i = 15; i < 18; ++i) EXPECT_EQ(0, m[i]);
}

// The H-basis.
std::array<double, 6> h_basis(double x, double y, double z) {
  const double a = std::sqrt(1 / (2 * kPi)), b = std::sqrt(3 / (2 * kPi)), c = std::sqrt(15 / (2 * kPi));
  return {a, b * y, b * (2 * z - 1), b * x, c * x * y, c * (x * x - y * y) / 2};
}

// Midpoint sums over the hemisphere, even in area.
template <class Visit>
void over_hemisphere(Visit&& visit) {
  constexpr int kRows = 200, kColumns = 400;
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) {
      const double z = (i + 0.5) / kRows, phi = 2 * kPi * (j + 0.5) / kColumns, r = std::sqrt(1 - z * z);
      visit(r * std::cos(phi), r * std::sin(phi), z, 2 * kPi / (kRows * kColumns));
    }
}

std::vector<float> encode_h(const std::vector<float>& moments, int functions) {
  Encoder h(functions == 4 ? BDPT_LIGHTMAP_ENCODING_H4 : BDPT_LIGHTMAP_ENCODING_H6);
  return h.run<float>(moments, 1, size_t(functions) * 3);
}

double evaluate_h(const std::vector<float>& h, int functions, double x, double y, double z) {
  const std::array<double, 6> basis = h_basis(x, y, z);
  double sum = 0;
  for (int k = 0; k < functions; ++k) sum += h[size_t(3 * k)] * basis[size_t(k)];
  return sum;
}

TEST(ApiLightmapEncode, TheHBasisIsOrthonormalOnTheHemisphere) {
  double gram[6][6] = {};
  over_hemisphere([&](double x, double y, double z, double area) {
    const std::array<double, 6> h = h_basis(x, y, z);
    for (size_t i = 0; i < 6; ++i)
      for (size_t j = 0; j < 6; ++j) gram[i][j] += h[i] * h[j] * area;
  });
  for (size_t i = 0; i < 6; ++i)
    for (size_t j = 0; j < 6; ++j) EXPECT_NEAR(i == j, gram[i][j], 1e-4);
}

TEST(ApiLightmapEncode, HCoefficientsAreTheIrradiancesProjections) {
  std::mt19937 random(6);
  for (int i = 0; i < 10; ++i) {
    const std::vector<float> moments = grey_moments(random), h4 = encode_h(moments, 4), h6 = encode_h(moments, 6);
    double projected[6] = {};
    over_hemisphere([&](double x, double y, double z, double area) {
      const double e = irradiance(moments, 0, 9, x, y, z);
      const std::array<double, 6> h = h_basis(x, y, z);
      for (size_t k = 0; k < 6; ++k) projected[k] += e * h[k] * area;
    });
    for (size_t k = 0; k < 6; ++k) EXPECT_NEAR(projected[k], h6[3 * k], 2e-4) << k;
    for (size_t k = 0; k < 4; ++k) EXPECT_EQ(h6[3 * k], h4[3 * k]) << k;
  }
}

// Light from one direction gives a clamped cosine, E(n) = max(0, n.d). Root mean square error over the hemisphere.
double cosine_error(int functions, double angle) {
  const double x = std::sin(angle), z = std::cos(angle);
  const std::vector<float> h = encode_h(beam(x, 0, z, {1, 1, 1}), functions);
  double squares = 0;
  over_hemisphere([&](double nx, double ny, double nz, double area) {
    const double e = std::max(0.0, nx * x + nz * z) - evaluate_h(h, functions, nx, ny, nz);
    squares += e * e * area / (2 * kPi);
  });
  return std::sqrt(squares);
}

TEST(ApiLightmapEncode, TheHBasisGivesBackAClampedCosine) {
  // The lobe's own root mean square is 0.58 for a direction along the normal.
  for (const double degrees : {0, 30, 60, 75}) {
    EXPECT_LT(cosine_error(6, degrees * kPi / 180), 0.08) << degrees;
    EXPECT_LT(cosine_error(4, degrees * kPi / 180), 0.13) << degrees;
    EXPECT_LE(cosine_error(6, degrees * kPi / 180), cosine_error(4, degrees * kPi / 180) + 1e-3) << degrees;
  }
}

TEST(ApiLightmapEncode, CoefficientsOfIrradianceAreThoseOfRadianceTimesTheLobe) {
  std::mt19937 random(7);
  const std::vector<float> radiance = grey_moments(random);
  std::vector<float> scaled = radiance;
  for (size_t i = 0; i < 27; ++i) scaled[i] = float(scaled[i] * kLobe[i / 3]);
  for (const auto& [encoding, floats] :
       {std::pair(BDPT_LIGHTMAP_ENCODING_DOMINANT, 7), std::pair(BDPT_LIGHTMAP_ENCODING_MONO_SH, 6),
        std::pair(BDPT_LIGHTMAP_ENCODING_H4, 12), std::pair(BDPT_LIGHTMAP_ENCODING_H6, 18)}) {
    Encoder from_radiance(encoding), from_irradiance(encoding);
    from_irradiance.desc.sh = BDPT_SH_IRRADIANCE;
    const auto a = from_radiance.run<float>(radiance, 1, size_t(floats));
    const auto b = from_irradiance.run<float>(scaled, 1, size_t(floats));
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5) << encoding << " " << i;
  }
}

TEST(ApiLightmapEncode, CoefficientsMayBeInterleavedOrImagesBehindOneAnother) {
  std::mt19937 random(8);
  constexpr size_t kCount = 5;
  std::vector<float> interleaved, planes(27 * kCount), spread(40 * kCount, kNan);
  for (size_t i = 0; i < kCount; ++i) {
    std::vector<float> moments = grey_moments(random);
    for (float& v : moments) v += 0.01f * float(random() % 8);
    for (size_t k = 0; k < 9; ++k)
      for (size_t c = 0; c < 3; ++c) {
        planes[k * 3 * kCount + 3 * i + c] = moments[3 * k + c];
        spread[40 * i + 4 * k + c] = moments[3 * k + c];
      }
    interleaved.insert(interleaved.end(), moments.begin(), moments.end());
  }
  Encoder a(BDPT_LIGHTMAP_ENCODING_H6), b(BDPT_LIGHTMAP_ENCODING_H6), c(BDPT_LIGHTMAP_ENCODING_H6);
  b.desc.plane_stride = 3 * kCount;
  c.desc.texel_stride = 40, c.desc.plane_stride = 4;
  const auto expected = a.run<float>(interleaved, kCount, 18 * kCount);
  EXPECT_EQ(expected, b.run<float>(planes, kCount, 18 * kCount));
  spread.resize(40 * (kCount - 1) + 4 * 8 + 3);  // no float more than is needed
  EXPECT_EQ(expected, c.run<float>(spread, kCount, 18 * kCount));
  EXPECT_EQ(0u, c.report.not_finite);
}

TEST(ApiLightmapEncode, ATexelThatIsNotFiniteBecomesZeroAndIsCounted) {
  for (const auto& [encoding, floats] :
       {std::pair(BDPT_LIGHTMAP_ENCODING_DOMINANT, 7), std::pair(BDPT_LIGHTMAP_ENCODING_MONO_SH, 6),
        std::pair(BDPT_LIGHTMAP_ENCODING_H4, 12), std::pair(BDPT_LIGHTMAP_ENCODING_H6, 18)}) {
    std::vector<float> moments(81, 0.5f);
    moments[27 + 4] = kNan;
    Encoder encoder(encoding);
    encoder.desc.texel_stride = 27;
    const auto e = encoder.run<float>(moments, 3, size_t(3 * floats));
    EXPECT_EQ(1u, encoder.report.not_finite);
    for (int i = 0; i < floats; ++i) {
      EXPECT_EQ(0, e[size_t(floats + i)]);
      EXPECT_EQ(e[size_t(i)], e[size_t(2 * floats + i)]);
    }
  }
}

TEST(ApiLightmapEncode, BadInputIsRefusedAndNothingWritten) {
  const auto refused = [](const char* word, bdpt_lightmap_encoding encoding,
                          const std::function<void(bdpt_lightmap_encode_desc&)>& change) {
    SCOPED_TRACE(word);
    const std::vector<float> pixels(54, 0.5f);
    std::vector<float> encoded(36, 7);
    bdpt_lightmap_encode_desc desc = make<bdpt_lightmap_encode_desc>();
    desc.encoding = encoding;
    desc.channels = encoding == BDPT_LIGHTMAP_ENCODING_HALF ? 3 : 0;
    desc.texels = 2;
    desc.pixels = pixels.data(), desc.pixels_capacity = 54 * 4;
    desc.encoded = encoded.data(), desc.encoded_capacity = 36 * 4;
    change(desc);
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_lightmap_encode(&desc, nullptr));
    EXPECT_NE(nullptr, std::strstr(bdpt_last_error(), word)) << bdpt_last_error();
    EXPECT_EQ(std::vector<float>(36, 7), encoded);
  };
  constexpr bdpt_lightmap_encoding kHalf = BDPT_LIGHTMAP_ENCODING_HALF, kRgbm = BDPT_LIGHTMAP_ENCODING_RGBM,
                                   kH6 = BDPT_LIGHTMAP_ENCODING_H6;
  refused("encoding", 7, [](auto&) {});
  refused("encoding", -1, [](auto&) {});
  refused("channels", kHalf, [](auto& d) { d.channels = 0; });
  refused("channels", kHalf, [](auto& d) { d.channels = 4097; });
  refused("channels", kRgbm, [](auto& d) { d.channels = 3; });
  refused("sh", kH6, [](auto& d) { d.sh = 2; });
  refused("sh", kHalf, [](auto& d) { d.sh = BDPT_SH_IRRADIANCE; });
  refused("texels", kHalf, [](auto& d) { d.texels = 0; });
  refused("texels", kHalf, [](auto& d) { d.texels = ~uint64_t(0); });
  refused("reserved", kHalf, [](auto& d) { d.reserved = 1; });
  refused("texel_stride", kHalf, [](auto& d) { d.texel_stride = 2; });
  refused("texel_stride", kH6, [](auto& d) { d.texel_stride = 2; });
  refused("texel_stride", kH6, [](auto& d) { d.texel_stride = 65537; });
  refused("plane_stride", kHalf, [](auto& d) { d.plane_stride = 3; });
  refused("plane_stride", kH6, [](auto& d) { d.plane_stride = 2; });
  refused("plane_stride", kH6, [](auto& d) { d.plane_stride = ~uint64_t(0); });
  refused("range", kHalf, [](auto& d) { d.range = 1; });
  refused("range", kRgbm, [](auto& d) { d.range = -1; });
  refused("range", kRgbm, [](auto& d) { d.range = kNan; });
  refused("pixels", kH6, [](auto& d) { d.pixels = nullptr; });
  refused("pixels_capacity", kH6, [](auto& d) { --d.pixels_capacity; });
  refused("pixels_capacity", kRgbm, [](auto& d) { d.pixels_capacity = 23; });
  refused("encoded", kH6, [](auto& d) { d.encoded = nullptr; });
  refused("encoded_capacity", kH6, [](auto& d) { --d.encoded_capacity; });
  refused("encoded_capacity", kRgbm, [](auto& d) { d.encoded_capacity = 7; });
  refused("align", kH6, [](auto& d) { d.encoded = static_cast<char*>(d.encoded) + 2; });
  refused("overlaps", kRgbm, [](auto& d) { d.pixels = static_cast<float*>(d.encoded) + 1; });
}

}  // namespace bdpt_api::api_lightmap_encode_test
