// Cameras. A kind is a file and a line in the table of camera.cpp.
#pragma once

#include "math/transform.h"
#include "sensor/lens_system.h"
#include "sensor/sensor.h"

#include <memory>

namespace bdpt {

enum class CameraType { Perspective, Orthographic, Equidistant, Equisolid, Equirectangular, Cube, Lens };

struct CameraDesc {
  int width = 1, height = 1;
  int crop[4] = {0, 0, 1, 1};  // x0, y0, x1, y1
  Transform transform;         // camera to world, columns orthonormal; looks along -z
  float field_of_view = 45;    // degrees: vertical, or of a fisheye's circle
  float lens_radius = 0;
  float focus_distance = 1;  // of a traced lens 0: the film stays where the last thickness says
  int aperture_blades = 0;
  float aperture_rotation = 0;  // degrees
  float shift[2] = {0, 0};
  CameraType type = CameraType::Perspective;
  float field_height = 1;         // orthographic
  float focus_tilt[2] = {0, 0};   // degrees: how far the right side and the top of the plane in focus come nearer
  std::vector<LensSurface> lens;  // from the scene to the film
  float film_height = 24;         // in the lens' unit
  float lens_unit = 0.001f;       // world units
  Transform end;                  // like transform, at time 1, of a camera that moves
  bool moves = false;
  std::vector<OutputPlanes> outputs{OutputPlanes{}};  // the picture first
};

// What all kinds share: the picture, and the camera's frame.
class Camera : public Sensor {
 public:
  explicit Camera(const CameraDesc& desc);

  int width() const override { return desc_.crop[2] - desc_.crop[0]; }
  int height() const override { return desc_.crop[3] - desc_.crop[1]; }
  uint64_t hash() const override;
  bool moves() const override { return desc_.moves; }
  Rigid motion(float time) const override { return motion_.at(time); }
  const std::vector<OutputPlanes>& outputs() const override { return desc_.outputs; }
  float depth(const Vec3& p) const override { return dot(p - origin_, forward_); }

 protected:
  // From coordinates to the right, upward and ahead to the world's.
  Vec3 to_world(const Vec3& v) const { return right_ * v.x + up_ * v.y + forward_ * v.z; }
  Vec3 from_world(const Vec3& v) const { return {dot(v, right_), dot(v, up_), dot(v, forward_)}; }

  CameraDesc desc_;
  Vec3 origin_, right_, up_, forward_;
  RigidMotion motion_;
};

// The frame of a picture on a plane: from pixels to lengths, to the right and upward of the axis.
class PictureFrame {
 public:
  PictureFrame(const CameraDesc& desc, double height);  // of the whole picture
  Vec2 point(const FilmPosition& film) const { return {left_ + film.x * pixel_, top_ - film.y * pixel_}; }
  FilmPosition film(const Vec2& p) const { return {(p.x - left_) / pixel_, (top_ - p.y) / pixel_}; }
  float area(const PixelRect& bounds) const { return float(bounds.count()) * pixel_ * pixel_; }
  // The largest distance from the axis of what is measured, and of so many pixels around.
  float reach(int margin) const;

 private:
  float pixel_;       // its side
  float left_, top_;  // of the crop region
  int width_, height_;
};

inline bool is_within(const FilmPosition& film, const PixelRect& bounds) {
  return film.x >= float(bounds.x0) && film.x < float(bounds.x1) && film.y >= float(bounds.y0) &&
         film.y < float(bounds.y1);
}

// Null for a lens through which no light comes to the middle of the picture.
std::shared_ptr<const Camera> make_camera(const CameraDesc& desc);

}  // namespace bdpt
