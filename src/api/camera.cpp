#include "sensor/camera.h"

#include "api/camera_outputs.h"
#include "api/check.h"
#include "api/desc.h"
#include "api/handles.h"
#include "api/host_array.h"
#include "api/placement.h"
#include "api/read_rect.h"

#include <algorithm>
#include <iterator>

using namespace bdpt;

namespace {

constexpr float kDefaultFieldOfView = 45, kDefaultFisheye = 180;
constexpr float kMaxLens = 1e6f;  // lengths of lenses, and scales

void read_size(const Subject& subject, const bdpt_camera_desc& desc, CameraDesc& camera) {
  subject.check_range("width", desc.width, 1, kMaxImageSide);
  subject.check_range("height", desc.height, 1, kMaxImageSide);
  camera.width = int(desc.width);
  camera.height = int(desc.height);
  const PixelRect crop = read_rect(subject, "crop", desc.crop, camera.width, camera.height);
  const int corners[4] = {crop.x0, crop.y0, crop.x1, crop.y1};
  std::copy(corners, corners + 4, camera.crop);
}

Transform read_frame(const Subject& subject, const char* field, const float m[12]) {
  const Transform transform = read_transform(subject, m, field);
  if (uniform_scale(transform) == 0)
    subject.refuse(field,
                   "shears or scales unevenly: its columns must be orthogonal and of equal length, within a "
                   "thousandth");
  for (int i = 3; i < 12; i += 4)
    if (std::fabs(transform.m[i]) > kMaxCoordinate)
      subject.refuse(field, "moves the camera to ", transform.m[i], ": keep it within ", kMaxCoordinate);
  return without_scale(transform);
}

void read_place(const Subject& subject, const bdpt_camera_desc& desc, CameraDesc& camera) {
  camera.transform = read_frame(subject, "transform", desc.transform);
  camera.moves = !is_zero(desc.end_transform);
  if (!camera.moves) return;
  camera.end = read_frame(subject, "end_transform", desc.end_transform);
  if ((camera.end.determinant() < 0) != (camera.transform.determinant() < 0))
    subject.refuse("end_transform", "is a reflection of transform: let both be, or neither");
}

// What a type may have beside its picture and its place.
enum Field : uint32_t {
  kFieldOfView = 1,
  kLensRadius = 2,
  kFocus = 4,
  kAperture = 8,
  kShift = 16,
  kFieldHeight = 32,
  kTilt = 64,
  kLens = 128
};
constexpr uint32_t kFields[] = {
    kFieldOfView | kLensRadius | kFocus | kAperture | kShift | kTilt,
    kShift | kFieldHeight,
    kFieldOfView | kShift,
    kFieldOfView | kShift,
    0,
    0,
    kFocus | kAperture | kShift | kLens,
};
static_assert(std::size(kFields) == BDPT_CAMERA_LENS + 1);

bool has(const bdpt_camera_desc& desc, Field field) { return kFields[desc.type] & field; }

void check_fields(const Subject& subject, const bdpt_camera_desc& desc) {
  const struct {
    const char* name;
    Field field;
    bool is_set;
  } fields[] = {
      {"field_of_view", kFieldOfView, desc.field_of_view != 0},
      {"lens_radius", kLensRadius, desc.lens_radius != 0},
      {"focus_distance", kFocus, desc.focus_distance != 0},
      {"aperture_blades", kAperture, desc.aperture_blades != 0},
      {"aperture_rotation", kAperture, desc.aperture_rotation != 0},
      {"shift", kShift, desc.shift[0] != 0 || desc.shift[1] != 0},
      {"field_height", kFieldHeight, desc.field_height != 0},
      {"focus_tilt", kTilt, desc.focus_tilt[0] != 0 || desc.focus_tilt[1] != 0},
      {"film_height", kLens, desc.film_height != 0},
      {"lens_unit", kLens, desc.lens_unit != 0},
      {"lens_surface_count", kLens, desc.lens_surface_count != 0},
      {"lens_surface_stride", kLens, desc.lens_surface_stride != 0},
      {"lens_surfaces", kLens, desc.lens_surfaces != nullptr},
  };
  for (const auto& f : fields)
    if (f.is_set && !has(desc, f.field))
      subject.refuse(f.name, "means nothing to a camera of type ", desc.type,
                     ": leave it zero, or choose another type");
}

void read_field(const Subject& subject, const bdpt_camera_desc& desc, CameraDesc& camera) {
  const float angle = desc.field_of_view;
  if (desc.type == BDPT_CAMERA_PERSPECTIVE) {
    if (!(angle >= 0 && angle < 180))
      subject.refuse("field_of_view", "is ", angle, ": give an angle above 0 and below 180 degrees, or 0 for 45");
    camera.field_of_view = angle == 0 ? kDefaultFieldOfView : angle;
  } else if (has(desc, kFieldOfView)) {
    if (!(angle >= 0 && angle <= 360))
      subject.refuse("field_of_view", "is ", angle, ": give an angle above 0 and up to 360 degrees, or 0 for 180");
    camera.field_of_view = angle == 0 ? kDefaultFisheye : angle;
  }
  if (has(desc, kFieldHeight)) {
    if (!(desc.field_height > 0 && double(desc.field_height) <= kMaxCoordinate))
      subject.refuse("field_height", "is ", desc.field_height, ": give the picture's height in world units, above 0");
    camera.field_height = desc.field_height;
  }
  subject.check_finite("shift", desc.shift, 2);
  camera.shift[0] = desc.shift[0];
  camera.shift[1] = desc.shift[1];
}

void read_aperture(const Subject& subject, const bdpt_camera_desc& desc, CameraDesc& camera) {
  subject.check_not_negative("lens_radius", &desc.lens_radius, 1);
  subject.check_not_negative("focus_distance", &desc.focus_distance, 1);
  if (desc.lens_radius > 0 && desc.focus_distance == 0)
    subject.refuse("focus_distance", "is 0 although lens_radius is ", desc.lens_radius, ": give the distance in focus");
  camera.lens_radius = desc.lens_radius;
  if (desc.lens_radius > 0 || desc.type == BDPT_CAMERA_LENS) camera.focus_distance = desc.focus_distance;
  if (desc.aperture_blades != 0) subject.check_range("aperture_blades", desc.aperture_blades, 3, 32);
  camera.aperture_blades = int(desc.aperture_blades);
  subject.check_finite("aperture_rotation", desc.aperture_rotation);
  camera.aperture_rotation = desc.aperture_rotation;
  double slope = 0;
  for (int i = 0; i < 2; ++i) {
    const float tilt = desc.focus_tilt[i];
    if (!(tilt > -90 && tilt < 90))
      subject.refuse("focus_tilt", "has ", tilt, ": give angles above -90 and below 90 degrees");
    if (tilt != 0 && desc.lens_radius == 0)
      subject.refuse("focus_tilt", "has ", tilt, " although lens_radius is 0: a pinhole has no plane in focus");
    camera.focus_tilt[i] = tilt;
    slope = std::hypot(slope, std::tan(double(tilt) * M_PI / 180));
  }
  if (slope * double(desc.lens_radius) > 0.99 * double(desc.focus_distance))
    subject.refuse("focus_tilt", "is ", desc.focus_tilt[0], ", ", desc.focus_tilt[1],
                   ": the plane in focus would cut the lens; tilt it less, focus farther off or make the lens smaller");
}

LensSurface read_surface(const Subject& subject, const bdpt_lens_surface& s, uint32_t i) {
  const auto refuse = [&](const char* field, const auto&... parts) {
    subject.refuse(("lens_surfaces[" + std::to_string(i) + "]." + field).c_str(), parts...);
  };
  if (!(s.aperture > 0 && s.aperture <= kMaxLens))
    refuse("aperture", "is ", s.aperture, ": give a diameter above 0, and up to ", kMaxLens);
  if (!std::isfinite(s.radius)) refuse("radius", "is ", s.radius, ": give a number, or 0 for a flat surface");
  if (s.radius != 0 && s.aperture > 2 * std::fabs(s.radius))
    refuse("aperture", "is ", s.aperture, ": it is at most twice the radius of curvature, ", s.radius);
  if (!(s.thickness >= 0 && s.thickness <= kMaxLens))
    refuse("thickness", "is ", s.thickness, ": give a distance of 0 to ", kMaxLens);
  if (s.ior != 0 && !(s.ior >= 1 && s.ior <= 4)) refuse("ior", "is ", s.ior, ": give 1 to 4, or 0 for air");
  return {s.radius, s.thickness, s.ior == 0 ? 1 : s.ior, s.aperture};
}

void read_lens(const Subject& subject, const bdpt_camera_desc& desc, CameraDesc& camera) {
  subject.check_range("lens_surface_count", desc.lens_surface_count, 1, 64);
  check_stride(subject, "lens_surface_stride", desc.lens_surface_stride, sizeof(bdpt_lens_surface), 4);
  require(desc.lens_surfaces, "desc.lens_surfaces");
  for (uint32_t i = 0; i < desc.lens_surface_count; ++i)
    camera.lens.push_back(read_surface(subject, element(desc.lens_surfaces, i, desc.lens_surface_stride), i));
  if (camera.lens.back().ior != 1)
    subject.refuse("lens_surfaces", "end in a medium of ior ", camera.lens.back().ior, ": the film is in air, give 0");
  if (desc.film_height != 0) {
    subject.check_range("film_height", desc.film_height, 1 / kMaxLens, kMaxLens);
    camera.film_height = desc.film_height;
  }
  if (desc.lens_unit != 0) {
    subject.check_range("lens_unit", desc.lens_unit, 1 / kMaxLens, kMaxLens);
    camera.lens_unit = desc.lens_unit;
  }
  const double image = desc.focus_distance == 0
                           ? double(camera.lens.back().thickness)
                           : image_distance(camera.lens, double(desc.focus_distance) / double(camera.lens_unit));
  if (!(image > 0) || !std::isfinite(image)) {
    if (desc.focus_distance == 0)
      subject.refuse("lens_surfaces", "end with a thickness of 0: give the distance to the film, or a focus_distance");
    subject.refuse("focus_distance", "is ", desc.focus_distance, ": the lens makes no image of what is there");
  }
}

CameraDesc read_camera(const bdpt_camera_desc& desc) {
  const Subject subject("camera", nullptr);
  CameraDesc camera;
  subject.check_enum("type", desc.type, BDPT_CAMERA_LENS);
  camera.type = static_cast<CameraType>(desc.type);
  check_fields(subject, desc);
  read_size(subject, desc, camera);
  if (desc.type == BDPT_CAMERA_CUBE && desc.width != 6 * desc.height && desc.height != 6 * desc.width)
    subject.refuse("width", "is ", desc.width, " and height ", desc.height,
                   ": six square faces need width = 6 height, or height = 6 width");
  read_place(subject, desc, camera);
  read_field(subject, desc, camera);
  read_aperture(subject, desc, camera);
  if (has(desc, kLens)) read_lens(subject, desc, camera);
  camera.outputs = read_camera_outputs(subject, desc);
  return camera;
}

std::shared_ptr<const Camera> create_camera(const CameraDesc& desc) {
  auto camera = make_camera(desc);
  if (!camera)
    fail(ErrorCode::InvalidArgument,
         "lens_surfaces of the camera let no light pass to the middle of the film: check signs and apertures");
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
    object->sensor = create_camera(read_camera(d));
    *sensor = object.release();
  });
}

void bdpt_sensor_retain(bdpt_sensor* sensor) {
  if (sensor) sensor->retain();
}

void bdpt_sensor_release(bdpt_sensor* sensor) {
  if (sensor) sensor->release();
}
