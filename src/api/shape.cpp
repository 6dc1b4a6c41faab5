#include "api/builder.h"
#include "api/check.h"
#include "api/curves_data.h"
#include "api/desc.h"
#include "api/mesh_data.h"
#include "api/subdivision_data.h"

using namespace bdpt;

namespace {

Vec3 extent_of(const Mesh& mesh) {
  Vec3 extent(0);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = mesh.positions[i];
    for (int axis = 0; axis < 3; ++axis) extent[axis] = std::max(extent[axis], std::fabs(p[axis]));
  }
  return extent;
}

Vec3 extent_of(const Curves& curves) {
  Vec3 extent;
  for (int axis = 0; axis < 3; ++axis)
    extent[axis] = curves.unit * std::max(std::fabs(curves.box.low[axis]), std::fabs(curves.box.high[axis]));
  return extent;
}

ShapeEntry read_sphere(const bdpt_sphere_desc& desc) {
  const Subject subject("sphere", desc.label);
  subject.check_reserved("reserved", desc.reserved);
  subject.check_finite("center", desc.center, 3);
  subject.check_finite("radius", desc.radius);
  if (!(desc.radius > 0)) subject.refuse("radius", "is ", desc.radius, ": give a radius above 0");
  ShapeEntry entry;
  entry.shape.sphere = std::make_shared<const Sphere>(Sphere{subject.label(), to_vec3(desc.center), desc.radius});
  for (int axis = 0; axis < 3; ++axis) entry.extent[axis] = std::fabs(desc.center[axis]) + desc.radius;
  return entry;
}

void report_degenerate(const Log& log, const Mesh& mesh) {
  if (mesh.degenerate == 0) return;
  log.warning(Subject("mesh", mesh.label.c_str()).name(), ": ", mesh.degenerate, " of ",
              mesh.degenerate + mesh.triangles.size(), " triangles have no area and were dropped");
}

uint64_t add_mesh(bdpt_builder& builder, const std::shared_ptr<const Mesh>& mesh) {
  ShapeEntry entry;
  entry.shape.mesh = mesh;
  entry.extent = extent_of(*mesh);
  const uint64_t id = builder.shapes.add(std::move(entry));
  report_degenerate(*builder.context->log, *mesh);
  return id;
}

void report_dropped(const Log& log, const Curves& curves) {
  if (curves.dropped == 0) return;
  log.warning(Subject("curves", curves.label.c_str()).name(), ": ", curves.dropped,
              " segments have no length or no radius and were dropped");
}

}  // namespace

bdpt_result bdpt_mesh_add(bdpt_builder* builder, const bdpt_mesh_desc* desc, bdpt_shape_id* shape) {
  return guard(__func__, [&] {
    MeshReleases releases(desc);
    reset_output(shape);
    bdpt_builder& b = writable(builder);
    const bdpt_mesh_desc d = read_struct(desc, "desc");
    require(shape, "shape");
    shape->id = add_mesh(b, read_mesh(d, releases, b.context->meter));
  });
}

bdpt_result bdpt_subdivision_add(bdpt_builder* builder, const bdpt_subdivision_desc* desc, bdpt_shape_id* shape) {
  return guard(__func__, [&] {
    const SubdivisionReleases releases(desc);
    reset_output(shape);
    bdpt_builder& b = writable(builder);
    const bdpt_subdivision_desc d = read_struct(desc, "desc");
    require(shape, "shape");
    const Busy::Mark mark(b.busy);
    shape->id = add_mesh(b, read_subdivision(d, *b.context->device, b.context->meter));
  });
}

bdpt_result bdpt_sphere_add(bdpt_builder* builder, const bdpt_sphere_desc* desc, bdpt_shape_id* shape) {
  return guard(__func__, [&] {
    reset_output(shape);
    bdpt_builder& b = writable(builder);
    const bdpt_sphere_desc d = read_struct(desc, "desc");
    require(shape, "shape");
    shape->id = b.shapes.add(read_sphere(d));
  });
}

bdpt_result bdpt_curves_add(bdpt_builder* builder, const bdpt_curves_desc* desc, bdpt_shape_id* shape) {
  return guard(__func__, [&] {
    const CurvesReleases releases(desc);
    reset_output(shape);
    bdpt_builder& b = writable(builder);
    const bdpt_curves_desc d = read_struct(desc, "desc");
    require(shape, "shape");
    ShapeEntry entry;
    entry.shape.curves = read_curves(d, b.context->meter);
    entry.extent = extent_of(*entry.shape.curves);
    const std::shared_ptr<const Curves> curves = entry.shape.curves;
    shape->id = b.shapes.add(std::move(entry));
    report_dropped(*b.context->log, *curves);
  });
}

bdpt_result bdpt_shape_remove(bdpt_builder* builder, bdpt_shape_id shape) {
  return guard(__func__, [&] {
    bdpt_builder& b = writable(builder);
    const ShapeEntry& entry = b.shapes.at(shape.id, "shape");
    check_unused(entry.users, "shape", entry.label(), "instance");
    b.shapes.take(shape.id);
  });
}
