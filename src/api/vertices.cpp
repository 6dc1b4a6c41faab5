#include "api/handles.h"
#include "api/host_array.h"
#include "api/lightmap_buffers.h"
#include "api/named_instances.h"
#include "api/output_desc.h"
#include "bake/vertex_basis.h"

using namespace bdpt;

namespace {

constexpr uint64_t kMostVertices = uint64_t(1) << 32;

std::vector<ReceivingInstance> read_instances(const Subject& subject, const bdpt_vertices_desc& desc,
                                              const Scene& scene) {
  if (desc.instance_count == 0) subject.refuse("instance_count", "is 0: name the instances to measure");
  require(desc.instances, "instances");
  check_stride(subject, "instance_stride", desc.instance_stride, kVersion1Size<bdpt_vertex_instance>, 8);
  const uint32_t stride = desc.instance_stride ? desc.instance_stride : desc.instances->struct_size;
  NamedInstances named(scene);
  std::vector<ReceivingInstance> instances;
  uint64_t vertices = 0;
  for (uint32_t i = 0; i < desc.instance_count; ++i) {
    const std::string name = "instance " + std::to_string(i);
    const bdpt_vertex_instance d = read_struct(&element(desc.instances, i, stride), name.c_str());
    Subject(name.c_str(), nullptr).check_flag("flip", d.flip);
    const uint32_t index = named.find(name, d.instance.id);
    const Mesh* mesh = scene.mesh(index);
    if (!mesh) fail(ErrorCode::InvalidArgument, name, " is a sphere or of curves, which have no vertices: give meshes");
    named.take(subject, index, i, "give it once");
    vertices += mesh->positions.size();
    instances.push_back({index, d.flip != 0});
  }
  if (vertices >= kMostVertices)
    subject.refuse("instances", "have ", vertices, " vertices: give at most ", kMostVertices - 1, " to a sensor");
  return instances;
}

const VertexBasis& vertices_of(const bdpt_sensor* sensor) {
  const auto* vertices = dynamic_cast<const VertexBasis*>(require(sensor, "sensor").sensor.get());
  if (!vertices) fail(ErrorCode::InvalidArgument, "sensor is none of vertices: give one of bdpt_vertices_create");
  return *vertices;
}

}  // namespace

bdpt_result bdpt_vertices_create(bdpt_scene* scene, const bdpt_vertices_desc* desc, bdpt_sensor** sensor) {
  return guard(__func__, [&] {
    reset_output(sensor);
    require(scene, "scene");
    const bdpt_vertices_desc d = read_struct(desc, "desc");
    require(sensor, "sensor");
    const Subject subject("vertices", nullptr);
    subject.check_flag("geometric_normals", d.geometric_normals);
    const auto instances = read_instances(subject, d, *scene->scene);
    const auto outputs = read_outputs(subject, d.outputs, d.output_count, d.output_stride, OutputKind::Irradiance);
    const auto vertices = std::make_shared<const VertexBasis>(scene->scene, instances, outputs,
                                                              d.geometric_normals != 0, scene->context->meter);
    if (vertices->count() == 0)
      subject.refuse("instances", "have no triangle with an area: there is nothing to measure");
    auto object = std::make_unique<bdpt_sensor>();
    object->context = scene->context;
    object->sensor = vertices;
    object->scene = scene->scene;
    *sensor = object.release();
  });
}

bdpt_result bdpt_vertices_read_areas(const bdpt_sensor* sensor, float* areas, uint64_t capacity) {
  return guard(__func__, [&] {
    const VertexBasis& vertices = vertices_of(sensor);
    require(areas, "areas");
    if (capacity < vertices.vertices())
      fail(ErrorCode::InvalidArgument, "capacity is ", capacity, " floats: ", vertices.vertices(), " are needed");
    for (uint64_t i = 0; i < vertices.vertices(); ++i) areas[i] = float(vertices.area(i));
  });
}

bdpt_result bdpt_vertices_solve(const bdpt_sensor* sensor, uint32_t channels, float* values, uint64_t capacity) {
  return guard(__func__, [&] {
    const VertexBasis& vertices = vertices_of(sensor);
    check_channels(Subject("vertices", nullptr), channels);
    require(values, "values");
    const uint64_t needed = vertices.vertices() * channels;
    if (capacity < needed)
      fail(ErrorCode::InvalidArgument, "capacity is ", capacity, " floats: ", needed, " are needed");
    for (uint64_t i = 0; i < needed; ++i)
      if (!std::isfinite(values[i]) && vertices.area(i / channels) > 0)
        fail(ErrorCode::InvalidArgument, "values of vertex ", i / channels,
             " are not finite: each bears on all others");
    for (uint32_t c = 0; c < channels; ++c) vertices.solve(values, c, channels);
  });
}
