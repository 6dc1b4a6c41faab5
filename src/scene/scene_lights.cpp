// What emits in a scene, and how far the scene reaches.
#include "math/box.h"
#include "scene/scene.h"

#include <unordered_map>

namespace bdpt {

namespace {

// Of the vertices of a mesh's triangles.
Box box_of(const Mesh& mesh, const View<Vec3>& positions) {
  Box box;
  for (size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Triangle t = mesh.triangles[k];
    for (uint32_t v : {t.a, t.b, t.c}) box.grow(positions[v]);
  }
  return box;
}

const TextureUse* emission_use(const MaterialDesc& material) {
  for (const TextureUse& use : material.textures)
    if (use.slot == Slot::Emission) return &use;
  return nullptr;
}

// What holds the scene's instances, in the world.
class Bounds {
 public:
  void add(const Vec3& center, float radius) { box_.grow(center, radius); }
  void add(const Mesh& mesh, const View<Vec3>& world_positions) { box_.grow(box_of(mesh, world_positions)); }
  // In object space, there and, where it moves, at the end.
  void add(const Box& box, const Transform& transform, const Transform* end) {
    for (const Vec3& corner : box.corners()) {
      box_.grow(transform.point(corner));
      if (end) box_.grow(end->point(corner));
    }
  }
  // Instances may share the mesh.
  void add(const Mesh& mesh, const Transform& transform, const Transform* end) {
    const auto [known, is_new] = boxes_.try_emplace(&mesh);
    if (is_new) known->second = box_of(mesh, mesh.positions);
    add(known->second, transform, end);
  }
  // Without instances, of the lights.
  Box finish(const std::vector<LightDesc>& lights) {
    for (const LightDesc& l : lights)
      if (l.has_position() && box_.empty()) box_.grow(l.position);
    if (box_.empty()) box_.grow(Vec3(0));
    return box_;
  }

 private:
  Box box_;
  std::unordered_map<const Mesh*, Box> boxes_;
};

}  // namespace

Box Scene::bounds() const {
  Bounds bounds;
  for (const Instance& instance : instances_) {
    if (instance.sphere) {
      bounds.add(instance.center, instance.radius);
      if (!instance.end) continue;
      const Instance there = instance.at(1);
      bounds.add(there.center, there.radius);
    } else if (instance.curves) {
      bounds.add(instance.curves->box, instance.transform, instance.end);
    } else if (instance.world_positions.empty()) {
      bounds.add(*instance.mesh, instance.transform, instance.end);
    } else {
      bounds.add(*instance.mesh, instance.world_positions);
    }
  }
  return bounds.finish(desc_.lights);
}

void Scene::check_emitter(size_t i) const {
  const std::string& label = desc_.instances[i].label;
  if (desc_.instances[i].invisible)
    fail(ErrorCode::InvalidArgument, "instance \"", label,
         "\" is invisible, but its material emits light, which no ray could find: make it visible, or give it another "
         "material");
  if (emission_use(*instances_[i].material) && instances_[i].sphere)
    fail(ErrorCode::InvalidArgument, "instance \"", label,
         "\" is a sphere, but its material has a texture of slot EMISSION, which shines from meshes alone: use a mesh, "
         "or "
         "a material without it");
  if (instances_[i].end)
    fail(ErrorCode::InvalidArgument, "instance \"", label,
         "\" moves, but its material emits light: let it stand still, or give it another material");
}

Lights::AreaLight Scene::area_light(size_t i) const {
  const Instance& instance = instances_[i];
  const MaterialDesc& material = *instance.material;
  Lights::AreaLight light;
  light.instance = int(i);
  light.radiance = material.emission;
  light.exponent = material.emission_exponent;
  light.two_sided = material.emission_two_sided;
  light.group = material.emission_group;
  if (instance.sphere) {
    light.is_sphere = true;
    light.center = instance.center;
    light.radius = instance.radius;
    light.area = 4 * kPi * instance.radius * instance.radius;
    return light;
  }
  const TextureUse* use = emission_use(material);
  if (use) {
    light.texture = desc_.textures[size_t(use->texture)];
    light.sampler = use->sampler;
  }
  double total = 0;
  for (size_t k = 0; k < instance.mesh->triangles.size(); ++k) {
    const Triangle t = instance.mesh->triangles[k];
    Vec3 corner[3];
    int c = 0;
    for (uint32_t v : {t.a, t.b, t.c})
      corner[c++] = instance.world_positions.empty() ? instance.transform.point(instance.mesh->positions[v])
                                                     : instance.world_positions[v];
    Surface surface{};
    const bool valid = triangle_surface(instance, uint32_t(k), 1.0f / 3, 1.0f / 3, surface);
    light.triangles.emplace_back(corner[0], corner[1], corner[2], valid ? surface.ng : Vec3(0), surface.margin);
    total += light.triangles.back().area();
    if (!use) continue;
    Vec2 uv[3];
    instance.mesh->uv_corners(use->uv.set, uint32_t(k), uv);
    light.uv.push_back({use->uv(uv[0]), use->uv(uv[1]), use->uv(uv[2])});
  }
  light.area = float(total);
  return light;
}

void Scene::collect_lights() {
  std::vector<Lights::AreaLight> areas;
  for (size_t i = 0; i < instances_.size(); ++i) {
    if (is_black(instances_[i].material->emission)) continue;
    check_emitter(i);
    Lights::AreaLight light = area_light(i);
    if (!(light.area > 0)) continue;
    instances_[i].light = int(areas.size());
    areas.push_back(std::move(light));
  }
  const Box box = bounds();
  info_.bounds_min = box.low;
  info_.bounds_max = box.high;
  lights_.build(areas, desc_.lights, (box.low + box.high) * 0.5f, 0.5f * length(box.high - box.low));
}

}  // namespace bdpt
