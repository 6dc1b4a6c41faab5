#include "sensor/camera.h"

#include "sampling/hash.h"
#include "sampling/warp.h"

namespace bdpt {

Camera::Camera(const CameraDesc& desc) : desc_(desc) {
  origin_ = desc.transform.column(3);
  right_ = unit(desc.transform.column(0));
  up_ = unit(desc.transform.column(1));
  forward_ = -unit(desc.transform.column(2));
  pixel_ = float(2 * std::tan(double(desc.field_of_view) * M_PI / 360) / desc.height);
  left_ = (-0.5f * float(desc.width) + desc.shift[0] * float(desc.width) + float(desc.crop[0])) * pixel_;
  top_ = (0.5f * float(desc.height) + desc.shift[1] * float(desc.height) - float(desc.crop[1])) * pixel_;
  lens_area_ = 1;
  if (is_hittable()) {
    const double r2 = double(desc.lens_radius) * desc.lens_radius;
    const int n = desc.aperture_blades;
    lens_area_ = float(n == 0 ? M_PI * r2 : 0.5 * n * std::sin(2 * M_PI / n) * r2);
  }
}

uint64_t Camera::hash() const {
  uint64_t h = hash_values(desc_.width, desc_.height, desc_.aperture_blades);
  h = hash_bytes(desc_.crop, sizeof(desc_.crop), h);
  h = hash_bytes(desc_.transform.m, sizeof(desc_.transform.m), h);
  const float numbers[] = {desc_.field_of_view,     desc_.lens_radius, is_hittable() ? desc_.focus_distance : 0,
                           desc_.aperture_rotation, desc_.shift[0],    desc_.shift[1]};
  return hash_bytes(numbers, sizeof(numbers), h);
}

Vec2 Camera::sample_lens(const float u[2]) const {
  const int n = desc_.aperture_blades;
  if (n == 0) return sample_disk(u[0], u[1]);
  // One of n triangles round the centre, then a point of it.
  const float scaled = u[0] * float(n);
  const int blade = std::min(int(scaled), n - 1);
  const Vec2 b = sample_triangle(scaled - float(blade), u[1]);
  const float a0 = kTwoPi * float(blade) / float(n) + desc_.aperture_rotation * (kPi / 180),
              a1 = a0 + kTwoPi / float(n);
  return Vec2(std::cos(a0), std::sin(a0)) * b.x + Vec2(std::cos(a1), std::sin(a1)) * b.y;
}

bool Camera::is_on_lens(const Vec2& p) const {
  const int n = desc_.aperture_blades;
  if (n == 0) return p.x * p.x + p.y * p.y <= 1;
  const float sector = kTwoPi / float(n);
  float angle = std::atan2(p.y, p.x) - desc_.aperture_rotation * (kPi / 180);
  angle -= sector * std::floor(angle / sector);
  return std::sqrt(p.x * p.x + p.y * p.y) * std::cos(angle - sector / 2) <= std::cos(sector / 2);
}

EyeStart Camera::start(const FilmPosition& film, const float lens[2], const PixelRect& bounds) const {
  EyeStart s;
  s.film = film;
  s.normal = forward_;
  s.p = origin_;
  const Vec3 through = right_ * (left_ + film.x * pixel_) + up_ * (top_ - film.y * pixel_) + forward_;
  s.direction = through;
  if (is_hittable()) {
    const Vec2 l = sample_lens(lens) * desc_.lens_radius;
    const Vec3 on_lens = right_ * l.x + up_ * l.y;
    s.p += on_lens;
    s.direction = through * desc_.focus_distance - on_lens;
  }
  s.direction = unit(s.direction);
  const float cosine = s.cosine = dot(s.direction, forward_);
  const float area = float(bounds.count()) * pixel_ * pixel_;
  s.density_position = 1 / lens_area_;
  s.density_direction = 1 / (area * sqr(sqr(cosine)));
  s.weight = 1;
  return s;
}

// Fills in all but p: film position, W_e and densities for light that leaves z0 along to_world (any length).
bool Camera::see(const Vec3& z0, const Vec3& to_world, const PixelRect& bounds, SensorPoint& point) const {
  const float depth = dot(to_world, forward_);
  if (!(depth > 0)) return false;
  Vec3 in_focus = to_world * (1 / depth);
  if (is_hittable()) in_focus += (z0 - origin_) * (1 / desc_.focus_distance);
  point.film = Vec2((dot(in_focus, right_) - left_) / pixel_, (top_ - dot(in_focus, up_)) / pixel_);
  if (!(point.film.x >= float(bounds.x0) && point.film.x < float(bounds.x1) && point.film.y >= float(bounds.y0) &&
        point.film.y < float(bounds.y1)))
    return false;
  const float cosine2 = depth * depth / length_squared(to_world);
  const float area = float(bounds.count()) * pixel_ * pixel_;
  point.normal = forward_;
  point.density_position = 1 / lens_area_;
  point.density_direction = 1 / (area * cosine2 * cosine2);
  point.importance = point.density_position * point.density_direction;
  return true;
}

bool Camera::sample_toward(const Vec3& x, const float lens[2], const PixelRect& bounds, SensorPoint& z0) const {
  z0.p = origin_;
  if (is_hittable()) {
    const Vec2 l = sample_lens(lens) * desc_.lens_radius;
    z0.p += right_ * l.x + up_ * l.y;
  }
  return see(z0.p, x - z0.p, bounds, z0);
}

bool Camera::hit(const Vec3& origin, const Vec3& direction, float tmax, const PixelRect& bounds,
                 SensorPoint& z0) const {
  const float toward = dot(direction, forward_);
  if (!(toward < 0)) return false;
  const float t = dot(origin_ - origin, forward_) / toward;
  if (!(t > 0 && t < tmax)) return false;
  z0.p = origin + direction * t;
  const Vec3 offset = z0.p - origin_;
  if (!is_on_lens(Vec2(dot(offset, right_), dot(offset, up_)) * (1 / desc_.lens_radius))) return false;
  return see(z0.p, -direction, bounds, z0);
}

}  // namespace bdpt
