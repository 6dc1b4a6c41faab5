#include "bake/points.h"

#include "api/handles.h"
#include "api/host_array.h"
#include "api/output_desc.h"
#include "api/placement.h"
#include "geometry/margin.h"

using namespace bdpt;

namespace {

constexpr uint64_t kMaxPoints = uint64_t(1) << 32;
constexpr float kLeastRadius = 1e-9f, kMostRadius = 1e9f;  // densities are floats
constexpr float kLeastPart = 1e-4f;  // of a ball's largest coordinate: some thousand steps of a float

MeasuredPoint read_point(const bdpt_point& point, uint64_t number) {
  const std::string name = "point " + std::to_string(number);
  const Subject subject(name.c_str(), nullptr);
  subject.check_range("position", point.position, 3, -double(kMaxCoordinate), double(kMaxCoordinate));
  subject.check_finite("normal", point.normal, 3);
  subject.check_not_negative("radius", &point.radius, 1);
  const Imath::V3d normal(point.normal[0], point.normal[1], point.normal[2]);
  MeasuredPoint p{to_vec3(point.position)};
  if (normal.length() > 0) p.normal = Vec3(normal / normal.length());
  if (point.radius > 0 && !(point.radius >= kLeastRadius && point.radius <= kMostRadius))
    subject.refuse("radius", "is ", point.radius, ": give 0, or ", kLeastRadius, " to ", kMostRadius);
  const float reach = largest(p.p);
  if (normal.length() == 0 && point.radius > 0 && point.radius < kLeastPart * reach)
    subject.refuse("radius", "is ", point.radius, " although the ball is ", reach,
                   " off the origin, where floats are too coarse for it: give at least ", kLeastPart * reach, ", or 0");
  p.radius = point.radius;
  if (!(point.cone >= 0 && point.cone <= 90))
    subject.refuse("cone", "is ", point.cone, ": give degrees of (0,90], or 0 for 90");
  if (point.cone > 0 && normal.length() == 0)
    subject.refuse("cone", "is ", point.cone, " although the point has no normal: give it one, or 0");
  if (point.cone > 0 && point.cone < 90) p.cone = float(std::max(double(point.cone), 1e-3) * M_PI / 180);
  return p;
}

}  // namespace

bdpt_result bdpt_points_create(bdpt_context* context, const bdpt_points_desc* desc, bdpt_sensor** sensor) {
  return guard(__func__, [&] {
    reset_output(sensor);
    require(context, "context");
    const bdpt_points_desc d = read_struct(desc, "desc");
    require(sensor, "sensor");
    const Subject subject("points", nullptr);
    if (d.count == 0 || d.count >= kMaxPoints)
      subject.refuse("count", "is ", d.count, ": give 1 to ", kMaxPoints - 1, " points");
    require(d.points, "points");
    check_stride(subject, "point_stride", d.point_stride, sizeof(bdpt_point), 4);
    subject.check_not_negative("offset", &d.offset, 1);
    std::vector<MeasuredPoint> points;
    points.reserve(d.count);
    for (uint64_t i = 0; i < d.count; ++i) points.push_back(read_point(element(d.points, i, d.point_stride), i));
    const bool held = points[0].normal != Vec3(0);
    const auto outputs = read_outputs(subject, d.outputs, d.output_count, d.output_stride,
                                      held ? OutputKind::Irradiance : OutputKind::Fluence);
    for (const OutputDesc& o : outputs)
      if (fades(o.kind))
        for (size_t i = 0; i < points.size(); ++i)
          if (points[i].normal == Vec3(0))
            subject.refuse("outputs", "ask for irradiance or openness, and point ", i,
                           " has no normal: give it one, or ask for ", "fluence or spherical harmonics");
    auto object = std::make_unique<bdpt_sensor>();
    object->context = Ref<bdpt_context>(context);
    object->sensor = std::make_shared<const Points>(std::move(points), outputs, d.offset);
    *sensor = object.release();
  });
}
