// Textures of the host's: they show what an image would, in every technique, and are asked in batches.
#include "base/error.h"
#include "rendering.h"
#include "transport/plan.h"

#include <limits>

namespace bdpt::transport_host_texture_test {

using namespace rendering;

constexpr int kSize = 24;

// A function of the place, and how it was asked.
class Asked : public HostTexture {
 public:
  explicit Asked(std::function<Rgba(const TexturePlace&)> color) : color_(std::move(color)) {}
  void look_up(size_t count, const TexturePlace* places, Rgba* colors) const override {
    ++calls;
    lookups += count;
    if (count == 0) fail(ErrorCode::Internal, "no places");
    for (size_t i = 0; i < count; ++i) colors[i] = color_(places[i]);
  }
  mutable std::atomic<uint64_t> calls = 0, lookups = 0;

 private:
  std::function<Rgba(const TexturePlace&)> color_;
};

Texture pattern() {
  std::vector<float> texels;
  for (int i = 0; i < 8 * 4; ++i)
    for (int c = 0; c < 3; ++c) texels.push_back(0.25f + 0.7f * float((i * 7 + c * 5) % 11) / 11);
  return scenes::texture(8, 4, 3, texels);
}

TextureSampler nearest() {
  TextureSampler sampler;
  sampler.filter = TextureFilter::Nearest;
  return sampler;
}

// The pattern as an image, or as a function that looks it up.
struct Source {
  bool hosts;
  std::shared_ptr<const Texture> image = std::make_shared<const Texture>(pattern());
  std::shared_ptr<Asked> function = make();

  std::shared_ptr<Asked> make() const {
    auto made =
        std::make_shared<Asked>([image = image](const TexturePlace& p) { return image->lookup(p.uv, nearest()); });
    made->step = Vec2(1 / 8.0f, 1 / 4.0f);
    return made;
  }
  TextureUse use(scenes::Builder& b, Slot slot, float scale = 1) const {
    TextureUse use;
    use.slot = slot;
    use.scale = scale;
    use.uv.m[0] = 2, use.uv.m[1] = 0.5f, use.uv.m[4] = 3;
    use.uv.m[2] = 0.13f * float(int(slot));  // none is like another
    if (hosts) {
      use.is_hosts = true;
      use.texture = b.add_host_texture(function);
    } else {
      use.texture = b.add_texture(image);
      use.sampler = nearest();
    }
    return use;
  }
};

// Every way in which a surface asks: colours, numbers, normals, heights, parts of a mix, what moves, and in a medium.
ScenePointer room(const Source& source, bool fog = false) {
  scenes::Builder b = scenes::room({});
  const auto textured = [&](MaterialDesc m, std::initializer_list<std::pair<Slot, float>> slots) {
    for (const auto& [slot, scale] : slots) m.textures.push_back(source.use(b, slot, scale));
    return m;
  };
  scenes::MeshData screen =
      scenes::quad(Vec3(-0.2f, -1, 0.2f), Vec3(0.5f, -1, 0), Vec3(0.5f, -0.2f, 0), Vec3(-0.2f, -0.2f, 0.2f));
  screen.uv = {Vec2(0, 0), Vec2(1.5f, 0), Vec2(1.5f, 1), Vec2(0, 1)};
  const MaterialDesc paint = textured(scenes::diffuse(0.9f), {{Slot::Reflectance, 1}, {Slot::Bump, 0.05f}});
  const MaterialDesc metal = textured(scenes::conductor(0.5f, 0.5f), {{Slot::Roughness, 1}, {Slot::Normal, 0.3f}});
  b.add(screen, paint);
  b.add_sphere(Vec3(-0.5f, 0.1f, 0.1f), 0.25f, metal);
  MaterialDesc mix = scenes::diffuse(1);
  mix.type = MaterialType::Mix;
  mix.mix = 0.8f;
  mix.mixed[0] = b.add_material(textured(scenes::diffuse(0.7f), {{Slot::Reflectance, 1}}));
  mix.mixed[1] = b.add_material(textured(scenes::conductor(0.4f, 0.4f), {{Slot::Roughness, 1}}));
  mix = textured(mix, {{Slot::Mix, 1}, {Slot::Bump, 0.02f}});
  for (Vec3& p : screen.positions) p += Vec3(-0.5f, 0.3f, -0.2f);
  Transform end;
  end.m[3] = 0.2f;
  b.add(screen, mix).moving(end);
  if (fog) b.outside(b.add_medium(std::make_shared<const Medium>(Medium{"fog", Rgb(0.1f), Rgb(0.2f), 0.3f})));
  return b.build();
}

TEST(HostTexture, ShowsThePictureOfTheImageThatItRepeats) {
  const Source image{false}, hosts{true};
  const SensorPointer camera = scenes::camera(scenes::room_view_through_lens(), kSize, kSize);
  for (const bool fog : {false, true}) {
    const ScenePointer of_image = room(image, fog), of_host = room(hosts, fog);
    const auto expect_same_bits = [&](const std::string& name, const TransportOptions& options, uint64_t passes = 2) {
      const Picture a = render(of_image, camera, options, passes, 7), b = render(of_host, camera, options, passes, 7);
      EXPECT_EQ(read(*a.film), read(*b.film)) << name << (fog ? " in fog" : "");
      EXPECT_TRUE(mean_of(*a.film) > 0 || name == "(3,0)") << name;  // that is seldom
      EXPECT_EQ(a.stats.rejected, b.stats.rejected) << name;
    };
    for (int s = 0; s <= 3; ++s)
      for (int t = 0; t <= 3; ++t)
        if (s + t >= 3) expect_same_bits(technique_name(s, t), options_for(only(s, t), 5));
    for (const auto& [plan, passes] : {std::pair("one-to-one", 1), {"two-way", 1}, {"pooled", 1}, {"mmlt", 16}}) {
      TransportOptions options = options_for({}, 5);
      options.plan = find_plan(plan);
      expect_same_bits(plan, options, uint64_t(passes));
    }
  }
}

TEST(HostTexture, IsAskedForAWaveAtOnce) {
  const Source source{true};
  const SensorPointer camera = scenes::camera(scenes::room_view(), 64, 64);
  render(room(source), camera, options_for({}, 5), 2, 7);
  const double mean = double(source.function->lookups) / double(source.function->calls);
  RecordProperty("mean_count", std::to_string(mean));
  EXPECT_GT(mean, 15) << source.function->calls << " calls";  // each of seven uses on a part of the room
}

TEST(HostTexture, TellsPositionAndInstance) {
  scenes::Builder b;
  const auto function = std::make_shared<Asked>([](const TexturePlace& p) {
    return Rgba{0.5f + 0.25f * p.position.x, 0.5f + 0.25f * p.position.z, p.instance == 7 ? 1.0f : 0.25f, 1};
  });
  MaterialDesc m = scenes::diffuse(1);
  TextureUse use;
  use.is_hosts = true;
  use.texture = b.add_host_texture(function);
  m.textures.push_back(use);
  // Two instances of one square, side by side, in the light of an environment of radiance 1.
  Transform left, right;
  left.m[3] = -0.5f, right.m[3] = 0.5f;
  b.add(scenes::quad(Vec3(-0.5f, 0, 1), Vec3(0.5f, 0, 1), Vec3(0.5f, 0, -1), Vec3(-0.5f, 0, -1)), m, left);
  b.with_id(7).add_instance(b.next_shape() - 1, b.next_shape() - 1, right).with_id(9);
  b.environment(Rgb(1));
  const SensorPointer camera = scenes::camera({Vec3(0, 1, 0), Vec3(0, 0, 0), 90}, 8, 8);
  const std::vector<float> pixels = read(*render(b.build(), camera, options_for(only(0, 3), 2), 4096, 7).film);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const float* p = &pixels[size_t(3 * (8 * y + x))];
      // Over a pixel the place is spread by 0.25 / sqrt(12), of which the mean of 4096 has a 64th.
      EXPECT_NEAR(p[0], 0.5f + 0.25f * (-1 + (float(x) + 0.5f) / 4), 0.002) << x << ", " << y;
      EXPECT_NEAR(p[1], 0.5f + 0.25f * (-1 + (float(y) + 0.5f) / 4), 0.002) << x << ", " << y;
      EXPECT_NEAR(p[2], x < 4 ? 1 : 0.25f, 1e-4) << x << ", " << y;
    }
}

// What breaks the promise ends the subpath, is counted, and leaves the rest alone.
TEST(HostTexture, AnAnswerThatIsNoColorIsRejected) {
  const SensorPointer camera = scenes::camera({Vec3(0, 1, 0), Vec3(0, 0, 0), 90}, 8, 8);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -0.1f, 1.1f})
    for (const size_t channel : {size_t(0), size_t(3)})
      for (const bool fog : {false, true}) {
        scenes::Builder b;
        const auto function = std::make_shared<Asked>([=](const TexturePlace& p) {
          Rgba color{0.5f, 0.5f, 0.5f, 1};
          if (p.position.x < 0) color[channel] = bad;
          return color;
        });
        MaterialDesc m = scenes::diffuse(1);
        TextureUse use;
        use.is_hosts = true;
        use.texture = b.add_host_texture(function);
        m.textures.push_back(use);
        b.add(scenes::quad(Vec3(-1, 0, 1), Vec3(1, 0, 1), Vec3(1, 0, -1), Vec3(-1, 0, -1)), m);
        b.point(Vec3(0, 1, 0), Rgb(1));
        if (fog) b.outside(b.add_medium(std::make_shared<const Medium>(Medium{"fog", Rgb(0.1f), Rgb(0), 0})));
        const Picture picture = render(b.build(), camera, options_for(only(1, 2), 2), 16, 7);
        EXPECT_EQ(picture.stats.rejected, 16u * 32u) << bad << ' ' << fog;
        EXPECT_EQ(picture.film->rejected(), 16u * 32u) << bad << ' ' << fog;
        const std::vector<float> pixels = read(*picture.film);
        for (int i = 0; i < 64; ++i) EXPECT_EQ(pixels[size_t(3 * i)] > 0, i % 8 >= 4) << i;
      }
}

TEST(HostTexture, OfSlotsThatAreNotBoundedMayGoUpToItsMaximum) {
  const auto function = std::make_shared<Asked>([](const TexturePlace&) { return Rgba{3, 0, 0, 0}; });
  function->maximum = 3;
  EXPECT_TRUE(function->keeps_promise({3, 0, 0, 0}));
  EXPECT_FALSE(function->keeps_promise({3.1f, 0, 0, 0}));
}

TEST(HostTexture, IsPartOfWhatIdentifiesTheScene) {
  const auto hash = [](uint64_t own, float maximum, float step) {
    scenes::Builder b = scenes::room({});
    const auto function = std::make_shared<Asked>([](const TexturePlace&) { return Rgba{}; });
    function->hash = own, function->maximum = maximum, function->step = Vec2(step);
    MaterialDesc m = scenes::diffuse(1);
    TextureUse use;
    use.is_hosts = true;
    use.texture = b.add_host_texture(function);
    m.textures.push_back(use);
    b.add_sphere(Vec3(0), 0.1f, m);
    return b.build()->info().hash;
  };
  EXPECT_EQ(hash(1, 1, 0.5f), hash(1, 1, 0.5f));
  EXPECT_NE(hash(1, 1, 0.5f), hash(2, 1, 0.5f));
  EXPECT_NE(hash(1, 1, 0.5f), hash(1, 2, 0.5f));
  EXPECT_NE(hash(1, 1, 0.5f), hash(1, 1, 0.25f));
}

}  // namespace bdpt::transport_host_texture_test
