// A panorama of all directions: columns are longitudes, rows latitudes. The film's margin, which filters need, goes on
// round the other side and over the poles.
#include "sensor/pinhole.h"

namespace bdpt {

namespace {

class Equirectangular final : public Pinhole {
 public:
  explicit Equirectangular(const CameraDesc& desc)
      : Pinhole(desc),
        width_(float(desc.width)),
        height_(float(desc.height)),
        across_(2 * M_PI / desc.width),
        down_(M_PI / desc.height) {}

 private:
  bool look(const Vec2& p, Vec3& direction, float& solid_angle) const override {
    const double phi = across_ * (double(p.x) - 0.5 * desc_.width), theta = down_ * double(p.y);
    const double sine = std::sin(theta);
    direction = Vec3(float(sine * std::sin(phi)), float(std::cos(theta)), float(sine * std::cos(phi)));
    solid_angle = float(std::fabs(sine) * across_ * down_);
    return true;
  }

  bool find(const Vec3& d, Vec2& p, float& solid_angle) const override {
    const double sine = std::hypot(double(d.x), double(d.z));
    p = Vec2(float(std::atan2(double(d.x), double(d.z)) / across_ + 0.5 * desc_.width),
             float(std::atan2(sine, double(d.y)) / down_));
    solid_angle = float(sine * across_ * down_);
    return true;
  }

  int places(const Vec2& p, const PixelRect& bounds, float u, Vec2* chosen) const override {
    const Vec2 low = whole({float(bounds.x0), float(bounds.y0)}), high = whole({float(bounds.x1), float(bounds.y1)});
    int count = 0;
    // As it is, and over a pole; each again round the axis, and once more over both poles.
    for (int over = 0; over < 2; ++over) {
      const Vec2 first = over ? Vec2(p.x + width_ / 2, -p.y) : p;
      for (float y = beyond(first.y, low.y, 2 * height_); y < high.y; y += 2 * height_)
        for (float x = beyond(first.x, low.x, width_); x < high.x; x += width_) {
          ++count;
          if (!chosen) continue;
          // Each as likely: the n-th takes the place of the one before by 1/n.
          u *= float(count);
          if (u < 1)
            *chosen = {x, y};
          else
            u = (u - 1) / float(count - 1);
        }
    }
    return count;
  }

  // The first of v + n step, n an integer, that is not below `low`.
  static float beyond(float v, float low, float step) { return v + step * std::ceil((low - v) / step); }

  float width_, height_;
  double across_, down_;  // radians per pixel
};

}  // namespace

std::shared_ptr<const Camera> make_equirectangular(const CameraDesc& desc) {
  return std::make_shared<const Equirectangular>(desc);
}

}  // namespace bdpt
