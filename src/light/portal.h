// Portals: rectangles through which light from infinitely far is said to come. They are hints: half of all samples keep
// the light's own density, the others go through a portal, and the densities told here are those of the mixture.
#pragma once

#include "light/light_desc.h"
#include "math/vec.h"

#include <vector>

namespace bdpt {

class Portals {
 public:
  static constexpr size_t kMost = 64;  // of one light

  Portals() = default;
  explicit Portals(const std::vector<Portal>& portals);
  bool empty() const { return rectangles_.empty(); }

  // --- Directions from a point x: evenly over the portals' solid angles ---

  // False where the light's own density is to be sampled. u chooses; what is left of it can be used again.
  bool sample_direction(const Vec3& x, double& u, float u1, float u2, Vec3& w) const;
  // Per solid angle of w (unit); own: by the light itself.
  float direction_density(const Vec3& x, const Vec3& w, float own) const;

  // --- Rays along w (unit): evenly over the portals' areas across it ---

  // False where the light's own density is to be sampled; p: where the ray meets the portal.
  bool sample_ray(const Vec3& w, double u, float u1, float u2, Vec3& p) const;
  // Per area across w of the ray through p; own: by the light itself.
  float ray_density(const Vec3& p, const Vec3& w, float own) const;

 private:
  using Vec3d = Imath::V3d;
  struct Rectangle {
    Vec3d corner, u, v, n;  // u, v: along its edges, unit; n across
    double length_u, length_v;
    double area_across(const Vec3d& w) const;  // 0 where it counts as not seen
  };
  struct View;

  std::vector<Rectangle> rectangles_;
};

}  // namespace bdpt
