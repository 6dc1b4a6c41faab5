// A pinhole, or a thin lens with a round or bladed aperture. The plane in focus may lean (Scheimpflug): at the film's
// point (a, b), on the plane at unit distance, its distance is F / (1 + p a + q b).
#include "sensor/kinds.h"

namespace bdpt {

namespace {

class Perspective final : public Camera {
 public:
  explicit Perspective(const CameraDesc& desc);

  bool is_hittable() const override { return desc_.lens_radius > 0; }
  EyeStart start(const FilmPosition& film, const float lens[2], const PixelRect& bounds) const override;
  bool sample_toward(const Vec3& x, const float lens[2], const PixelRect& bounds, SensorPoint& z0) const override;
  bool hit(const Vec3& origin, const Vec3& direction, float tmax, const PixelRect& bounds,
           SensorPoint& z0) const override;

 private:
  bool see(const Vec3& z0, const Vec3& to_world, const PixelRect& bounds, SensorPoint& point) const;
  // How much less of the film's plane a point of the lens sees in a solid angle, for the plane in focus leans.
  float stretch(const Vec2& on_lens) const { return 1 - dot2(tilt_, on_lens) / desc_.focus_distance; }
  static float dot2(const Vec2& a, const Vec2& b) { return a.x * b.x + a.y * b.y; }

  PictureFrame frame_;  // at unit distance
  Aperture aperture_;
  Vec2 tilt_{0, 0};      // p, q
  float lens_area_ = 1;  // 1 for a pinhole
};

Perspective::Perspective(const CameraDesc& desc)
    : Camera(desc),
      frame_(desc, 2 * std::tan(double(desc.field_of_view) * M_PI / 360)),
      aperture_{desc.aperture_blades, desc.aperture_rotation * (kPi / 180)} {
  if (!is_hittable()) return;
  lens_area_ = float(aperture_.area() * double(desc.lens_radius) * desc.lens_radius);
  for (int i = 0; i < 2; ++i) tilt_[i] = float(std::tan(double(desc.focus_tilt[i]) * M_PI / 180));
}

EyeStart Perspective::start(const FilmPosition& film, const float lens[2], const PixelRect& bounds) const {
  EyeStart s;
  s.film = film;
  s.normal = forward_;
  s.p = origin_;
  const Vec2 p = frame_.point(film);
  const Vec3 through = right_ * p.x + up_ * p.y + forward_;
  s.direction = through;
  s.density_direction = 1 / frame_.area(bounds);
  if (is_hittable()) {
    const Vec2 l = aperture_.sample(lens) * desc_.lens_radius;
    const Vec3 on_lens = right_ * l.x + up_ * l.y;
    s.p += on_lens;
    s.direction = through * desc_.focus_distance - on_lens * (1 + dot2(tilt_, p));
    s.density_direction /= stretch(l);
  }
  s.direction = unit(s.direction);
  s.cosine = dot(s.direction, forward_);
  s.density_position = 1 / lens_area_;
  s.density_direction /= sqr(sqr(s.cosine));
  s.weight = 1;
  return s;
}

// Fills in all but p: film position, W_e and densities for light that leaves z0 along to_world (any length).
bool Perspective::see(const Vec3& z0, const Vec3& to_world, const PixelRect& bounds, SensorPoint& point) const {
  const float depth = dot(to_world, forward_);
  if (!(depth > 0)) return false;
  Vec2 p = Vec2(dot(to_world, right_), dot(to_world, up_)) * (1 / depth);
  point.density_direction = 1 / frame_.area(bounds);
  if (is_hittable()) {
    const Vec2 on_lens(dot(z0 - origin_, right_), dot(z0 - origin_, up_));
    const float stretched = stretch(on_lens);
    p += on_lens * ((1 + dot2(tilt_, p)) / (stretched * desc_.focus_distance));
    point.density_direction /= stretched;
  }
  point.film = frame_.film(p);
  if (!is_within(point.film, bounds)) return false;
  const float cosine2 = depth * depth / length_squared(to_world);
  point.normal = forward_;
  point.density_position = 1 / lens_area_;
  point.density_direction /= cosine2 * cosine2;
  point.importance = point.density_position * point.density_direction;
  return true;
}

bool Perspective::sample_toward(const Vec3& x, const float lens[2], const PixelRect& bounds, SensorPoint& z0) const {
  z0.p = origin_;
  if (is_hittable()) {
    const Vec2 l = aperture_.sample(lens) * desc_.lens_radius;
    z0.p += right_ * l.x + up_ * l.y;
  }
  return see(z0.p, x - z0.p, bounds, z0);
}

bool Perspective::hit(const Vec3& origin, const Vec3& direction, float tmax, const PixelRect& bounds,
                      SensorPoint& z0) const {
  const float toward = dot(direction, forward_);
  if (!(toward < 0)) return false;
  const float t = dot(origin_ - origin, forward_) / toward;
  if (!(t > 0 && t < tmax)) return false;
  z0.p = origin + direction * t;
  const Vec3 offset = z0.p - origin_;
  if (!aperture_.contains(Vec2(dot(offset, right_), dot(offset, up_)) * (1 / desc_.lens_radius))) return false;
  return see(z0.p, -direction, bounds, z0);
}

}  // namespace

std::shared_ptr<const Camera> make_perspective(const CameraDesc& desc) {
  return std::make_shared<const Perspective>(desc);
}

}  // namespace bdpt
