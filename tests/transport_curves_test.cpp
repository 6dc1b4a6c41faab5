// Curves in transport: what they look like in known light, and one picture by all techniques.
#include "curve_scenes.h"
#include "rendering.h"
#include "transport/plan.h"

namespace bdpt::transport_curves_test {

using namespace rendering;
using scenes::Strands;

constexpr int kSize = 24;

// A tuft of bent and tapered hair on the floor of the room.
Strands tuft(CurveBasis basis) {
  Strands s{basis, {}, {}};
  for (int i = 0; i < 16; ++i) {
    const auto number = [&](int k) { return float(hash_values(i, k) >> 40) * 0x1p-24f; };
    const float x = number(0) - 0.5f, z = number(1) - 0.5f, dx = number(2) - 0.5f, dz = number(3) - 0.5f;
    const int n = basis == CurveBasis::Linear ? 5 : basis == CurveBasis::Bezier ? 7 : 6;
    for (int k = 0; k < n; ++k) {
      const float t = float(k) / float(n - 1);
      s.points.push_back({Vec3(x + dx * t * t + 0.1f * std::sin(6 * t + dx), -1.1f + 1.2f * t, z + dz * t * t),
                          0.06f * (1 - 0.7f * t)});
    }
    s.counts.push_back(uint32_t(n));
  }
  return s;
}

Transform placed(float sx, float sy, float sz, const Vec3& to) {
  Transform t;
  t.m[0] = sx * 0.8f, t.m[1] = sy * -0.6f, t.m[4] = sx * 0.6f, t.m[5] = sy * 0.8f, t.m[10] = sz;
  for (int row = 0; row < 3; ++row) t.m[4 * row + 3] = to[row];
  return t;
}

struct Item {
  std::string name;
  CurveBasis basis;
  std::function<MaterialDesc(scenes::Builder&)> material;
  bool has_specular = false;
};

MaterialDesc there_in_part(scenes::Builder& b, Opacity::Mode mode) {
  MaterialDesc m = scenes::diffuse(Rgb(0.7f, 0.5f, 0.3f));
  m.opacity.mode = mode;
  m.opacity.texture = b.add_texture(scenes::texture(4, 1, 1, {0.9f, 0.3f, 0.8f, 0.4f}));
  m.opacity.channel = 0;
  return m;
}

std::vector<Item> items() {
  const auto brown = [](scenes::Builder&) { return MaterialDesc(scenes::diffuse(Rgb(0.8f, 0.6f, 0.4f))); };
  return {{"linear", CurveBasis::Linear, brown},
          {"Bezier", CurveBasis::Bezier, brown},
          {"B-spline", CurveBasis::BSpline, brown},
          {"Catmull-Rom", CurveBasis::CatmullRom, brown},
          {"rough metal along the hair", CurveBasis::BSpline,
           [](scenes::Builder&) { return MaterialDesc(scenes::conductor(0.3f, 0.7f)); }},
          {"brushed", CurveBasis::BSpline,
           [](scenes::Builder&) {
             MaterialDesc m = scenes::diffuse(0.8f);
             m.type = MaterialType::Brushed;
             return m;
           },
           true},
          {"textured", CurveBasis::Linear,
           [](scenes::Builder& b) {
             return scenes::textured(scenes::diffuse(0.9f), Slot::Reflectance,
                                     b.add_texture(scenes::texture(4, 1, 1, {0.1f, 0.9f, 0.4f, 0.8f})));
           }},
          {"mask", CurveBasis::BSpline, [](scenes::Builder& b) { return there_in_part(b, Opacity::Mode::Mask); }},
          {"blend", CurveBasis::Linear, [](scenes::Builder& b) { return there_in_part(b, Opacity::Mode::Blend); }}};
}

class TransportCurves : public testing::TestWithParam<Item> {};

TEST_P(TransportCurves, AllTechniquesGiveOnePicture) {
  const Item& item = GetParam();
  scenes::Builder b = scenes::room({.points = !item.has_specular});
  const int shape = b.next_shape();
  const MaterialDesc m = item.material(b);
  b.add(scenes::curves(tuft(item.basis)), m, {});
  b.add_instance(shape, b.add_material(m), placed(0.5f, 0.9f, 0.4f, Vec3(0.5f, -0.3f, 0)));
  b.moving(placed(0.6f, 0.8f, 0.4f, Vec3(0.4f, 0, 0.1f)));
  const ScenePointer scene = b.build();
  std::vector<TechniqueSet> sets = technique_sets(4);
  if (item.has_specular) std::erase_if(sets, [](const TechniqueSet& set) { return set.name == std::string("light"); });
  expect_one_picture(scene, scenes::camera(scenes::room_view(), kSize, kSize), sets);
}

INSTANTIATE_TEST_SUITE_P(Items, TransportCurves, testing::ValuesIn(items()),
                         [](const auto& info) { return case_name(info.param.name); });

// Hair that absorbs nothing cannot be seen in light that comes alike from everywhere, inside of open tubes neither.
TEST(CurvesFurnace, HairThatAbsorbsNothingIsNotSeen) {
  for (const CurveBasis basis : scenes::kBases)
    for (const float scale : {1.0f, 1e-3f}) {
      scenes::Builder b(scale);
      const float s = 0.7f * scale;
      b.add(scenes::curves(tuft(basis)), scenes::diffuse(1), placed(s, 1.2f * s, s, Vec3(0)));
      b.environment(Rgb(1));
      const SensorPointer camera = scenes::camera({Vec3(0, 0, 3), Vec3(0), 45}, 8, 8, scale);
      TransportOptions options = options_for(mask_of([](int s0, int) { return s0 == 0; }));
      options.roulette_start = 1000;
      const Picture picture = render(b.build(), camera, options, 64, 7);
      EXPECT_EQ(picture.film->rejected(), 0u);
      for (const float v : read(*picture.film)) EXPECT_NEAR(v, 1, 1e-3) << int(basis) << ' ' << scale;
    }
}

// A cylinder with round caps in sunlight: irradiance by the cosine with its normal, over pi.
TEST(CurvesClosedForm, AThickLineInSunlightIsALambertianCylinder) {
  constexpr float kRadius = 0.5f;
  const Vec3 sun = unit(Vec3(0.2f, -0.8f, -0.6f));
  scenes::Builder b;
  b.add(scenes::curves({CurveBasis::Linear, {{Vec3(-1, 0, 0), kRadius}, {Vec3(1, 0, 0), kRadius}}, {}}),
        scenes::diffuse(0.5f), {});
  LightDesc light = scenes::directional(0, Rgb(2));
  light.direction = sun;
  b.light(light);
  constexpr int kSide = 12, kSub = 16;
  const scenes::Viewpoint view{Vec3(0, 0, 4), Vec3(0), 50};
  const std::vector<float> pixels =
      read(*render(b.build(), scenes::camera(view, kSide, kSide), options_for(only(1, 2), 2), 4096, 7).film);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      double sum = 0;
      for (int i = 0; i < kSub * kSub; ++i) {
        const double px = (x + (i % kSub + 0.5) / kSub) / kSide * 2 - 1,
                     py = 1 - (y + (i / kSub + 0.5) / kSub) / kSide * 2;
        const float half = std::tan(25 * kPi / 180);
        const Vec3 w = unit(Vec3(float(px) * half, float(py) * half, -1));
        // March along the ray by the distance to the axis, which is that to the surface.
        Vec3 p = view.from;
        float distance = 1;
        for (int k = 0; k < 200 && distance > 1e-5f && p.z > -2; ++k) {
          const Vec3 r = p - Vec3(std::clamp(p.x, -1.0f, 1.0f), 0, 0);
          p += w * (distance = length(r) - kRadius);
        }
        if (distance > 1e-5f) continue;
        const Vec3 n = unit(p - Vec3(std::clamp(p.x, -1.0f, 1.0f), 0, 0));
        sum += std::max(0.0f, -dot(n, sun)) * 2 * 0.5 / M_PI;
      }
      const double expected = sum / (kSub * kSub);
      // 4096 independent samples of values within [0, 1/pi], and the quadrature's own error at the outline.
      EXPECT_NEAR(pixels[size_t(3 * (kSide * y + x))], expected, 5 * 0.16 / 64 + 0.004) << x << ' ' << y;
    }
}

TEST(CurvesScene, RefusesWhatCurvesCannotBe) {
  const auto expect_refused = [](const MaterialDesc& m, const char* part) {
    scenes::Builder b;
    b.add_texture(scenes::texture(1, 1, 1, {0.5f}));
    b.add(scenes::curves(scenes::bent(CurveBasis::Linear)), m, {});
    b.environment(Rgb(1));
    try {
      b.build();
      ADD_FAILURE() << part;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  };
  expect_refused(scenes::emitter(Rgb(1)), "emits");
  expect_refused(scenes::dielectric(1.5f), "refracts");
  expect_refused(scenes::textured(scenes::diffuse(1), Slot::Normal, 0), "NORMAL");
  expect_refused(scenes::textured(scenes::diffuse(1), Slot::Bump, 0), "BUMP");
}

}  // namespace bdpt::transport_curves_test
