// The perspective camera: a pinhole, or a thin lens with a round or bladed aperture.
#pragma once

#include "math/transform.h"
#include "sensor/sensor.h"

namespace bdpt {

struct CameraDesc {
  int width = 1, height = 1;
  int crop[4] = {0, 0, 1, 1};  // x0, y0, x1, y1
  Transform transform;         // camera to world, columns orthonormal; looks along -z
  float field_of_view = 45;    // vertical, degrees
  float lens_radius = 0;
  float focus_distance = 1;
  int aperture_blades = 0;
  float aperture_rotation = 0;  // degrees
  float shift[2] = {0, 0};
};

class Camera final : public Sensor {
 public:
  explicit Camera(const CameraDesc& desc);

  int width() const override { return desc_.crop[2] - desc_.crop[0]; }
  int height() const override { return desc_.crop[3] - desc_.crop[1]; }
  bool is_hittable() const override { return desc_.lens_radius > 0; }
  uint64_t hash() const override;

  EyeStart start(const FilmPosition& film, const float lens[2], const PixelRect& bounds) const override;
  bool sample_toward(const Vec3& x, const float lens[2], const PixelRect& bounds, SensorPoint& z0) const override;
  bool hit(const Vec3& origin, const Vec3& direction, float tmax, const PixelRect& bounds,
           SensorPoint& z0) const override;

 private:
  Vec2 sample_lens(const float u[2]) const;  // in units of lens_radius
  bool is_on_lens(const Vec2& p) const;      // the same
  bool see(const Vec3& z0, const Vec3& to_world, const PixelRect& bounds, SensorPoint& point) const;

  CameraDesc desc_;
  Vec3 origin_, right_, up_, forward_;
  float pixel_;       // side of a pixel on the plane at unit distance
  float left_, top_;  // of the crop region, on that plane
  float lens_area_;   // 1 for a pinhole
};

}  // namespace bdpt
