// All kinds of light, for tests that hold for each of them.
#pragma once

#include "light/photometry.h"
#include "scenes.h"

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace bdpt::lights {

struct Kind {
  std::string name;
  std::function<void(scenes::Builder&)> add;  // as the only light
  // What a place on it is told by: the normal's direction, or x and y within [-1,1] x [-1,1]; nothing of a point.
  enum class Place { Direction, Square, Point } place;
  // Of all that is emitted, in green; below 0: by quadrature of what is emitted. Per area of the disk if infinite.
  double power = -1;
};
inline std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

inline scenes::MeshData square() {
  return scenes::quad(Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0));
}

inline MaterialDesc beam(const Rgb& radiance, float exponent, bool two_sided) {
  MaterialDesc m = scenes::emitter(radiance, two_sided, 0.3f);
  m.emission_exponent = exponent;
  return m;
}

// Down, off the axes.
inline LightDesc projector(const Vec3& position = Vec3(0.1f), double angle = 50) {
  LightDesc l;
  l.type = LightType::Spot;
  l.position = position;
  l.direction = unit(Vec3(-0.3f, -1, -0.4f));
  l.up = Vec3(1, 1, 0);
  l.cos_outer = float(std::cos(angle * M_PI / 180));
  l.cos_inner = float(std::cos(0.7 * angle * M_PI / 180));
  l.intensity = Rgb(2, 3, 2);
  l.texture = scenes::picture(7, 5, [](uint32_t x, uint32_t y) {
    return x == 2 && y == 3 ? Rgb(9, 9, 5) : (x + y) % 3 == 0 ? Rgb() : Rgb(1, 0.5f, 0.2f * float(x));
  });
  return l;
}

// Measured to this horizontal angle, from 10 degrees off the axis to 130.
inline LightDesc luminaire(float last, const Vec3& position = Vec3(0.1f)) {
  LightDesc l;
  l.position = position;
  l.direction = unit(Vec3(-0.3f, -1, -0.4f));
  l.up = Vec3(1, 1, 0);
  l.intensity = Rgb(0.5f, 1, 1);
  auto p = std::make_shared<Photometry>();
  p->vertical = {10, 20, 45, 60, 90, 130};
  for (float h : {0.0f, 0.2f, 0.5f, 1.0f})
    if (last > 0 || h == 0) p->horizontal.push_back(h * last);
  for (size_t i = 0; i < p->horizontal.size(); ++i)
    for (size_t k = 0; k < p->vertical.size(); ++k)
      p->intensities.push_back((i + k) % 4 == 1 ? 0 : 1 + float((5 * i + 3 * k) % 7));
  l.photometry = p;
  return l;
}

inline std::shared_ptr<const Texture> screen() {
  return scenes::picture(6, 5, [](uint32_t x, uint32_t y) {
    return x == 4 && y == 1 ? Rgb(3, 8, 3) : x < 3 && y > 1 ? Rgb() : Rgb(1, 0.25f * float(x + y), 2);
  });
}

inline scenes::MeshData with_uv(scenes::MeshData mesh) {
  mesh.uv = {Vec2(-0.3f, 0.1f), Vec2(1.2f, 0), Vec2(1, 0.9f), Vec2(0, 1)};
  return mesh;
}

inline void add_textured(scenes::Builder& b, bool two_sided) {
  const int texture = b.add_texture(screen());
  b.add(with_uv(square()), scenes::textured(scenes::emitter(Rgb(1, 2, 1), two_sided), Slot::Emission, texture));
}

// Three, of which rays meet two, and one is beside the scene in part.
inline LightDesc with_portals(LightDesc l) {
  l.portals = {{Vec3(-1, -1, -1), Vec3(2, 0.5f, 0), Vec3(-0.5f, 2, 0)},
               {Vec3(1, -1.5f, -2), Vec3(-1, 0, 2), Vec3(0, 3, 0)},
               {Vec3(2, 3, -3), Vec3(0, 0, 3), Vec3(3, 0, 0)}};
  return l;
}
inline LightDesc environment(const Rgb& radiance) {
  LightDesc l;
  l.type = LightType::Environment;
  l.radiance = radiance;
  return l;
}

inline std::vector<Kind> kinds() {
  using scenes::Builder;
  using Place = Kind::Place;
  const Rgb c(1, 2, 1);
  return {
      {"mesh", [=](Builder& b) { b.add(square(), scenes::emitter(c)); }, Place::Square, 2 * M_PI * 4},
      {"mesh, two-sided", [=](Builder& b) { b.add(square(), scenes::emitter(c, true)); }, Place::Square, 4 * M_PI * 4},
      {"textured mesh", [](Builder& b) { add_textured(b, false); }, Place::Square},
      {"textured mesh, two-sided", [](Builder& b) { add_textured(b, true); }, Place::Square},
      {"sphere", [=](Builder& b) { b.add_sphere(Vec3(0, 0, 1), 0.5f, scenes::emitter(c)); }, Place::Direction,
       2 * M_PI * M_PI},
      {"sphere, two-sided", [=](Builder& b) { b.add_sphere(Vec3(0, 0, 1), 0.5f, scenes::emitter(c, true)); },
       Place::Direction, 4 * M_PI * M_PI},
      {"mesh, beam", [=](Builder& b) { b.add(square(), beam(c, 5, false)); }, Place::Square, 2 * M_PI * 4 * 2 / 7},
      {"mesh, even, two-sided", [=](Builder& b) { b.add(square(), beam(c, -1, true)); }, Place::Square,
       4 * M_PI * 4 * 2},
      {"sphere, even", [=](Builder& b) { b.add_sphere(Vec3(0, 0, 1), 0.5f, beam(c, -1, false)); }, Place::Direction,
       2 * M_PI * M_PI * 2},
      {"point", [=](Builder& b) { b.point(Vec3(0.1f), c); }, Place::Point},
      {"spot", [=](Builder& b) { b.spot(Vec3(0.1f), Vec3(-1, -1, 0.5f), c, 50, 30); }, Place::Point},
      {"environment", [=](Builder& b) { b.environment(c); }, Place::Direction},
      {"environment map", [](Builder& b) { b.light(scenes::environment_map()); }, Place::Direction},
      {"directional", [](Builder& b) { b.light(scenes::directional(0)); }, Place::Point, 4},
      {"projector", [](Builder& b) { b.light(projector()); }, Place::Point},
      {"photometric", [](Builder& b) { b.light(luminaire(90)); }, Place::Point},
      {"photometric, alike", [](Builder& b) { b.light(luminaire(0)); }, Place::Point},
      {"sun", [](Builder& b) { b.light(scenes::directional(20)); }, Place::Direction},
      {"environment, portals", [=](Builder& b) { b.light(with_portals(environment(c))); }, Place::Direction},
      {"environment map, portals", [](Builder& b) { b.light(with_portals(scenes::environment_map())); },
       Place::Direction},
      {"directional, portals", [](Builder& b) { b.light(with_portals(scenes::directional(0))); }, Place::Point, 4},
      {"sun, portals", [](Builder& b) { b.light(with_portals(scenes::directional(20))); }, Place::Direction},
  };
}

}  // namespace bdpt::lights
