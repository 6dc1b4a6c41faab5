#include "api/lightmap_instances.h"

#include "api/check.h"
#include "api/desc.h"
#include "api/host_array.h"
#include "api/host_view.h"
#include "api/lightmap_buffers.h"
#include "api/placement.h"

#include <string>

namespace bdpt {
namespace {

// A mesh's views, checked as bdpt_mesh_add checks them, but for triangles without area.
struct MeshViews {
  HostView positions, indices, normals, uv;

  MeshViews(const bdpt_mesh_desc& desc, const Subject& subject) {
    subject.check_reserved("reserved", desc.reserved);
    positions = read_view(subject, "positions", desc.positions, format_bit(BDPT_FORMAT_FLOAT3));
    indices = read_view(subject, "indices", desc.indices,
                        format_bit(BDPT_FORMAT_UINT16X3) | format_bit(BDPT_FORMAT_UINT32X3));
    normals = read_view(subject, "normals", desc.normals, format_bit(BDPT_FORMAT_FLOAT3));
    uv = read_view(subject, "uv[1]", desc.uv[1], format_bit(BDPT_FORMAT_FLOAT2));
    if (positions.count < 3)
      subject.refuse("positions.count", "is ", positions.count, ": a mesh needs at least one triangle, so 3 positions");
    if (indices.count == 0 && positions.count % 3 != 0)
      subject.refuse("positions.count", "is ", positions.count,
                     ": without indices, give 3 positions for each triangle");
    if (uv.count != positions.count)
      subject.refuse("uv[1].count", "is ", uv.count, ": give lightmap coordinates for all ", positions.count,
                     " positions");
    if (normals.count != 0 && normals.count != positions.count)
      subject.refuse("normals.count", "is ", normals.count, ": give as many as positions (", positions.count,
                     "), or none");
    check_finite_view(subject, "positions", positions);
    check_finite_view(subject, "normals", normals);
    check_finite_view(subject, "uv[1]", uv);
  }
  uint64_t triangles() const { return indices.count ? indices.count : positions.count / 3; }
};

class InstanceReader {
 public:
  InstanceReader(const bdpt_uv_instance& instance, const Subject& place, const Subject& mesh, const AtlasSize& atlas)
      : place_(place), mesh_(mesh), atlas_(atlas), transform_(read_transform(place, instance.transform)) {
    place.check_reserved("reserved", instance.reserved);
    place.check_finite("uv_scale", instance.uv_scale, 2);
    place.check_finite("uv_offset", instance.uv_offset, 2);
    for (int i = 0; i < 2; ++i) scale_[i] = instance.uv_scale[i], offset_[i] = instance.uv_offset[i];
    if (scale_ == Vec2d(0, 0)) scale_ = Vec2d(1, 1);
    if (scale_.x == 0 || scale_.y == 0)
      place.refuse("uv_scale", "is (", scale_.x, ", ", scale_.y, "): give two scales other than 0, or two zeros for 1");
  }

  UvMesh read(const MeshViews& views) {
    UvMesh mesh;
    mesh.handedness = transform_.determinant() < 0 ? -1 : 1;
    const Vec2d corner = texel(Vec2d(0, 0)), opposite = texel(Vec2d(1, 1));
    for (int axis = 0; axis < 2; ++axis) {
      mesh.rect_low[axis] = std::min(corner[axis], opposite[axis]);
      mesh.rect_high[axis] = std::max(corner[axis], opposite[axis]);
    }
    read_vertices(views, mesh);
    mesh.triangles.reserve(views.triangles());
    for (uint64_t i = 0; i < views.triangles(); ++i) {
      const Triangle t = read_triangle(views.indices, i);
      if (const uint32_t largest = std::max(t.a, std::max(t.b, t.c)); largest >= views.positions.count)
        mesh_.refuse("indices", "has index ", largest, " in triangle ", i,
                     ": give indices below the count of positions (", views.positions.count, ")");
      mesh.triangles.push_back({t.a, t.b, t.c});
    }
    return mesh;
  }

 private:
  Vec2d texel(const Vec2d& uv) const { return to_texels(uv * scale_ + offset_, atlas_.width, atlas_.height); }
  Vec3d column(int i) const { return {transform_.m[i], transform_.m[4 + i], transform_.m[8 + i]}; }

  void read_vertices(const MeshViews& views, UvMesh& mesh) const {
    const View<Vec3> positions = views.positions.as<Vec3>(), normals = views.normals.as<Vec3>();
    const View<Vec2> uv = views.uv.as<Vec2>();
    const Vec3d a = column(0), b = column(1), c = column(2), origin = column(3);
    // The inverse transposed, up to a factor: takes normals to the world.
    const Vec3d cofactors[3] = {b.cross(c) * mesh.handedness, c.cross(a) * mesh.handedness,
                                a.cross(b) * mesh.handedness};
    mesh.positions.reserve(positions.size());
    mesh.texels.reserve(positions.size());
    mesh.normals.reserve(normals.size());
    for (size_t i = 0; i < positions.size(); ++i) {
      const Vec3d p(positions[i]), world = a * p.x + b * p.y + c * p.z + origin;
      if (!(std::max({std::fabs(world.x), std::fabs(world.y), std::fabs(world.z)}) <= kMaxCoordinate))
        place_.refuse("transform", "takes position ", i, " of ", mesh_.name(), " beyond ", kMaxCoordinate,
                      " in the world: give smaller coordinates");
      mesh.positions.push_back(world);
      mesh.texels.push_back(texel(Vec2d(uv[i])));
    }
    for (size_t i = 0; i < normals.size(); ++i) {
      const Vec3d n(normals[i]);
      if (n == Vec3d(0, 0, 0))
        mesh_.refuse("normals", "has length zero in element ", i, ": give a direction, of any length");
      mesh.normals.push_back((cofactors[0] * n.x + cofactors[1] * n.y + cofactors[2] * n.z).normalized());
    }
  }

  const Subject &place_, &mesh_;
  AtlasSize atlas_;
  Transform transform_;
  Vec2d scale_, offset_;
};

}  // namespace

std::vector<UvMesh> read_uv_instances(const bdpt_uv_instance* instances, uint32_t count, uint32_t stride,
                                      const std::function<AtlasSize(uint32_t atlas)>& size_of) {
  const Subject desc("desc", nullptr);
  if (count < 1) desc.refuse("instance_count", "is 0: give at least one instance");
  require(instances, "desc.instances");
  const size_t step = read_stride(desc, "instance_stride", stride, sizeof(bdpt_uv_instance));
  std::vector<UvMesh> meshes;
  meshes.reserve(count);
  for (uint32_t i = 0; i < count; ++i) {
    const bdpt_uv_instance& instance = element(instances, i, step);
    const std::string name = "desc.instances[" + std::to_string(i) + ']', mesh_name = name + ".mesh";
    const bdpt_mesh_desc mesh_desc = read_struct(instance.mesh, mesh_name.c_str());
    const Subject place(name.c_str(), nullptr), mesh(mesh_name.c_str(), mesh_desc.label);
    const AtlasSize size = size_of(instance.atlas);
    const MeshViews views(mesh_desc, mesh);
    meshes.push_back(InstanceReader(instance, place, mesh, size).read(views));
    meshes.back().atlas = instance.atlas;
  }
  return meshes;
}

}  // namespace bdpt
