// A lens by its surfaces. z_0 lies on the first, the outermost. Eye subpaths choose a point of the film, then one of
// the part of the plane at the last surface through which light comes there (the exit pupil's bounds, for each distance
// from the axis). With both planes in air, and radiance's invariance (etendue) along a ray through refraction, the
// density of z_0 and its direction, per area and projected solid angle, is that of the two points (Veach 10.3.2,
// footnote)
//   p(film) p(pupil) r^2 / (cos cos')
// and needs no derivative. It is divided into the density with which t = 1 chooses z_0, evenly over the first surface
// as seen along the axis, and the rest, the density of the direction.
#include "sensor/kinds.h"

#include <limits>

namespace bdpt {

namespace {

constexpr int kIntervals = 64;            // of distances from the axis
constexpr int kCoarse = 32, kFine = 160;  // rays along a side that look for the pupil
constexpr int kSolidAngle = 256;          // and that measure it on the axis
constexpr int kMargin = 16;               // pixels around the picture, for filters

// A part of the plane at the last surface, for a point of the film at (r, 0).
struct Box {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double area() const { return (x1 - x0) * (y1 - y0); }
  bool contains(double x, double y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

class LensCamera final : public Camera {
 public:
  explicit LensCamera(const CameraDesc& desc);

  bool is_hittable() const override { return true; }
  bool is_dark() const { return !(solid_angle_ > 0); }
  EyeStart start(const FilmPosition& film, const float u[2], const PixelRect& bounds) const override;
  bool sample_toward(const Vec3& x, const float u[2], const PixelRect& bounds, SensorPoint& z0) const override;
  bool hit(const Vec3& origin, const Vec3& direction, float tmax, const PixelRect& bounds,
           SensorPoint& z0) const override;

 private:
  struct Densities {
    float importance, position, direction;
  };

  // The bounds of the light that comes to the film at (r, 0) through a part of the pupil's plane, by n x n rays.
  Box bounds_of_light(const LensSystem& lens, double r, const Box& part, int n, double& front) const;
  Box pupil(const LensSystem& lens, double r, double& front) const;
  const Box* pupil_at(double r) const;

  bool see(LensRay ray, const PixelRect& bounds, SensorPoint& z0) const;
  Densities densities(const Vec3d& film, const Vec3d& pupil, const Box& box, const Vec3d& z0,
                      const PixelRect& bounds) const;
  Vec3d local(const Vec3& v) const {  // of a vector, in the lens' unit
    const Vec3 w = from_world(v);
    return Vec3d(double(w.x), double(w.y), double(w.z)) / unit_;
  }
  Vec3 world(const Vec3d& v) const { return to_world(Vec3(float(v.x), float(v.y), float(v.z))); }

  double unit_;         // world units in one of the lens
  PictureFrame frame_;  // on the film, upright
  LensSystem lens_;
  std::vector<Box> pupils_;
  double interval_;         // of distances from the axis, one for each of pupils_
  double solid_angle_ = 0;  // projected, of the pupil, from the film's middle
};

double film_distance(const CameraDesc& desc) {
  if (desc.focus_distance == 0) return double(desc.lens.back().thickness);
  return image_distance(desc.lens, double(desc.focus_distance) / double(desc.lens_unit));
}

LensCamera::LensCamera(const CameraDesc& desc)
    : Camera(desc),
      unit_(double(desc.lens_unit)),
      frame_(desc, double(desc.film_height)),
      lens_(desc.lens, film_distance(desc), {desc.aperture_blades, desc.aperture_rotation * (kPi / 180)}),
      interval_(double(frame_.reach(kMargin)) / kIntervals) {
  const LensSystem round(desc.lens, film_distance(desc), {});  // whichever way the blades are turned
  double front = 0;
  std::vector<Box> at;
  for (int i = 0; i <= kIntervals; ++i) at.push_back(pupil(round, i * interval_, front));
  for (size_t i = 0; i < kIntervals; ++i) {
    const Box &a = at[i], &b = at[i + 1];
    if (a.area() > 0 && b.area() > 0)
      pupils_.push_back({std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)});
    else
      pupils_.push_back(a.area() > 0 ? a : b);
  }
  lens_.narrow_front(front * (1 + 2.0 / kCoarse));

  const Box& box = pupils_.front();
  const double z = lens_.rear() - lens_.film(), cell = box.area() / (kSolidAngle * kSolidAngle);
  for (int j = 0; j < kSolidAngle; ++j)
    for (int i = 0; i < kSolidAngle; ++i) {
      const Vec3d film(0, 0, lens_.film()), p(box.x0 + (box.x1 - box.x0) * (i + 0.5) / kSolidAngle,
                                              box.y0 + (box.y1 - box.y0) * (j + 0.5) / kSolidAngle, lens_.rear());
      LensRay ray{film, (p - film).normalized()};
      if (lens_.leave(ray)) solid_angle_ += cell * z * z / ((p - film).length2() * (p - film).length2());
    }
}

Box LensCamera::bounds_of_light(const LensSystem& lens, double r, const Box& part, int n, double& front) const {
  const double infinity = std::numeric_limits<double>::infinity();
  Box box{infinity, infinity, -infinity, -infinity};
  const double dx = (part.x1 - part.x0) / n, dy = (part.y1 - part.y0) / n;
  const Vec3d film(r, 0, lens.film());
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Vec3d p(part.x0 + dx * (i + 0.5), part.y0 + dy * (j + 0.5), lens.rear());
      LensRay ray{film, (p - film).normalized()};
      if (!lens.leave(ray)) continue;
      front = std::max(front, std::hypot(ray.origin.x, ray.origin.y));
      box.x0 = std::min(box.x0, p.x - dx), box.x1 = std::max(box.x1, p.x + dx);
      box.y0 = std::min(box.y0, p.y - dy), box.y1 = std::max(box.y1, p.y + dy);
    }
  return box.x0 < box.x1 ? box : Box{};
}

Box LensCamera::pupil(const LensSystem& lens, double r, double& front) const {
  const double side = 1.5 * lens.rear_radius();  // the last surface may be curved, and lie before its vertex's plane
  const Box all{-side, -side, side, side};
  double unused = 0;
  Box box = bounds_of_light(lens, r, all, kCoarse, unused);
  if (!(box.area() > 0)) box = bounds_of_light(lens, r, all, kFine, unused);
  return box.area() > 0 ? bounds_of_light(lens, r, box, kCoarse, front) : box;
}

const Box* LensCamera::pupil_at(double r) const {
  const double i = r / interval_;
  if (!(i < kIntervals)) return nullptr;
  const Box& box = pupils_[size_t(i)];
  return box.area() > 0 ? &box : nullptr;
}

// Per world units of area.
LensCamera::Densities LensCamera::densities(const Vec3d& film, const Vec3d& pupil, const Box& box, const Vec3d& z0,
                                            const PixelRect& bounds) const {
  const double scale = 1 / (unit_ * unit_), film_density = scale / double(frame_.area(bounds));
  const double z = pupil.z - film.z, d2 = (pupil - film).length2();
  const double position = scale * lens_.front_normal(z0).z / (M_PI * lens_.front_radius() * lens_.front_radius());
  const double joint = film_density / box.area() * (d2 * d2 / (z * z));
  return {float(film_density / solid_angle_), float(position), float(joint / position)};
}

EyeStart LensCamera::start(const FilmPosition& film, const float u[2], const PixelRect& bounds) const {
  EyeStart s;
  s.film = film;
  s.p = origin_;
  s.weight = 0;
  const Vec2 upright = frame_.point(film);
  const Vec3d f(-double(upright.x), -double(upright.y), lens_.film());
  const double r = std::hypot(f.x, f.y);
  const Box* box = pupil_at(r);
  if (!box) return s;
  const double cosine = r > 0 ? f.x / r : 1, sine = r > 0 ? f.y / r : 0;
  const double x = box->x0 + (box->x1 - box->x0) * double(u[0]), y = box->y0 + (box->y1 - box->y0) * double(u[1]);
  const Vec3d p(cosine * x - sine * y, sine * x + cosine * y, lens_.rear());
  LensRay ray{f, (p - f).normalized()};
  if (!lens_.leave(ray)) return s;
  const Densities d = densities(f, p, *box, ray.origin, bounds);
  s.p += world(ray.origin * unit_);
  s.normal = world(lens_.front_normal(ray.origin));
  s.direction = unit(world(ray.direction));
  s.cosine = dot(s.direction, s.normal);
  s.density_position = d.position;
  s.density_direction = d.direction;
  s.weight = d.importance / (d.position * d.direction);
  return s;
}

// From a point of the first surface to the film.
bool LensCamera::see(LensRay ray, const PixelRect& bounds, SensorPoint& point) const {
  const Vec3d z0 = ray.origin;
  if (!lens_.enter(ray)) return false;
  const auto at = [&](double z) { return ray.origin + ray.direction * ((z - ray.origin.z) / ray.direction.z); };
  const Vec3d f = at(lens_.film()), p = at(lens_.rear());
  point.film = frame_.film({float(-f.x), float(-f.y)});
  if (!is_within(point.film, bounds)) return false;
  const double r = std::hypot(f.x, f.y), cosine = r > 0 ? f.x / r : 1, sine = r > 0 ? f.y / r : 0;
  const Box* box = pupil_at(r);
  if (!box || !box->contains(cosine * p.x + sine * p.y, cosine * p.y - sine * p.x)) return false;
  const Densities d = densities(f, p, *box, z0, bounds);
  point.p = origin_ + world(z0 * unit_);
  point.normal = world(lens_.front_normal(z0));
  point.importance = d.importance;
  point.density_position = d.position;
  point.density_direction = d.direction;
  return true;
}

bool LensCamera::sample_toward(const Vec3& x, const float u[2], const PixelRect& bounds, SensorPoint& z0) const {
  const Vec2 disk = sample_disk(u[0], u[1]);
  const Vec3d p = lens_.front_point(double(disk.x) * lens_.front_radius(), double(disk.y) * lens_.front_radius());
  const Vec3d v = p - local(x - origin_);
  if (!(v.length2() > 0)) return false;
  return see({p, v.normalized()}, bounds, z0);
}

bool LensCamera::hit(const Vec3& origin, const Vec3& direction, float tmax, const PixelRect& bounds,
                     SensorPoint& z0) const {
  LensRay ray{local(origin - origin_), local(direction).normalized()};
  Vec3d p;
  double t;
  if (!lens_.meet(ray, p, t) || !(t * unit_ < double(tmax))) return false;
  ray.origin = p;
  return see(ray, bounds, z0);
}

}  // namespace

std::shared_ptr<const Camera> make_lens_camera(const CameraDesc& desc) {
  auto camera = std::make_shared<const LensCamera>(desc);
  return camera->is_dark() ? nullptr : camera;
}

}  // namespace bdpt
