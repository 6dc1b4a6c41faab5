// Parallel rays from a plane. W_e^(0) is uniform on the plane, W_e^(1) a Dirac: t = 1 has one z_0 to choose, and there
// is no t = 0. The Dirac is in p_t of all t >= 1 and cancels; what remains is a density per area across the rays, alike
// at z_0 and z_1. Toward a point it is given per projected solid angle, so that with G it is that density.
#include "sensor/kinds.h"

namespace bdpt {

namespace {

class Orthographic final : public Camera {
 public:
  explicit Orthographic(const CameraDesc& desc) : Camera(desc), frame_(desc, double(desc.field_height)) {}

  bool is_hittable() const override { return false; }

  EyeStart start(const FilmPosition& film, const float[2], const PixelRect& bounds) const override {
    EyeStart s;
    const Vec2 p = frame_.point(film);
    s.film = film;
    s.p = origin_ + right_ * p.x + up_ * p.y;
    s.normal = s.direction = forward_;
    s.cosine = 1;
    s.density_position = 1;
    s.density_direction = 1 / frame_.area(bounds);
    s.parallel = true;
    s.weight = 1;
    return s;
  }

  bool sample_toward(const Vec3& x, const float[2], const PixelRect& bounds, SensorPoint& z0) const override {
    const Vec3 v = from_world(x - origin_);
    if (!(v.z > 0)) return false;
    z0.film = frame_.film({v.x, v.y});
    if (!is_within(z0.film, bounds)) return false;
    z0.p = x - forward_ * v.z;
    z0.normal = forward_;
    z0.density_position = 1;
    // Not by v.z: far from the origin z0 is rounded, and G is its.
    const Vec3 edge = z0.p - x;
    z0.density_direction = z0.importance = length_squared(edge) / frame_.area(bounds);
    return true;
  }

 private:
  PictureFrame frame_;  // in world units
};

}  // namespace

std::shared_ptr<const Camera> make_orthographic(const CameraDesc& desc) {
  return std::make_shared<const Orthographic>(desc);
}

}  // namespace bdpt
