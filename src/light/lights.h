// All lights of a scene: how light subpaths start, points on lights for direct lighting (s = 1), and the densities of
// both. direct_lighting.h chooses among them.
//
// Veach's convention: L_e is split into L_e^(0), a position, and L_e^(1), a direction, and the directional part is
// treated as a BSDF at y0. Densities of position are per area, those of direction per projected solid angle. An
// infinitely far light has no area: its y0 is a direction, its density of "position" is per solid angle, its density
// of "direction" per area of the disk from which its rays start, and the geometry factor of its edge is the cosine at
// the other end alone; with that every formula stays as it is.
#pragma once

#include "light/light_desc.h"
#include "light/light_tree.h"
#include "math/vec.h"
#include "sampling/discrete.h"

#include <cstdint>
#include <vector>

namespace bdpt {

// y0 of a light subpath or of direct lighting. The tag says which light and which side of it.
struct LightPoint {
  int light = -1;
  uint32_t primitive = 0;  // triangle of a mesh
  bool infinite = false;   // no position: `normal` points toward the light
  bool has_area = false;   // an area light: cosines at y0 count, eye subpaths can hit it
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
  Rgb radiance;        // L_e(y0 -> x); for points, intensity
  float density = 0;   // P_A^d(y0), choice of light included; per solid angle for infinite lights
};

// One triangle of an area light, in the world. All that choosing a point needs is in one cache line.
struct alignas(64) LightTriangle {
  Vec3 corner, edge1, edge2;
  Vec3 normal;       // unit, toward the front; zero where the triangle is degenerate
  double below = 0;  // part of its mesh's area that lies before it
  float margin;
  double area() const { return length_squared(normal) > 0 ? 0.5 * double(length(cross(edge1, edge2))) : 0; }
  LightTriangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& n, float m)
      : corner(a), edge1(b - a), edge2(c - a), normal(n), margin(m) {}
};

// How a light is chosen: by emitted power, each alike, or by a table of their probabilities.
struct LightChoice {
  bool uniform = false;
  const Discrete* table = nullptr;  // in place of both
};

class Lights {
 public:
  struct AreaLight {
    int instance = -1;
    Rgb radiance;
    uint32_t group = 0;  // see LightDesc
    bool two_sided = false;
    bool is_sphere = false;
    Vec3 center{0, 0, 0};  // sphere
    float radius = 0;
    float area = 0;
    std::vector<LightTriangle> triangles;
  };

  // Area lights first, in the order given, then the rest. The scene lies within the sphere given.
  void build(const std::vector<AreaLight>& areas, const std::vector<LightDesc>& others, const Vec3& center,
             float radius);

  size_t count() const { return lights_.size(); }
  bool empty() const { return by_power_.empty(); }
  bool any_hittable() const { return any_hittable_; }
  bool all_hittable() const { return all_hittable_; }
  uint32_t group(int light) const { return at(light).group; }
  bool has_environment() const { return environment_ >= 0; }
  int environment() const { return environment_; }

  // Starts a light subpath. u: choice, position 2, more of the choice; v: direction 2. False for a scene without light.
  bool start(const float u[4], const float v[2], const LightChoice& by, LightStart& start) const;
  // The light that u chooses, and its probability; what is left of u can be used again.
  int choose(double& u, const LightChoice& by) const;
  float choice(int light, const LightChoice& by) const;
  // The triangle of a mesh that u chooses, by area, numbered over all meshes; for all other lights some number. (It is
  // not counted from the mesh's first, so that it can be fetched before the light is.)
  uint32_t choose_triangle(int light, double& u) const;
  // A point of a light, or of one triangle of it, for s = 1 at a point x of a surface: all but the density. False where
  // the light cannot reach x.
  bool place_direct(int light, uint32_t triangle, const Vec3& x, float u1, float u2, DirectLight& direct) const;

  // L_e(y0 -> x) of any finite light, w from y0 to x, of any length; of points, the intensity.
  Rgb emitted(const LightPoint& y0, const Vec3& w) const;
  // The same of an area light with the normal of its front; black from its dark side.
  Rgb radiance(int light, const Vec3& normal, const Vec3& w) const;
  // L_e of the environment.
  Rgb environment_radiance() const { return environment_radiance_; }
  // P_sigma-perp(y0 -> x) for w from y0 to x (unit).
  float direction_density(const LightPoint& y0, const Vec3& w) const;
  // How far p is from the disk on which the environment's rays along -w (unit) start; not above 0 where none passes p.
  float disk_distance(const Vec3& p, const Vec3& w) const;
  // P_A(y0).
  float position_density(const LightPoint& y0, const LightChoice& by) const;
  // P_A^d(y0) at x of a light that is chosen with this probability.
  float direct_density(const LightPoint& y0, const Vec3& x, float chosen) const;
  // The same of one triangle of a mesh that is chosen with it.
  float direct_density_of_triangle(const LightPoint& y0, float chosen) const;

  // --- Emitters: each triangle of a mesh, and each other light but an environment; numbered in the order of lights ---
  bool is_mesh(int light) const { return at(light).kind == Kind::Triangles; }
  uint32_t first_emitter(int light) const { return at(light).first_emitter; }
  uint32_t emitter_count(int light) const;
  std::vector<Emitter> emitters() const;

 private:
  enum class Kind : uint8_t { Triangles, Sphere, Point, Spot, Environment };
  // All that most questions need is in one cache line.
  struct alignas(64) Light {
    Kind kind = Kind::Point;
    bool two_sided = false;
    uint8_t group = 0;
    uint32_t first = 0;  // of a mesh's triangles in triangles_; index of a light without area in others_
    uint32_t triangles = 0;
    uint32_t first_emitter = 0;
    float choice = 0;        // probability by power
    float inverse_area = 1;  // of an area light
    Rgb radiance;            // of an area light
    Vec3 center{0, 0, 0};    // sphere
    float radius = 0;
  };
  const Light& at(int light) const { return lights_[size_t(light)]; }
  const LightDesc& other(const Light& light) const { return others_[light.first]; }
  void add_area(const AreaLight& area);
  void place_on_triangle(const Light& light, uint32_t triangle, float u1, float u2, LightPoint& y0) const;
  Emitter emitter_of(const Light& light) const;
  float spot_falloff(const LightDesc& spot, const Vec3& w) const;

  std::vector<Light> lights_;
  std::vector<LightTriangle> triangles_;  // of all meshes
  std::vector<uint32_t> guide_;           // where in a mesh to look for part k / n of its area; for each triangle k
  std::vector<LightDesc> others_;
  Discrete by_power_;
  Vec3 center_;
  float radius_ = 0;
  bool any_hittable_ = false, all_hittable_ = true;
  int environment_ = -1;
  Rgb environment_radiance_;
};

}  // namespace bdpt
