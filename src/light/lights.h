// All lights of a scene: how light subpaths start, points on lights for direct lighting (s = 1), and the densities of
// both. light.h has the conventions; direct_lighting.h chooses among lights.
#pragma once

#include "geometry/texture.h"
#include "light/light.h"
#include "light/mesh.h"
#include "sampling/discrete.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace bdpt {

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
    float exponent = 0;  // see Light
    bool two_sided = false;
    bool is_sphere = false;
    Vec3 center{0, 0, 0};  // sphere
    float radius = 0;
    float area = 0;
    std::vector<LightTriangle> triangles;
    std::shared_ptr<const Texture> texture;  // times radiance; looked up by
    TextureSampler sampler;
    std::vector<std::array<Vec2, 3>> uv;  // these, of each triangle's corners
  };

  // Area lights first, in the order given, then the rest. The scene lies within the sphere given.
  void build(const std::vector<AreaLight>& areas, const std::vector<LightDesc>& others, const Vec3& center,
             float radius);

  size_t count() const { return lights_.size(); }
  bool empty() const { return by_power_.empty(); }
  bool any_hittable() const { return any_hittable_; }
  bool all_hittable() const { return all_hittable_; }
  uint32_t group(int light) const { return at(light).group; }
  double power(int light) const { return kind_of(at(light)).power(at(light)); }
  // What the tables of pictures among these will take.
  static uint64_t table_bytes(const std::vector<LightDesc>& lights);

  // Starts a light subpath. u: choice, position 2, more of the choice; v: direction 2, and how rays of infinite lights
  // start. False for a scene without light.
  bool start(const float u[4], const float v[3], const LightChoice& by, LightStart& start) const;
  // The light that u chooses, and its probability; what is left of u can be used again.
  int choose(double& u, const LightChoice& by) const;
  float choice(int light, const LightChoice& by) const;
  // The triangle of a mesh that u chooses; for all other lights some number.
  uint32_t choose_triangle(int light, double& u) const { return meshes_.choose(at(light), u); }
  // A point of a light, or of one triangle of it, for s = 1 at a point x of a surface: all but the density. False where
  // the light cannot reach x.
  bool place_direct(int light, const PlaceNumbers& u, const Vec3& x, DirectLight& direct) const;

  // L_e(y0 -> x), w from y0 to x, of any length; of points, the intensity. Black from the dark side of an area light.
  Rgb emitted(const LightPoint& y0, const Vec3& w) const { return kind(y0).emitted(at(y0.light), y0, w); }
  // P_sigma-perp(y0 -> x) for w from y0 to x (unit).
  float direction_density(const LightPoint& y0, const Vec3& x, const Vec3& w) const {
    return kind(y0).direction_density(at(y0.light), y0, x, w);
  }
  // How far p is from the disk on which rays of infinite lights along -w (unit) start; not above 0 where none passes p.
  float disk_distance(const Vec3& p, const Vec3& w) const;
  // P_A(y0).
  float position_density(const LightPoint& y0, const LightChoice& by) const {
    return choice(y0.light, by) * kind(y0).position_density(at(y0.light), y0);
  }
  // P_A^d(y0) at x of a light that is chosen with this probability.
  float direct_density(const LightPoint& y0, const Vec3& x, float chosen) const {
    return chosen * kind(y0).direct_density(at(y0.light), y0, x);
  }
  // The same of one triangle of a mesh that is chosen with it.
  float direct_density_of_triangle(const LightPoint& y0, float chosen) const {
    return chosen * kind(y0).density_in_triangle(at(y0.light), y0);
  }

  // --- Infinite lights: no emitters ---
  const std::vector<int>& infinite() const { return infinite_; }
  // Those that an eye subpath meets that meets nothing else.
  const std::vector<int>& hittable_infinite() const { return hittable_infinite_; }

  // --- Emitters: each triangle of a mesh, and each other light that is not infinite; numbered in the order of lights
  // ---
  bool is_mesh(int light) const { return kind_of(at(light)).is_mesh; }
  uint32_t first_emitter(int light) const { return at(light).first_emitter; }
  std::vector<Emitter> emitters() const;

 private:
  const Light& at(int light) const { return lights_[size_t(light)]; }
  const LightKind& kind(const LightPoint& y0) const { return kind_of(at(y0.light)); }
  void add(const Light& light);
  void add_mesh(const AreaLight& area, Light& light);
  LightPoint point_of(int light) const;

  std::vector<Light> lights_;
  LightMeshes meshes_;
  std::vector<std::unique_ptr<LightData>> data_;
  std::vector<int> infinite_, hittable_infinite_;
  Discrete by_power_;
  Vec3 center_;
  float radius_ = 0;
  bool any_hittable_ = false, all_hittable_ = true;
};

}  // namespace bdpt
