// What a light is: a record of what most questions need, and the functions of its kind.
//
// Veach's convention: L_e is split into L_e^(0), a position, and L_e^(1), a direction, and the directional part is
// treated as a BSDF at y0. Densities of position are per area, those of direction per projected solid angle. An
// infinitely far light has no area: its y0 is a direction, its density of "position" is per solid angle, its density
// of "direction" per area across it, that of the ray to y1, and the geometry factor of its edge is the cosine at the other
// end alone; with that every formula stays as it is. Of a light that is a Dirac, in position or direction,
// the density is the Dirac's coefficient, one.
#pragma once

#include "light/light_desc.h"
#include "light/light_tree.h"
#include "math/vec.h"

#include <cstddef>
#include <cstdint>

namespace bdpt {

// y0 of a light subpath or of direct lighting. The tag says which light and which side of it.
struct LightPoint {
  int light = -1;
  uint32_t primitive = 0;  // triangle of a mesh,
  Vec2 b{0, 0};            // and where in it: barycentric coordinates of its second and third corner
  bool infinite = false;   // no position: `normal` points toward the light
  bool has_area = false;   // an area light: cosines at y0 count
  bool hittable = false;   // eye subpaths can hit it
  Vec3 p;                  // not for infinite lights
  Vec3 normal;             // of an area light: geometric, toward its front
  float margin = 0;        // of an area light: see off_surface()
};

struct LightStart {
  LightPoint y0;
  Vec3 origin;                  // of the first ray: y0, or on the disk of an infinite light
  Vec3 direction;               // unit
  float density_position = 0;   // P_A(y0), choice of light included
  float density_direction = 0;  // P_sigma-perp(y0 -> y1)
  Rgb weight;                   // alpha_2 = L_e / (P_A P_sigma-perp)
};

struct DirectLight {
  LightPoint y0;
  Vec3 direction;      // unit, from the point lit to y0
  float distance = 0;  // infinite for infinite lights
  Rgb radiance;        // L_e(y0 -> x); for points, intensity; for a direction, irradiance
  float density = 0;   // P_A^d(y0), choice of light included; per solid angle for infinite lights
};

// What a kind keeps beyond the record.
struct LightData {
  virtual ~LightData() = default;
};

// In the order of the table in kinds.cpp.
enum class LightKindId : uint8_t {
  Mesh,
  TexturedMesh,
  Sphere,
  Point,
  Spot,
  Environment,
  EnvironmentMap,
  Directional,
  Sun,
  Projector,
  Photometric
};

// All that most questions need is in one cache line.
struct alignas(64) Light {
  const LightData* data = nullptr;  // of a mesh: that of all meshes
  LightKindId kind = LightKindId::Point;
  bool two_sided = false;
  uint8_t group = 0;
  uint32_t first = 0;  // of a mesh: in the triangles of all meshes
  uint32_t triangles = 0;
  uint32_t first_emitter = 0;
  float choice = 0;        // probability by power
  float inverse_area = 1;  // of an area light
  Rgb radiance;            // intensity of a point
  Vec3 center{0, 0, 0};    // of a sphere; a point's position; of infinite lights: the scene's
  float radius = 0;        // of a sphere; of infinite lights: the scene's
  float exponent = 0;      // of an area light: radiance goes with the cosine to this power
};
static_assert(sizeof(Light) == 64);

// Numbers in [0,1). u1, u2: position, v1, v2: direction. rest: what is left of the number that chose the light, of 48
// bits less those that the choice took. triangle: of all meshes.
struct PlaceNumbers {
  double rest;
  uint32_t triangle;
  float u1, u2;
};
struct StartNumbers : PlaceNumbers {
  float v1, v2;
  float way;  // chooses how the ray of an infinite light starts
};

// A kind of light: each is a file, and a line in kinds.h and kinds.cpp.
struct LightKind {
  bool has_area, infinite, hittable;  // of all its points
  bool is_mesh;                       // has triangles
  // What is emitted in all, by norm().
  double (*power)(const Light&);
  // A place and a direction of a light subpath: y0, origin and direction.
  void (*start)(const Light&, const StartNumbers&, LightStart&);
  // A point for direct lighting of x: y0.
  void (*place)(const Light&, const PlaceNumbers&, const Vec3& x, LightPoint& y0);
  // L_e(y0 -> x), w from y0 to x, of any length; of points, intensity; of a direction, irradiance.
  Rgb (*emitted)(const Light&, const LightPoint& y0, const Vec3& w);
  // P_A(y0), P_sigma-perp(y0 -> x) for w from y0 to x (unit), and P_A^d(y0) at x; of this light alone.
  float (*position_density)(const Light&, const LightPoint& y0);
  float (*direction_density)(const Light&, const LightPoint& y0, const Vec3& x, const Vec3& w);
  float (*direct_density)(const Light&, const LightPoint& y0, const Vec3& x);
  // P_A^d(y0) of the triangle of a mesh alone.
  float (*density_in_triangle)(const Light&, const LightPoint& y0);
  // What a tree of lights needs to know, of a mesh of this triangle; infinite lights are in no tree.
  Emitter (*bounds)(const Light&, uint32_t triangle);
};

extern const LightKind* const kLightKinds[];
inline const LightKind& kind_of(const Light& light) { return *kLightKinds[size_t(light.kind)]; }

}  // namespace bdpt
