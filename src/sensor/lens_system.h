// A lens as a row of surfaces round an axis, and rays through it (Kolb, Mitchell and Hanrahan 1995). Lengths are in the
// lens' own unit. The axis is z, toward the scene; the first surface, the outermost, has its vertex at the origin.
#pragma once

#include "sensor/aperture.h"

#include <Imath/ImathVec.h>

#include <limits>
#include <vector>

namespace bdpt {

using Vec3d = Imath::V3d;

struct LensSurface {
  float radius = 0;     // of its curvature; positive where the centre is on the film's side; 0 = flat
  float thickness = 0;  // along the axis, to the next surface or the film
  float ior = 1;        // behind it
  float aperture = 0;   // diameter
};

// The distance from the last surface to the sharp image of a point on the axis, so far from the first, for rays near
// the axis; infinity is a distance. Not positive, or not finite, where there is none.
double image_distance(const std::vector<LensSurface>& lens, double distance);

struct LensRay {
  Vec3d origin, direction;  // unit
};

class LensSystem {
 public:
  LensSystem() = default;
  LensSystem(const std::vector<LensSurface>& lens, double film_distance, const Aperture& stop);

  double rear() const { return surfaces_.back().z; }  // of the last surface's vertex
  double rear_radius() const { return surfaces_.back().aperture; }
  double film() const { return film_; }                               // of the film's plane
  double front_radius() const { return surfaces_.front().aperture; }  // from here on radii, not diameters
  // Light beyond this distance from the axis is shut out at the first surface.
  void narrow_front(double radius);

  // From behind the last surface to the first; false where the ray is stopped.
  bool leave(LensRay& ray) const;
  // From a point of the first surface to the space before the film.
  bool enter(LensRay& ray) const;
  // Where a ray from outside meets the first surface, within its aperture; t is the distance.
  bool meet(const LensRay& ray, Vec3d& p, double& t) const;
  // The first surface's point at (x, y), and its unit normal toward the scene.
  Vec3d front_point(double x, double y) const;
  Vec3d front_normal(const Vec3d& p) const;

 private:
  struct Surface {
    double z, curvature;    // of the vertex; 1 / radius
    double before, behind;  // indices of refraction, on the side of the scene and of the film
    double aperture;        // radius
    bool is_stop;
  };
  enum class Side { Scene, Film };
  bool intersect(const Surface& surface, const LensRay& ray, Side toward, Vec3d& p, double& t) const;
  bool passes(const Surface& surface, const Vec3d& p) const;
  static Vec3d normal(const Surface& surface, const Vec3d& p);  // toward the scene; unit
  static bool refract(Vec3d& direction, const Vec3d& normal, double ratio);

  std::vector<Surface> surfaces_;
  double film_ = 0;
  Aperture stop_;
};

}  // namespace bdpt
