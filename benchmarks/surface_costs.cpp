// What a sample costs in rooms of one material each, over the same room in diffuse; and in textured rooms, over the
// same without textures.
//
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "material_testing.h"
#include "render/render.h"
#include "scenes.h"
#include "this_thread.h"
#include "timing.h"

namespace bdpt {
namespace {

constexpr int kWidth = 96, kHeight = 64, kMaxEdges = 5;
constexpr float kReflectance = 0.7f;
constexpr uint32_t kTexels = 1024;  // of a picture, each way

using bdpt_benchmark::median;
using bdpt_benchmark::processor_seconds;
using bdpt_benchmark::this_thread;

// A room with a ball and a lamp. Triangles without texture coordinates have half of every picture each.
std::shared_ptr<const Scene> room(scenes::Builder& b, const MaterialDesc& material) {
  b.add(scenes::box(Vec3(-2, 0, -2), Vec3(2, 3, 2), true), material);
  b.add_sphere(Vec3(0.3f, 0.8f, -0.2f), 0.8f, material);
  b.add(
      scenes::quad(Vec3(-0.5f, 2.9f, -0.5f), Vec3(0.5f, 2.9f, -0.5f), Vec3(0.5f, 2.9f, 0.5f), Vec3(-0.5f, 2.9f, 0.5f)),
      scenes::emitter(Rgb(10)));
  return b.build();
}

struct Case {
  std::string name;
  std::shared_ptr<const Scene> scene;
  int base = 0;  // the case it is compared with
  std::vector<double> seconds;
};

Case material_case(const material_testing::Named& named) {
  scenes::Builder b;
  return {named.name, room(b, material_testing::reflecting(named.material, kReflectance)), 0, {}};
}

// As files have them, with 8 bits a channel. Numbers from low to low + 63.
Texture picture(uint32_t channels, bool srgb, const std::array<int, 3>& low) {
  TextureImage image;
  image.width = image.height = kTexels;
  image.channels = channels;
  image.format = TexelFormat::Uint8;
  image.srgb = srgb;
  for (uint32_t y = 0; y < kTexels; ++y)
    for (uint32_t x = 0; x < kTexels; ++x)
      for (uint32_t c = 0; c < channels; ++c)
        image.texels.push_back(std::byte(uint32_t(low[c]) + (x * 7 + y * 13 + c * 5) % 64));
  return Texture(std::move(image));
}

MaterialDesc rough_principled(float reflectance) {
  MaterialDesc m;
  m.type = MaterialType::Principled;
  m.alpha_u = m.alpha_v = 0.3f;
  m.reflectance = Rgb(reflectance);
  return m;
}

std::shared_ptr<const Scene> textured_room(const MaterialDesc& plain, const std::vector<Slot>& slots) {
  scenes::Builder b;
  const int colors = b.add_texture(picture(3, true, {187, 187, 187}));  // kReflectance, about
  const int numbers = b.add_texture(picture(1, false, {187, 187, 187}));
  const int normals = b.add_texture(picture(3, false, {96, 96, 192}));
  MaterialDesc m = plain;
  for (Slot slot : slots)
    m = scenes::textured(m, slot, slot == Slot::Reflectance ? colors : slot == Slot::Normal ? normals : numbers);
  return room(b, m);
}

std::vector<Case> cases(const std::string& only) {
  using namespace material_testing;
  std::vector<Case> all = {material_case({"diffuse", diffuse()})};
  for (const auto& list : {nonspecular_materials(), partly_specular_materials(), specular_materials()})
    for (const Named& named : list)
      if (named.material.type != MaterialType::Mix && named.name.find(only) != std::string::npos)
        all.push_back(material_case(named));
  const MaterialDesc white = scenes::diffuse(1);
  all.push_back({"diffuse, textured", textured_room(white, {Slot::Reflectance}), 0, {}});
  all.push_back(
      {"diffuse, textured with a normal map", textured_room(white, {Slot::Reflectance, Slot::Normal}), 0, {}});
  const int principled = int(all.size());
  all.push_back({"principled", textured_room(rough_principled(kReflectance), {}), 0, {}});
  all.push_back({"principled, textured", textured_room(rough_principled(1), {Slot::Reflectance}), principled, {}});
  all.push_back(
      {"principled, with pictures of colour, roughness, metalness and normals",
       textured_room(rough_principled(1), {Slot::Reflectance, Slot::Roughness, Slot::Metalness, Slot::Normal}),
       principled,
       {}});
  return all;
}

double render_seconds(const Case& c, const std::shared_ptr<const Sensor>& camera) {
  FilmDesc film;
  film.width = kWidth, film.height = kHeight;
  RenderDesc desc;
  desc.transport.max_edges = kMaxEdges;
  Render render(c.scene, camera, std::make_shared<Film>(film, nullptr), this_thread(), nullptr, desc);
  AdvanceDesc advance;
  advance.passes = 4;
  const double begin = processor_seconds();
  render.advance(advance);
  return processor_seconds() - begin;
}

}  // namespace
}  // namespace bdpt

int main(int argc, char** argv) {
  using namespace bdpt;
  const int turns = argc > 1 ? std::atoi(argv[1]) : 9;
  if (turns < 1) return std::fprintf(stderr, "usage: bdpt_surface_costs [TURNS (1 or more) [MATERIAL]]\n"), 2;
  std::vector<Case> all = cases(argc > 2 ? argv[2] : "");
  const auto camera =
      scenes::camera({.from = Vec3(1.7f, 1.6f, 1.7f), .to = Vec3(0, 1, 0), .field_of_view = 60}, kWidth, kHeight);
  for (int turn = -1; turn < turns; ++turn)  // the first warms up
    for (Case& c : all) {
      const double seconds = render_seconds(c, camera);
      if (turn >= 0) c.seconds.push_back(seconds);
    }
  std::printf("| room | x | over |\n| --- | --- | --- |\n");
  for (const Case& c : all) {
    std::vector<double> ratios;
    for (size_t i = 0; i < c.seconds.size(); ++i) ratios.push_back(c.seconds[i] / all[size_t(c.base)].seconds[i]);
    std::printf("| %s | %.2f | %s |\n", c.name.c_str(), median(ratios), all[size_t(c.base)].name.c_str());
  }
  return 0;
}
