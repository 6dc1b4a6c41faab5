#include "light/portal.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bdpt {

namespace {

// Of the samples, where any portal is seen.
constexpr double kShare = 0.5;
// What is seen under a smaller solid angle, or with a smaller cosine, counts as not seen: rounding would decide there.
constexpr double kLeastAngle = 1e-7, kLeastCosine = 1e-4;

float mixed(double own, int met, double all) { return float((1 - kShare) * own + kShare * met / all); }

// What portals have a share by: solid angles, or areas.
struct Parts {
  std::array<double, Portals::kMost> of;
  size_t count;
  double sum = 0;

  template <class Part>
  Parts(size_t n, const Part& part) : count(n) {
    for (size_t i = 0; i < n; ++i) sum += of[i] = part(i);
  }
  // The part in which a place lies, counted from the first; parts of nothing are never chosen.
  size_t choose(double left) const {
    size_t chosen = 0;
    for (size_t i = 0; i < count; ++i) {
      if (!(of[i] > 0)) continue;
      chosen = i;
      if (left < of[i]) break;
      left -= of[i];
    }
    return chosen;
  }
};

}  // namespace

// A rectangle as x sees it: its edges and its plane in its own frame. With X and Y the sines of the angles to the
// edges' planes, its corners are right angles plus or minus asin XY, which gives the solid angle; that of a part up to
// X is solved for X to sample it: Urena, Fajardo and King, An Area-Preserving Parametrization for Spherical Rectangles
// (2013).
struct Portals::View {
  double x0, x1, y0, y1, z;
  double X0, X1, Y0, Y1;
  double solid_angle = 0;  // 0 where it counts as not seen

  View(const Rectangle& r, const Vec3& x) {
    const Vec3d to_corner = r.corner - Vec3d(x);
    x0 = to_corner.dot(r.u), x1 = x0 + r.length_u;
    y0 = to_corner.dot(r.v), y1 = y0 + r.length_v;
    z = to_corner.dot(r.n);
    if (z == 0) return;
    X0 = sine(x0), X1 = sine(x1), Y0 = sine(y0), Y1 = sine(y1);
    const double angle = up_to(X1) - up_to(X0);
    if (angle > kLeastAngle) solid_angle = angle;
  }
  double sine(double a) const { return a / std::hypot(a, z); }
  double up_to(double X) const { return std::asin(X * Y1) - std::asin(X * Y0); }

  bool is_met_by(const Vec3d& w) const {  // in the frame
    const double t = z / w.z;
    return t > 0 && t * w.x >= x0 && t * w.x <= x1 && t * w.y >= y0 && t * w.y <= y1;
  }
  // In the frame, of any length.
  Vec3d sample(double u1, double u2) const {
    const double c = up_to(X0) + u1 * solid_angle, half = std::sin(c / 2);
    const double X = std::sin(c) / std::sqrt((Y1 - Y0) * (Y1 - Y0) + 4 * Y0 * Y1 * half * half);
    const double x = std::clamp(X * std::fabs(z) / std::sqrt(std::max(0.0, 1 - X * X)), x0, x1);
    const double d = std::hypot(x, z), low = y0 / std::hypot(y0, d), high = y1 / std::hypot(y1, d);
    const double Y = low + u2 * (high - low);
    return {x, std::clamp(Y * d / std::sqrt(std::max(0.0, 1 - Y * Y)), y0, y1), z};
  }
};

Portals::Portals(const std::vector<Portal>& portals) {
  for (const Portal& p : portals) {
    Rectangle r;
    r.corner = Vec3d(p.corner);
    const Vec3d u(p.edge_u), v(p.edge_v);
    r.length_u = u.length();
    r.u = u / r.length_u;
    const Vec3d across = v - r.u * v.dot(r.u);
    r.length_v = across.length();
    r.v = across / r.length_v;
    r.n = r.u.cross(r.v);
    rectangles_.push_back(r);
  }
}

double Portals::Rectangle::area_across(const Vec3d& w) const {
  const double cosine = std::fabs(w.dot(n));
  return cosine > kLeastCosine ? cosine * length_u * length_v : 0;
}

bool Portals::sample_direction(const Vec3& x, double& u, float u1, float u2, Vec3& w) const {
  if (empty()) return false;
  const Parts angles(rectangles_.size(), [&](size_t i) { return View(rectangles_[i], x).solid_angle; });
  if (!(angles.sum > 0)) return false;
  if (u >= kShare) {
    u = (u - kShare) / (1 - kShare);
    return false;
  }
  const Rectangle& r = rectangles_[angles.choose(u / kShare * angles.sum)];
  const Vec3d d = View(r, x).sample(double(u1), double(u2)).normalized();
  w = Vec3(r.u * d.x + r.v * d.y + r.n * d.z);
  return true;
}

float Portals::direction_density(const Vec3& x, const Vec3& w, float own) const {
  if (empty()) return own;
  double sum = 0;
  int met = 0;
  const Vec3d direction(w);
  for (const Rectangle& r : rectangles_) {
    const View view(r, x);
    if (!(view.solid_angle > 0)) continue;
    sum += view.solid_angle;
    met += view.is_met_by({direction.dot(r.u), direction.dot(r.v), direction.dot(r.n)});
  }
  return sum > 0 ? mixed(double(own), met, sum) : own;
}

bool Portals::sample_ray(const Vec3& w, double u, float u1, float u2, Vec3& p) const {
  if (u >= kShare) return false;
  const Vec3d along(w);
  const Parts areas(rectangles_.size(), [&](size_t i) { return rectangles_[i].area_across(along); });
  if (!(areas.sum > 0)) return false;
  const Rectangle& r = rectangles_[areas.choose(u / kShare * areas.sum)];
  p = Vec3(r.corner + r.u * (double(u1) * r.length_u) + r.v * (double(u2) * r.length_v));
  return true;
}

float Portals::ray_density(const Vec3& p, const Vec3& w, float own) const {
  if (empty()) return own;
  double sum = 0;
  int met = 0;
  const Vec3d along(w);
  for (const Rectangle& r : rectangles_) {
    const double area = r.area_across(along);
    if (!(area > 0)) continue;
    sum += area;
    const Vec3d to_corner = r.corner - Vec3d(p);
    const Vec3d at = along * (to_corner.dot(r.n) / along.dot(r.n)) - to_corner;
    const double a = at.dot(r.u), b = at.dot(r.v);
    met += a >= 0 && a <= r.length_u && b >= 0 && b <= r.length_v;
  }
  return sum > 0 ? mixed(double(own), met, sum) : own;
}

}  // namespace bdpt
