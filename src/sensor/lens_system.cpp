#include "sensor/lens_system.h"

#include <cmath>

namespace bdpt {

double image_distance(const std::vector<LensSurface>& lens, double distance) {
  // Height and slope of a ray near the axis, on its way to the film.
  double height = std::isinf(distance) ? 1 : distance, slope = std::isinf(distance) ? 0 : 1, before = 1;
  for (size_t i = 0; i < lens.size(); ++i) {
    const LensSurface& s = lens[i];
    const auto behind = double(s.ior);
    if (s.radius != 0) slope = (before * slope - height * (behind - before) / double(s.radius)) / behind;
    if (s.radius == 0) slope = before * slope / behind;
    before = behind;
    if (i + 1 < lens.size()) height += slope * double(s.thickness);
  }
  return -height / slope;
}

LensSystem::LensSystem(const std::vector<LensSurface>& lens, double film_distance, const Aperture& stop) : stop_(stop) {
  double z = 0, before = 1;
  for (const LensSurface& s : lens) {
    const auto behind = double(s.ior);
    surfaces_.push_back({z, s.radius == 0 ? 0 : 1 / double(s.radius), before, behind, 0.5 * double(s.aperture),
                         s.radius == 0 && behind == before});
    before = behind;
    z -= double(s.thickness);
  }
  film_ = surfaces_.back().z - film_distance;
}

void LensSystem::narrow_front(double radius) {
  Surface& front = surfaces_.front();
  if (!front.is_stop) front.aperture = std::min(front.aperture, radius);
}

Vec3d LensSystem::normal(const Surface& s, const Vec3d& p) {
  return {p.x * s.curvature, p.y * s.curvature, 1 + (p.z - s.z) * s.curvature};
}

bool LensSystem::passes(const Surface& s, const Vec3d& p) const {
  if (!(p.x * p.x + p.y * p.y <= s.aperture * s.aperture)) return false;
  if (s.is_stop) return stop_.contains(Vec2(float(p.x / s.aperture), float(p.y / s.aperture)));
  return 1 + (p.z - s.z) * s.curvature > 0;  // the half with the vertex
}

// The surface is c (x^2 + y^2 + z^2) + 2 z = 0 from its vertex, c the curvature. Of the line's two points the one is
// taken where it goes from one side of the surface to the other in its own direction: whichever way the ray is
// followed, it is the same.
bool LensSystem::intersect(const Surface& s, const LensRay& ray, Side toward, Vec3d& p, double& t) const {
  const Vec3d o(ray.origin.x, ray.origin.y, ray.origin.z - s.z);
  const Vec3d& d = ray.direction;
  const double b = s.curvature * o.dot(d) + d.z, c = s.curvature * o.dot(o) + 2 * o.z;
  const double square = b * b - s.curvature * c;
  if (!(square > 0)) return false;
  const double root = toward == Side::Scene ? std::sqrt(square) : -std::sqrt(square);
  if (s.curvature == 0 && b * root < 0) return false;
  t = b * root > 0 ? -c / (b + root) : (root - b) / s.curvature;
  if (!(t > 0) && !s.is_stop) return false;  // a stop may lie within the sag of its neighbour
  p = ray.origin + d * t;
  return passes(s, p);
}

// Snell's law; n toward the side that the light comes from.
bool LensSystem::refract(Vec3d& d, const Vec3d& n, double ratio) {
  const double cosine = -d.dot(n), square = 1 - ratio * ratio * (1 - cosine * cosine);
  if (!(cosine > 0) || !(square > 0)) return false;
  d = (d * ratio + n * (ratio * cosine - std::sqrt(square))).normalized();
  return true;
}

bool LensSystem::leave(LensRay& ray) const {
  for (size_t i = surfaces_.size(); i-- > 0;) {
    const Surface& s = surfaces_[i];
    Vec3d p;
    double t;
    if (!intersect(s, ray, Side::Scene, p, t)) return false;
    ray.origin = p;
    if (s.before != s.behind && !refract(ray.direction, -normal(s, p), s.behind / s.before)) return false;
  }
  return true;
}

bool LensSystem::enter(LensRay& ray) const {
  for (const Surface& s : surfaces_) {
    Vec3d p = ray.origin;
    double t;
    if (&s == &surfaces_.front() ? !passes(s, p) || !(normal(s, p).dot(ray.direction) < 0)
                                 : !intersect(s, ray, Side::Film, p, t))
      return false;
    ray.origin = p;
    if (s.before != s.behind && !refract(ray.direction, normal(s, p), s.before / s.behind)) return false;
  }
  return ray.direction.z < 0;
}

bool LensSystem::meet(const LensRay& ray, Vec3d& p, double& t) const {
  return intersect(surfaces_.front(), ray, Side::Film, p, t) && t > 0;
}

Vec3d LensSystem::front_point(double x, double y) const {
  const double c = surfaces_.front().curvature, r2 = x * x + y * y;
  return {x, y, -c * r2 / (1 + std::sqrt(std::max(0.0, 1 - c * c * r2)))};
}

Vec3d LensSystem::front_normal(const Vec3d& p) const { return normal(surfaces_.front(), p); }

}  // namespace bdpt
