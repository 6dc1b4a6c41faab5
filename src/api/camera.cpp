#include "sensor/camera.h"

#include "api/check.h"
#include "api/desc.h"
#include "api/handles.h"
#include "api/placement.h"
#include "api/read_rect.h"

#include <algorithm>

using namespace bdpt;

namespace {

constexpr float kMaxSide = 65536;
constexpr float kDefaultFieldOfView = 45;

void read_size(const Subject& subject, const bdpt_camera_desc& desc, CameraDesc& camera) {
  subject.check_range("width", desc.width, 1, kMaxSide);
  subject.check_range("height", desc.height, 1, kMaxSide);
  camera.width = int(desc.width);
  camera.height = int(desc.height);
  const PixelRect crop = read_rect(subject, "crop", desc.crop, camera.width, camera.height);
  const int corners[4] = {crop.x0, crop.y0, crop.x1, crop.y1};
  std::copy(corners, corners + 4, camera.crop);
}

void read_place(const Subject& subject, const bdpt_camera_desc& desc, CameraDesc& camera) {
  const Transform transform = read_transform(subject, desc.transform);
  if (uniform_scale(transform) == 0)
    subject.refuse("transform",
                   "shears or scales unevenly: its columns must be orthogonal and of equal length, within a "
                   "thousandth");
  camera.transform = without_scale(transform);
  for (int i = 3; i < 12; i += 4)
    if (std::fabs(transform.m[i]) > kMaxCoordinate)
      subject.refuse("transform", "moves the camera to ", transform.m[i], ": keep it within ", kMaxCoordinate);
}

void read_lens(const Subject& subject, const bdpt_camera_desc& desc, CameraDesc& camera) {
  if (!(desc.field_of_view >= 0 && desc.field_of_view < 180))
    subject.refuse("field_of_view", "is ", desc.field_of_view,
                   ": give an angle above 0 and below 180 degrees, or 0 for 45");
  camera.field_of_view = desc.field_of_view == 0 ? kDefaultFieldOfView : desc.field_of_view;
  subject.check_not_negative("lens_radius", &desc.lens_radius, 1);
  subject.check_not_negative("focus_distance", &desc.focus_distance, 1);
  if (desc.lens_radius > 0 && desc.focus_distance == 0)
    subject.refuse("focus_distance", "is 0 although lens_radius is ", desc.lens_radius, ": give the distance in focus");
  camera.lens_radius = desc.lens_radius;
  if (desc.lens_radius > 0) camera.focus_distance = desc.focus_distance;
  if (desc.aperture_blades != 0) subject.check_range("aperture_blades", desc.aperture_blades, 3, 32);
  camera.aperture_blades = int(desc.aperture_blades);
  subject.check_finite("aperture_rotation", desc.aperture_rotation);
  camera.aperture_rotation = desc.aperture_rotation;
  subject.check_finite("shift", desc.shift, 2);
  camera.shift[0] = desc.shift[0];
  camera.shift[1] = desc.shift[1];
}

CameraDesc read_camera(const bdpt_camera_desc& desc) {
  const Subject subject("camera", nullptr);
  CameraDesc camera;
  read_size(subject, desc, camera);
  read_place(subject, desc, camera);
  read_lens(subject, desc, camera);
  return camera;
}

}  // namespace

bdpt_result bdpt_camera_create(bdpt_context* context, const bdpt_camera_desc* desc, bdpt_sensor** sensor) {
  return guard(__func__, [&] {
    reset_output(sensor);
    require(context, "context");
    const bdpt_camera_desc d = read_struct(desc, "desc");
    require(sensor, "sensor");
    auto object = std::make_unique<bdpt_sensor>();
    object->context = Ref<bdpt_context>(context);
    object->sensor = std::make_shared<const Camera>(read_camera(d));
    *sensor = object.release();
  });
}

void bdpt_sensor_retain(bdpt_sensor* sensor) {
  if (sensor) sensor->retain();
}

void bdpt_sensor_release(bdpt_sensor* sensor) {
  if (sensor) sensor->release();
}
