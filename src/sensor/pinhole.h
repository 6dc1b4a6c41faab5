// Pinholes by their maps between film and directions: W_e^(1) is one over the solid angle of the film. They look all
// around, so that z_0 has no side: its normal is the direction in hand.
#pragma once

#include "sensor/kinds.h"

namespace bdpt {

class Pinhole : public Camera {
 public:
  using Camera::Camera;
  bool is_hittable() const final { return false; }

  float depth(const Vec3& p) const override { return length(p - origin_); }
  EyeStart start(const FilmPosition& film, const float[2], const PixelRect& bounds) const final {
    EyeStart s;
    s.film = film;
    s.p = origin_;
    s.weight = 0;
    Vec3 local;
    float solid_angle;
    if (!look(whole(film), local, solid_angle) || !(solid_angle > 0)) return s;
    s.direction = s.normal = unit(to_world(local));
    s.cosine = 1;
    const auto count = float(std::max(1, places(whole(film), bounds, 0, nullptr)));
    s.density_position = 1 / count;
    s.density_direction = count / (float(bounds.count()) * solid_angle);
    s.weight = 1;
    return s;
  }

  bool sample_toward(const Vec3& x, const float u[2], const PixelRect& bounds, SensorPoint& z0) const final {
    const Vec3 v = x - origin_;
    const float d2 = length_squared(v);
    if (!(d2 > 0)) return false;
    const Vec3 direction = v * (1 / std::sqrt(d2));
    Vec2 first, p;
    float solid_angle;
    if (!find(from_world(direction), first, solid_angle) || !(solid_angle > 0)) return false;
    const int count = places(first, bounds, u[0], &p);
    z0.film = p - corner();
    if (count == 0 || !is_within(z0.film, bounds)) return false;
    z0.p = origin_;
    z0.normal = direction;
    z0.density_position = 1 / float(count);
    z0.density_direction = float(count) / (float(bounds.count()) * solid_angle);
    z0.importance = z0.density_position * z0.density_direction;
    return true;
  }

 protected:
  // In pixels of the whole picture; directions to the right, upward and ahead. False where nothing is seen.
  virtual bool look(const Vec2& p, Vec3& direction, float& solid_angle) const = 0;  // of a pixel
  virtual bool find(const Vec3& direction, Vec2& p, float& solid_angle) const = 0;
  // How many places of the film look in the same direction as p, and one of them, chosen by u: the choice is part of
  // z_0's. Beyond its borders a panorama goes on.
  virtual int places(const Vec2& p, const PixelRect&, float, Vec2* chosen) const {
    if (chosen) *chosen = p;
    return 1;
  }

  Vec2 corner() const { return {float(desc_.crop[0]), float(desc_.crop[1])}; }
  Vec2 whole(const FilmPosition& film) const { return film + corner(); }
};

}  // namespace bdpt
