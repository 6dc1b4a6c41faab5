#include "sensor/camera.h"

#include "sampling/hash.h"
#include "sensor/kinds.h"

#include <iterator>

namespace bdpt {

namespace {

constexpr MakeFunction* kKinds[] = {make_perspective,     make_orthographic, make_fisheye,    make_fisheye,
                                    make_equirectangular, make_cube_map,     make_lens_camera};
static_assert(std::size(kKinds) == static_cast<size_t>(CameraType::Lens) + 1);

}  // namespace

std::shared_ptr<const Camera> make_camera(const CameraDesc& desc) { return kKinds[static_cast<int>(desc.type)](desc); }

Camera::Camera(const CameraDesc& desc) : desc_(desc), motion_(desc.transform, desc.moves ? desc.end : desc.transform) {
  origin_ = desc.transform.column(3);
  right_ = unit(desc.transform.column(0));
  up_ = unit(desc.transform.column(1));
  forward_ = -unit(desc.transform.column(2));
}

uint64_t Camera::hash() const {
  uint64_t h = hash_values(static_cast<int>(desc_.type), desc_.width, desc_.height, desc_.aperture_blades);
  h = hash_bytes(desc_.crop, sizeof(desc_.crop), h);
  h = hash_bytes(desc_.transform.m, sizeof(desc_.transform.m), h);
  const float numbers[] = {desc_.field_of_view,     desc_.lens_radius,   is_hittable() ? desc_.focus_distance : 0,
                           desc_.aperture_rotation, desc_.shift[0],      desc_.shift[1],
                           desc_.field_height,      desc_.focus_tilt[0], desc_.focus_tilt[1],
                           desc_.film_height,       desc_.lens_unit};
  h = hash_bytes(numbers, sizeof(numbers), h);
  if (desc_.moves) h = hash_bytes(desc_.end.m, sizeof(desc_.end.m), h);
  h = hash_bytes(desc_.lens.data(), desc_.lens.size() * sizeof(LensSurface), h);
  for (size_t i = 1; i < desc_.outputs.size(); ++i) {
    const OutputPlanes& o = desc_.outputs[i];
    h = hash_combine(h, hash_values(o.kind, o.direct, o.indirect, o.groups, o.unfiltered));
  }
  return h;
}

PictureFrame::PictureFrame(const CameraDesc& desc, double height)
    : pixel_(float(height / desc.height)),
      left_((-0.5f * float(desc.width) + desc.shift[0] * float(desc.width) + float(desc.crop[0])) * pixel_),
      top_((0.5f * float(desc.height) + desc.shift[1] * float(desc.height) - float(desc.crop[1])) * pixel_),
      width_(desc.crop[2] - desc.crop[0]),
      height_(desc.crop[3] - desc.crop[1]) {}

float PictureFrame::reach(int margin) const {
  const Vec2 low = point({float(-margin), float(-margin)}),
             high = point({float(width_ + margin), float(height_ + margin)});
  return std::hypot(std::max(std::fabs(low.x), std::fabs(high.x)), std::max(std::fabs(low.y), std::fabs(high.y)));
}

}  // namespace bdpt
