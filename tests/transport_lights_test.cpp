// Every kind of light in every technique: the same picture by paths from the eye, from the light, and from both.
#include "light_testing.h"
#include "rendering.h"

namespace bdpt::transport_lights_test {

using namespace rendering;

constexpr int kSize = 32;

struct Case {
  std::string name;
  scenes::RoomOptions room;
  std::vector<MaterialDesc> lamp = {};  // of a square under the ceiling and a ball
  bool screen = false;                  // the square has a picture, and there is no ball
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](const std::string& name, const std::vector<LightDesc>& lights) {
    all.push_back({name, {.contents = scenes::Contents::Glossy, .lamps = false, .lights = lights}});
  };
  add("environment_map", {scenes::environment_map()});
  add("directional", {scenes::directional(0)});
  add("sun", {scenes::directional(3)});
  LightDesc sky;
  sky.type = LightType::Environment;
  sky.radiance = Rgb(0.5f, 0.6f, 1);
  add("sky_and_suns",
      {sky, scenes::directional(0, Rgb(1, 0, 0)), scenes::directional(3, Rgb(0, 2, 1)), scenes::environment_map(0.2f)});
  const auto add_lamp = [&](const std::string& name, const MaterialDesc& m) {
    add(name, {});
    all.back().lamp = {m};
  };
  add_lamp("even_lamps", lights::beam(Rgb(1, 1, 2), -1, true));
  add_lamp("beams", lights::beam(Rgb(5, 4, 3), 6, false));
  add_lamp("screen", scenes::emitter(Rgb(2), true, 0.4f));
  all.back().screen = true;
  add("projector", {lights::projector(Vec3(0.1f, 0.8f, 0.2f), 60)});
  add("photometric", {lights::luminaire(180, Vec3(0.1f, 0.5f, 0.2f))});
  return all;
}

class TransportLights : public testing::TestWithParam<Case> {};

TEST_P(TransportLights, AllTechniquesGiveTheSamePicture) {
  scenes::Builder b = scenes::room(GetParam().room);
  for (const MaterialDesc& m : GetParam().lamp) {
    const Vec3 x(0.4f, 0, 0), z(0, 0, 0.3f), at(0, 0.85f, -0.2f);
    const scenes::MeshData square = scenes::quad(at - x - z, at + x - z, at + x + z, at - x + z);
    if (GetParam().screen) {
      const int texture = b.add_texture(lights::screen());
      b.add(lights::with_uv(square), scenes::textured(m, Slot::Emission, texture));
      continue;
    }
    b.add(square, m);
    b.add_sphere(Vec3(0.65f, 0.35f, -0.5f), 0.15f, m);
  }
  const ScenePointer scene = b.build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), kSize, kSize);
  const std::vector<std::pair<std::string, TechniqueMask>> ways = {
      {"path", mask_of([](int s, int) { return s <= 1; })},
      {"light", mask_of([](int, int t) { return t <= 1; })},
      {"two-way", mask_of([](int s, int t) { return s <= 1 || t <= 1; })},
      {"bidirectional", {}},
      {"s >= 1", mask_of([](int s, int) { return s >= 1; })},
  };
  std::vector<BlockMeans> means;
  std::vector<std::string> names;
  for (const auto& [name, mask] : ways) {
    TransportOptions options = options_for(mask, 4);
    options.light_selection = means.size() == 2 ? LightSelection::Tree : LightSelection::Power;
    options.light_start = means.size() == 3 ? StartBy::Uniform : StartBy::Power;
    means.push_back(block_means(scene, camera, options, {.seeds = 24, .passes = 6, .first_seed = means.size() + 1}));
    names.push_back(name);
  }
  EXPECT_GT(means[0].whole().mean(), 0.01);
  expect_all_same(means, names);
}

INSTANTIATE_TEST_SUITE_P(All, TransportLights, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace bdpt::transport_lights_test
