// All kinds of light, for tests that hold for each of them.
#pragma once

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

inline std::vector<Kind> kinds() {
  using scenes::Builder;
  using Place = Kind::Place;
  const Rgb c(1, 2, 1);
  return {
      {"mesh", [=](Builder& b) { b.add(square(), scenes::emitter(c)); }, Place::Square, 2 * M_PI * 4},
      {"mesh, two-sided", [=](Builder& b) { b.add(square(), scenes::emitter(c, true)); }, Place::Square, 4 * M_PI * 4},
      {"sphere", [=](Builder& b) { b.add_sphere(Vec3(0, 0, 1), 0.5f, scenes::emitter(c)); }, Place::Direction,
       2 * M_PI * M_PI},
      {"sphere, two-sided", [=](Builder& b) { b.add_sphere(Vec3(0, 0, 1), 0.5f, scenes::emitter(c, true)); },
       Place::Direction, 4 * M_PI * M_PI},
      {"point", [=](Builder& b) { b.point(Vec3(0.1f), c); }, Place::Point},
      {"spot", [=](Builder& b) { b.spot(Vec3(0.1f), Vec3(-1, -1, 0.5f), c, 50, 30); }, Place::Point},
      {"environment", [=](Builder& b) { b.environment(c); }, Place::Direction},
      {"environment map", [](Builder& b) { b.light(scenes::environment_map()); }, Place::Direction},
      {"directional", [](Builder& b) { b.light(scenes::directional(0)); }, Place::Point, 4},
      {"sun", [](Builder& b) { b.light(scenes::directional(20)); }, Place::Direction},
  };
}

}  // namespace bdpt::lights
