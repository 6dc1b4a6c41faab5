#include "api/builder.h"
#include "api/check.h"
#include "api/desc.h"
#include "api/placement.h"

using namespace bdpt;

namespace {

// The world coordinates of the shape must be such that rays can find it.
void check_reach(const Subject& subject, const char* field, const Transform& transform, const Vec3& extent) {
  for (int row = 0; row < 3; ++row) {
    const float* m = transform.m + 4 * row;
    double reach = std::fabs(double(m[3]));
    for (int i = 0; i < 3; ++i) reach += std::fabs(double(m[i])) * double(extent[i]);
    if (!(reach <= kMaxCoordinate))
      subject.refuse(field, "takes the shape to coordinates of ", reach, ": keep the scene within ", kMaxCoordinate);
  }
}

// Nothing may vanish or turn inside out on the way.
void check_motion(const Subject& subject, const Transform& begin, const Transform& end) {
  constexpr int kTimes = 256;
  constexpr double kLeast = 1e-3;  // of the volume at either end
  const double first = begin.determinant(), last = end.determinant();
  for (int i = 0; i <= kTimes; ++i) {
    const double det = between(begin, end, float(i) / kTimes).determinant();
    if (!(det / first > 0) || !(std::fabs(det) >= kLeast * std::min(std::fabs(first), std::fabs(last))))
      subject.refuse("end_transform", "leads through a singular transform at time ", float(i) / kTimes,
                     ": let it turn less, or not be mirrored");
  }
}

Transform read_placement(const Subject& subject, const char* field, const float m[12], const ShapeEntry& shape) {
  const Transform transform = read_transform(subject, m, field);
  if (shape.is_sphere() && uniform_scale(transform) == 0)
    subject.refuse(field, "makes an ellipsoid of a sphere: scale it alike in all directions, or use a mesh");
  check_reach(subject, field, transform, shape.extent);
  return transform;
}

InstanceEntry read_instance(bdpt_builder& builder, const bdpt_instance_desc& desc) {
  const Subject subject("instance", desc.label);
  subject.check_flag("invisible", desc.invisible);
  const ShapeEntry& shape = builder.shapes.at(desc.shape.id, "desc.shape");
  builder.materials.at(desc.material.id, "desc.material");
  InstanceEntry entry{subject.label(), desc.shape.id, desc.material.id};
  entry.transform = read_placement(subject, "transform", desc.transform, shape);
  entry.moves = !is_zero(desc.end_transform);
  if (entry.moves) {
    entry.end = read_placement(subject, "end_transform", desc.end_transform, shape);
    check_motion(subject, entry.transform, entry.end);
  }
  entry.invisible = desc.invisible != 0;
  return entry;
}

void use(bdpt_builder& builder, const InstanceEntry& instance) {
  ++builder.shapes[instance.shape].users;
  ++builder.materials[instance.material].users;
}

void leave(bdpt_builder& builder, const InstanceEntry& instance) {
  --builder.shapes[instance.shape].users;
  --builder.materials[instance.material].users;
}

}  // namespace

bdpt_result bdpt_instance_add(bdpt_builder* builder, const bdpt_instance_desc* desc, bdpt_instance_id* instance) {
  return guard(__func__, [&] {
    reset_output(instance);
    bdpt_builder& b = writable(builder);
    const bdpt_instance_desc d = read_struct(desc, "desc");
    require(instance, "instance");
    instance->id = b.instances.add(read_instance(b, d));
    use(b, b.instances[instance->id]);
  });
}

bdpt_result bdpt_instance_update(bdpt_builder* builder, bdpt_instance_id instance, const bdpt_instance_desc* desc) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const bdpt_instance_desc d = read_struct(desc, "desc");
    InstanceEntry& entry = b.instances.at(instance.id, "instance");
    InstanceEntry updated = read_instance(b, d);
    use(b, updated);
    leave(b, entry);
    entry = std::move(updated);
  });
}

bdpt_result bdpt_instance_remove(bdpt_builder* builder, bdpt_instance_id instance) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    leave(b, b.instances.at(instance.id, "instance"));
    b.instances.take(instance.id);
  });
}
