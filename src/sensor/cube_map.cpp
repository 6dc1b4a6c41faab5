// A panorama of all directions on the six faces of a cube, in a row or a column, as OpenGL has them (specification of
// 4.6, table 8.19): from the vector (x, y, z) in the camera's frame, z backward, to coordinates s, t of a face.
#include "sensor/pinhole.h"

namespace bdpt {

namespace {

class CubeMap final : public Pinhole {
 public:
  explicit CubeMap(const CameraDesc& desc)
      : Pinhole(desc), column_(desc.height > desc.width), side_(float(std::min(desc.width, desc.height))) {}

  bool has_seams() const override { return true; }

 private:
  bool look(const Vec2& p, Vec3& direction, float& solid_angle) const override {
    const float along = column_ ? p.y : p.x, across = column_ ? p.x : p.y;
    if (!(along >= 0 && along < 6 * side_ && across >= 0 && across < side_)) return false;
    const int face = std::min(5, int(along / side_));
    const float on_face = along - float(face) * side_;
    const float s = 2 * (column_ ? across : on_face) / side_ - 1, t = 2 * (column_ ? on_face : across) / side_ - 1;
    const int axis = face / 2;
    const float sign = face % 2 == 0 ? 1.0f : -1.0f;
    Vec3 v(0);
    if (axis == 0) v = Vec3(sign, -t, -sign * s);
    if (axis == 1) v = Vec3(s, sign, sign * t);
    if (axis == 2) v = Vec3(sign * s, -t, sign);
    direction = unit(Vec3(v.x, v.y, -v.z));
    solid_angle = pixel(direction[axis]);
    return true;
  }

  bool find(const Vec3& d, Vec2& p, float& solid_angle) const override {
    const Vec3 v(d.x, d.y, -d.z), size(std::fabs(v.x), std::fabs(v.y), std::fabs(v.z));
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const float sign = v[axis] > 0 ? 1.0f : -1.0f, scale = 1 / size[axis];
    float s = 0, t = 0;
    if (axis == 0) s = -sign * v.z, t = -v.y;
    if (axis == 1) s = v.x, t = sign * v.z;
    if (axis == 2) s = sign * v.x, t = -v.y;
    // Not onto the next face by rounding.
    const auto place = [&](float c) { return std::min((c * scale + 1) * 0.5f * side_, side_ * 0x1.fffffep-1f); };
    const float first = float(2 * axis + (sign > 0 ? 0 : 1)) * side_;
    p = column_ ? Vec2(place(s), first + place(t)) : Vec2(first + place(s), place(t));
    solid_angle = pixel(d[axis]);
    return true;
  }

  // Its solid angle, by the cosine with its face's axis.
  float pixel(float cosine) const { return sqr(2 / side_) * std::fabs(cosine * cosine * cosine); }

  bool column_;
  float side_;  // of a face, in pixels
};

}  // namespace

std::shared_ptr<const Camera> make_cube_map(const CameraDesc& desc) { return std::make_shared<const CubeMap>(desc); }

}  // namespace bdpt
