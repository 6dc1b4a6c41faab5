// What varies over a surface gives one picture by all techniques: textures, normals, colours, and what is not there.
#include "material/host.h"
#include "rendering.h"

namespace bdpt::transport_surface_test {

using namespace rendering;

constexpr int kSize = 24;

// A ball, a floor and a screen in the middle of a room, all of one material.
struct Item {
  std::string name;
  std::function<MaterialDesc(scenes::Builder&)> material;
  bool has_specular = false;  // then t <= 1 is not enough
};

Texture checks(float low, float high) {
  std::vector<float> texels;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) texels.push_back((x + y) % 2 ? low : high);
  return scenes::texture(4, 4, 1, texels);
}

Texture waves() {
  std::vector<float> texels;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (double v : {0.5 + 0.2 * std::sin(x * M_PI / 4), 0.5 + 0.2 * std::sin(y * M_PI / 4), 0.95})
        texels.push_back(float(v));
  return scenes::texture(8, 8, 3, texels);
}

MaterialDesc with_opacity(Opacity::Mode mode, float value, int texture = -1) {
  MaterialDesc m = scenes::diffuse(Rgb(0.7f, 0.5f, 0.3f));
  m.opacity.mode = mode;
  m.opacity.value = value;
  m.opacity.texture = texture;
  m.opacity.channel = 0;
  return m;
}

template <class Change>
Material of_kind(MaterialType type, float alpha, const Change& change) {
  Material m = scenes::diffuse(Rgb(0.8f, 0.6f, 0.4f));
  m.type = type;
  m.alpha_u = m.alpha_v = alpha;
  m.eta = Rgb(0.14f, 0.38f, 1.44f);
  m.k = Rgb(3.98f, 2.40f, 1.60f);
  change(m);
  return m;
}

MaterialDesc mix(int first, int second, float weight) {
  MaterialDesc m = scenes::diffuse(1);
  m.type = MaterialType::Mix;
  m.mixed[0] = first, m.mixed[1] = second;
  m.mix = weight;
  return m;
}

// Half of what arrives goes on evenly.
class Even : public HostMaterial {
 public:
  bool evaluate(const Material&, const Rgb& reflectance, const Vec3&, const Vec3&, BsdfValue& v) const override {
    v = {reflectance * kInvPi, 0.5f * kInvPi, 0.5f * kInvPi};
    return true;
  }
  bool sample(const Material&, const Rgb&, const Vec3& p, const float u[3], Vec3& next) const override {
    const float r = safe_sqrt(1 - u[0] * u[0]), phi = kTwoPi * u[1];
    next = Vec3(r * std::cos(phi), r * std::sin(phi), std::copysign(u[0], p.z));
    return true;
  }
};

std::vector<Item> items() {
  using enum MaterialType;
  using scenes::Builder;
  return {
      {"reflectance",
       [](Builder& b) {
         return scenes::textured(scenes::diffuse(Rgb(0.9f, 0.7f, 0.5f)), Slot::Reflectance,
                                 b.add_texture(checks(0.2f, 1)));
       }},
      {"roughness",
       [](Builder& b) {
         return scenes::textured(scenes::conductor(0.5f, 0.5f), Slot::Roughness, b.add_texture(checks(0.4f, 1)));
       }},
      {"roughness, smooth in places",
       [](Builder& b) {
         MaterialDesc m = scenes::textured(scenes::conductor(0.5f, 0.5f), Slot::Roughness, b.add_texture(checks(0, 1)));
         m.textures.back().sampler.filter = TextureFilter::Nearest;
         return m;
       },
       true},
      {"normal",
       [](Builder& b) { return scenes::textured(scenes::diffuse(0.7f), Slot::Normal, b.add_texture(waves())); }},
      {"normal on metal",
       [](Builder& b) {
         return scenes::textured(scenes::conductor(0.4f, 0.4f), Slot::Normal, b.add_texture(waves()));
       }},
      {"bump",
       [](Builder& b) {
         MaterialDesc m = scenes::textured(scenes::diffuse(0.7f), Slot::Bump, b.add_texture(waves()));
         m.textures.back().scale = 0.1f;
         return m;
       }},
      {"rough diffuse",
       [](Builder&) { return of_kind(RoughDiffuse, 0, [](Material& m) { m.diffuse_roughness = 0.8f; }); }},
      {"diffuse transmission",
       [](Builder& b) {
         const Material m = of_kind(DiffuseTransmission, 0, [](Material& d) {
           d.reflectance = Rgb(0.3f), d.transmittance = Rgb(0.6f, 0.4f, 0.2f);
         });
         return scenes::textured(m, Slot::Transmittance, b.add_texture(checks(0.3f, 1)));
       }},
      {"rough metal", [](Builder&) { return scenes::conductor(0.8f, 0.8f); }},
      {"rough glass", [](Builder&) { return scenes::dielectric(1.5f, 0.6f); }},
      {"coated diffuse", [](Builder&) { return of_kind(CoatedDiffuse, 0.3f, [](Material&) {}); }},
      {"coated diffuse, smooth", [](Builder&) { return of_kind(CoatedDiffuse, 0, [](Material& m) { m.ior = 1.8f; }); },
       true},
      {"coated conductor",
       [](Builder&) { return of_kind(CoatedConductor, 0.3f, [](Material& m) { m.coat_alpha = 0.2f; }); }},
      {"coated conductor, smooth over rough", [](Builder&) { return of_kind(CoatedConductor, 0.4f, [](Material&) {}); },
       true},
      {"principled",
       [](Builder& b) {
         const Material m = of_kind(Principled, 0.3f, [](Material& p) {
           p.metalness = 0.5f, p.coat = 0.5f, p.coat_alpha = 0.2f, p.sheen = Rgb(0.3f), p.sheen_alpha = 0.5f;
           p.anisotropy = 0.5f;
         });
         return scenes::textured(m, Slot::Metalness, b.add_texture(checks(0, 1)));
       }},
      {"principled, smooth and glassy",
       [](Builder&) {
         return of_kind(Principled, 0, [](Material& m) { m.transmission = 0.5f, m.metalness = 0.2f, m.coat = 0.5f; });
       },
       true},
      {"principled, rough glass",
       [](Builder&) { return of_kind(Principled, 0.4f, [](Material& m) { m.transmission = 0.8f; }); }},
      {"principled, thin",
       [](Builder&) {
         return of_kind(Principled, 0.4f, [](Material& m) {
           m.transmission = 0.5f, m.thin_walled = true, m.diffuse_transmission = 0.5f, m.transmittance = Rgb(0.7f);
         });
       }},
      {"iridescent paint",
       [](Builder& b) {
         const Material m = of_kind(Principled, 0.3f, [](Material& p) {
           p.metalness = 0.5f, p.film = 1, p.film_ior = 1.8f, p.film_thickness = 400;
         });
         MaterialDesc d = scenes::textured(m, Slot::FilmThickness, b.add_texture(checks(0.2f, 1)));
         d.least_film_thickness = 100;
         return scenes::textured(d, Slot::Film, b.add_texture(checks(0.4f, 1)));
       }},
      {"iridescent glass, smooth",
       [](Builder&) {
         return of_kind(Principled, 0, [](Material& m) { m.transmission = 0.7f, m.film = 1, m.film_thickness = 300; });
       },
       true},
      {"mix",
       [](Builder& b) {
         const int paint = b.add_material(scenes::textured(scenes::diffuse(Rgb(0.7f, 0.2f, 0.1f)), Slot::Reflectance,
                                                           b.add_texture(checks(0.3f, 1)))),
                   metal = b.add_material(scenes::conductor(0.3f, 0.5f));
         return scenes::textured(mix(paint, metal, 0.8f), Slot::Mix, b.add_texture(checks(0.2f, 1)));
       }},
      {"mix of mirror and diffuse",
       [](Builder& b) {
         return mix(b.add_material(scenes::mirror(0.9f)), b.add_material(scenes::diffuse(0.6f)), 0.6f);
       },
       true},
      {"host",
       [](Builder&) {
         MaterialDesc m = of_kind(Host, 0, [](Material&) {});
         m.host_owner = std::make_shared<Even>();
         m.host = m.host_owner.get();
         return m;
       }},
      {"brushed", [](Builder&) { return of_kind(Brushed, 0, [](Material&) {}); }, true},
      {"mask", [](Builder& b) { return with_opacity(Opacity::Mode::Mask, 1, b.add_texture(checks(0, 1))); }},
      {"blend", [](Builder& b) { return with_opacity(Opacity::Mode::Blend, 0.9f, b.add_texture(checks(0.3f, 0.8f))); }},
  };
}

ScenePointer build(const Item& item) {
  scenes::Builder b = scenes::room({.points = !item.has_specular});
  const MaterialDesc m = item.material(b);
  scenes::MeshData screen =
      scenes::quad(Vec3(-0.2f, -1, 0.2f), Vec3(0.5f, -1, 0), Vec3(0.5f, -0.2f, 0), Vec3(-0.2f, -0.2f, 0.2f));
  screen.uv = {Vec2(0, 0), Vec2(1.5f, 0), Vec2(1.5f, 1), Vec2(0, 1)};
  b.add(screen, m);
  b.add_sphere(Vec3(-0.5f, 0.1f, 0.1f), 0.25f, m);
  return b.build();
}

class TransportSurface : public testing::TestWithParam<Item> {};

TEST_P(TransportSurface, AllTechniquesGiveOnePicture) {
  const Item& item = GetParam();
  const ScenePointer scene = build(item);
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  std::vector<TechniqueSet> sets = technique_sets(8);
  if (item.has_specular) std::erase_if(sets, [](const TechniqueSet& set) { return set.name == std::string("light"); });
  expect_one_picture(scene, camera, sets);
}

INSTANTIATE_TEST_SUITE_P(Items, TransportSurface, testing::ValuesIn(items()),
                         [](const auto& info) { return case_name(info.param.name); });

// A screen that is there with half a chance lets half of the light through: by shadow rays and by paths.
TEST(Opacity, ABlendLetsItsPartOfLightThrough) {
  for (int technique : {0, 1}) {
    scenes::Builder b;
    b.add(scenes::quad(Vec3(-1, -1, -2), Vec3(1, -1, -2), Vec3(1, 1, -2), Vec3(-1, 1, -2)), scenes::emitter(Rgb(1)));
    MaterialDesc screen = scenes::diffuse(0);
    screen.opacity.mode = Opacity::Mode::Blend;
    screen.opacity.value = 0.3f;
    b.add(scenes::quad(Vec3(-1, -1, -1), Vec3(1, -1, -1), Vec3(1, 1, -1), Vec3(-1, 1, -1)), screen);
    const SensorPointer camera = scenes::camera({Vec3(0), Vec3(0, 0, -1), 20}, 8, 8);
    const Picture picture = render(b.build(), camera, options_for(technique ? only(0, 2) : only(1, 1), 1), 256, 7);
    // 64 pixels of 256 samples, each there with probability 0.7.
    EXPECT_NEAR(mean_of(*picture.film), 0.7, technique ? 4 * std::sqrt(0.21 / (64 * 256)) : 0.03);
  }
}

TEST(Opacity, AMaskIsThereWhereItReachesTheCutoff) {
  scenes::Builder b;
  b.add(scenes::quad(Vec3(-1, -1, -2), Vec3(1, -1, -2), Vec3(1, 1, -2), Vec3(-1, 1, -2)), scenes::emitter(Rgb(1)));
  MaterialDesc screen = scenes::diffuse(0);
  screen.opacity.mode = Opacity::Mode::Mask;
  screen.opacity.channel = 0;
  screen.opacity.sampler.filter = TextureFilter::Nearest;
  screen.opacity.texture = b.add_texture(scenes::texture(2, 1, 1, {0.4f, 0.5f}));
  scenes::MeshData mesh = scenes::quad(Vec3(-1, -1, -1), Vec3(1, -1, -1), Vec3(1, 1, -1), Vec3(-1, 1, -1));
  mesh.uv = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
  b.add(mesh, screen);
  const SensorPointer camera = scenes::camera({Vec3(0), Vec3(0, 0, -1), 20}, 8, 8);
  const std::vector<float> pixels = read(*render(b.build(), camera, options_for(only(0, 2), 1), 1, 7).film);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(pixels[size_t(3 * (8 * y + x))], x < 4 ? 1 : 0) << x << ", " << y;
}

// An instanced mesh asks for each of its instances.
TEST(Opacity, IsThatOfTheInstance) {
  scenes::Builder b;
  b.add(scenes::quad(Vec3(-2, -1, -2), Vec3(2, -1, -2), Vec3(2, 1, -2), Vec3(-2, 1, -2)), scenes::emitter(Rgb(1)));
  Transform left, right;
  left.m[3] = -0.5f, right.m[3] = 0.5f;
  b.add(scenes::quad(Vec3(-0.5f, -1, -1), Vec3(0.5f, -1, -1), Vec3(0.5f, 1, -1), Vec3(-0.5f, 1, -1)),
        scenes::diffuse(0), left);
  MaterialDesc gone = scenes::diffuse(0);
  gone.opacity.mode = Opacity::Mode::Blend;
  gone.opacity.value = 0;
  const int shape = b.next_shape() - 1;
  b.add_instance(shape, b.add_material(gone), right);
  const SensorPointer camera = scenes::camera({Vec3(0), Vec3(0, 0, -1), 20}, 8, 8);
  const std::vector<float> pixels = read(*render(b.build(), camera, options_for(only(0, 2), 1), 1, 7).film);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_EQ(pixels[size_t(3 * (8 * y + x))], x < 4 ? 0 : 1) << x << ", " << y;
}

// Colours of vertices multiply the reflectance: a floor lit from far above shows their interpolation.
TEST(VertexColors, MultiplyTheReflectance) {
  scenes::Builder b;
  scenes::MeshData floor = scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1));
  floor.colors = {{0, 1, 0.5f, 1}, {1, 1, 0.5f, 1}, {1, 1, 0.5f, 1}, {0, 1, 0.5f, 1}};
  b.add(floor, scenes::diffuse(Rgb(0.5f, 0.5f, 1)));
  b.environment(Rgb(1));
  const SensorPointer camera = scenes::camera({Vec3(0, 1, 0), Vec3(0, 0, 0), 90}, 8, 8);
  // By paths that see the environment, all of a diffuse surface's light has the radiance of its reflectance.
  const std::vector<float> pixels = read(*render(b.build(), camera, options_for(only(0, 3), 2), 4096, 7).film);
  for (int x = 0; x < 8; ++x) {
    const float* p = &pixels[size_t(3 * (8 * 4 + x))];
    EXPECT_NEAR(p[0], 0.5f * (float(x) + 0.5f) / 8, 0.01)
        << x;  // spread of the pixel's place: 0.5 / 8 / sqrt(12 * 4096)
    EXPECT_NEAR(p[1], 0.5f, 1e-3);
    EXPECT_NEAR(p[2], 0.5f, 1e-3);
  }
}

}  // namespace bdpt::transport_surface_test
