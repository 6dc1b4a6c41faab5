// Fisheyes: the distance from the circle's centre is a function of the angle theta with the axis alone,
//   r = theta / theta_max            equidistant
//   r = sin(theta/2) / sin(theta_max/2)   equisolid
// in units of the circle's radius, and the solid angle of an area of the circle sin(theta) dtheta / (r dr).
#include "sensor/pinhole.h"

namespace bdpt {

namespace {

class Fisheye final : public Pinhole {
 public:
  explicit Fisheye(const CameraDesc& desc)
      : Pinhole(desc),
        equidistant_(desc.type == CameraType::Equidistant),
        largest_(desc.field_of_view * (kPi / 360)),
        sine_(std::sin(largest_ / 2)),
        radius_(0.5f * float(desc.height)),
        centre_(float(desc.width) * (0.5f - desc.shift[0]), float(desc.height) * (0.5f + desc.shift[1])) {}

 private:
  bool look(const Vec2& p, Vec3& direction, float& solid_angle) const override {
    const Vec2 v = (p - centre_) * (1 / radius_);
    const float r = std::sqrt(v.x * v.x + v.y * v.y);
    if (!(r <= 1)) return false;
    const float theta = equidistant_ ? r * largest_ : 2 * std::asin(std::min(1.0f, r * sine_));
    solid_angle = pixel(theta);
    const float sideways = r > 0 ? std::sin(theta) / r : 0;
    direction = Vec3(v.x * sideways, -v.y * sideways, std::cos(theta));
    return true;
  }

  bool find(const Vec3& d, Vec2& p, float& solid_angle) const override {
    const float sideways = std::sqrt(d.x * d.x + d.y * d.y), theta = std::atan2(sideways, d.z);
    if (!(theta <= largest_)) return false;
    const float r = equidistant_ ? theta / largest_ : std::sin(theta / 2) / sine_;
    solid_angle = pixel(theta);
    p = centre_;
    if (sideways > 0) p += Vec2(d.x, -d.y) * (r * radius_ / sideways);
    return true;
  }

  // Its solid angle.
  float pixel(float theta) const {
    if (!equidistant_) return sqr(2 * sine_ / radius_);
    return sqr(largest_ / radius_) * (theta > 0 ? std::max(0.0f, std::sin(theta)) / theta : 1);
  }

  bool equidistant_;
  float largest_, sine_;  // theta at the circle, and the sine of its half
  float radius_;          // in pixels
  Vec2 centre_;
};

}  // namespace

std::shared_ptr<const Camera> make_fisheye(const CameraDesc& desc) { return std::make_shared<const Fisheye>(desc); }

}  // namespace bdpt
