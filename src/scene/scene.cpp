#include "scene/scene.h"

#include "geometry/margin.h"
#include "scene/scene_hash.h"

namespace bdpt {

Scene::Scene(SceneDesc desc, const std::shared_ptr<const RayDevice>& device, const std::shared_ptr<MemoryMeter>& meter,
             const Progress& progress)
    : desc_(std::move(desc)) {
  if (desc_.instances.empty() && desc_.lights.empty())
    fail(ErrorCode::InvalidArgument, "the builder holds no instance and no light; add some before building");

  for (MaterialDesc& m : desc_.materials)
    for (int i = 0; i < 2 && m.type == MaterialType::Mix; ++i) m.parts[i] = &desc_.materials[size_t(m.mixed[i])];

  number_answers();
  booking_ = Booking(meter, world_position_bytes(), "the scene's world positions");
  number_enclosures();
  place_instances();
  light_booking_ = Booking(meter, Lights::table_bytes(desc_.lights), "the tables of the scene's lights' pictures");
  collect_lights();

  const uint64_t before = device->memory();
  std::vector<RayGeometry> geometries(instances_.size());
  for (size_t i = 0; i < instances_.size(); ++i) {
    const Instance& instance = instances_[i];
    if (desc_.instances[i].invisible) continue;
    geometries[i] = {instance.mesh, instance.sphere,          instance.curves, instance.transform,
                     instance.end,  instance.world_positions, false,           opacity_test(instance)};
    if (instance.mesh && instance.world_positions.empty()) {
      geometries[i].instanced = true;
      geometries[i].world_positions = object_positions(*instance.mesh);
    }
  }
  rays_ = std::make_unique<RayScene>(device, geometries, progress);
  info_.memory_embree = device->memory() > before ? device->memory() - before : 0;
  info_.memory = info_.memory_embree + booking_.bytes() + light_booking_.bytes();
  for (const Shape& s : desc_.shapes) {
    if (s.mesh) info_.memory += s.mesh->memory;
    if (s.curves) info_.memory += s.curves->memory();
  }
  for (const auto& t : desc_.textures)
    if (t) info_.memory += t->memory();
  info_.instances = instances_.size();
  for (const MaterialDesc& m : desc_.materials)
    info_.has_specular = info_.has_specular || m.has_specular() || m.varies();
  info_.hash = hash_scene(desc_);
  if (has_interiors_) find_light_interiors();
}

// Embree reads 16 bytes past the last position: arrays that may not be read so far are copied.
View<Vec3> Scene::object_positions(const Mesh& mesh) {
  if (mesh.positions_padded) return mesh.positions;
  for (const auto& [known, view] : padded_)
    if (known == &mesh) return view;
  std::vector<Vec3>& copy = world_positions_.emplace_back();
  copy.reserve(mesh.positions.size() + 2);
  for (size_t i = 0; i < mesh.positions.size(); ++i) copy.push_back(mesh.positions[i]);
  copy.resize(copy.size() + 2);
  const View<Vec3> view(copy.data(), mesh.positions.size(), sizeof(Vec3));
  padded_.emplace_back(&mesh, view);
  return view;
}

// What rays ask of an instance that is not there everywhere; nullptr for one that is.
const OpacityTest* Scene::opacity_test(const Instance& instance) {
  const Opacity& opacity = instance.material->opacity;
  if (opacity.mode == Opacity::Mode::Opaque) return nullptr;
  const Texture* texture = opacity.texture < 0 ? nullptr : desc_.textures[size_t(opacity.texture)].get();
  opacity_tests_.push_back(std::make_unique<const OpacityTest>(
      OpacityTest{opacity, texture, instance.mesh, instance.curves, instance.transform,
                  instance.end ? *instance.end : instance.transform}));
  return opacity_tests_.back().get();
}

std::vector<int> Scene::uses_of_shapes() const {
  std::vector<int> uses(desc_.shapes.size());
  for (const InstanceDesc& i : desc_.instances) ++uses[size_t(i.shape)];
  return uses;
}

// What place_instances() is going to copy, at most.
uint64_t Scene::world_position_bytes() const {
  const std::vector<int> uses = uses_of_shapes();
  std::vector<uint8_t> counted(desc_.shapes.size());
  uint64_t bytes = 0;
  for (const InstanceDesc& i : desc_.instances) {
    const Mesh* mesh = desc_.shapes[size_t(i.shape)].mesh.get();
    if (!mesh) continue;
    if (i.moves) {
      if (!mesh->positions_padded && !counted[size_t(i.shape)]) bytes += (mesh->positions.size() + 2) * sizeof(Vec3);
      counted[size_t(i.shape)] = 1;
      continue;
    }
    const bool own = !i.transform.is_identity() && uses[size_t(i.shape)] == 1;
    if (own || (!mesh->positions_padded && !counted[size_t(i.shape)]))
      bytes += (mesh->positions.size() + 2) * sizeof(Vec3);
    counted[size_t(i.shape)] = 1;
  }
  return bytes;
}

bool Scene::varies(const MaterialDesc& material) const {
  if (material.varies()) return true;
  return material.type == MaterialType::Mix && (!desc_.materials[size_t(material.mixed[0])].textures.empty() ||
                                                !desc_.materials[size_t(material.mixed[1])].textures.empty());
}

void Scene::place_instances() {
  const std::vector<int> uses = uses_of_shapes();
  for (InstanceDesc& d : desc_.instances) {
    Instance instance;
    const Shape& shape = desc_.shapes[size_t(d.shape)];
    instance.material = &desc_.materials[size_t(d.material)];
    instance.is_plain = instance.material->textures.empty() && !instance.material->is_anisotropic() &&
                        !(shape.mesh && !shape.mesh->colors.empty());
    instance.varies = varies(*instance.material);
    instance.asks_host = asks_host(*instance.material);
    instance.identity = d.transform.is_identity() && !d.moves;
    instance.handedness = d.transform.determinant() < 0 ? -1.0f : 1.0f;
    if (shape.mesh) {
      instance.mesh = shape.mesh.get();
      info_.triangles += instance.mesh->triangles.size();
      info_.degenerate += instance.mesh->degenerate;
      if (d.moves) {
        instance.end = &d.end;
      } else if (instance.identity) {
        instance.world_positions = object_positions(*instance.mesh);
      } else if (uses[size_t(d.shape)] == 1) {
        std::vector<Vec3>& world = world_positions_.emplace_back();
        world.reserve(instance.mesh->positions.size() + 2);
        for (size_t i = 0; i < instance.mesh->positions.size(); ++i)
          world.push_back(d.transform.point(instance.mesh->positions[i]));
        world.resize(world.size() + 2);
        instance.world_positions = View<Vec3>(world.data(), instance.mesh->positions.size(), sizeof(Vec3));
      }
    } else if (shape.curves) {
      check_curves(d);
      instance.curves = shape.curves.get();
      info_.curves += instance.curves->segments.size();
      info_.degenerate += instance.curves->dropped;
      d.transform = in_unit(d.transform, instance.curves->unit);
      d.end = in_unit(d.end, instance.curves->unit);
      if (d.moves) instance.end = &d.end;
    } else {
      instance.sphere = shape.sphere.get();
      if (d.moves) instance.end = &d.end;
      ++info_.spheres;
    }
    instance.place(d.transform);
    moves_ = moves_ || d.moves;
    instances_.push_back(std::move(instance));
  }
}

void Scene::Instance::place(const Transform& to_world) {
  transform = to_world;
  inverse = invert(to_world);
  if (!sphere) return;
  center = to_world.point(sphere->center);
  radius = sphere->radius * length(to_world.column(0));
}

Scene::Instance Scene::Instance::at(float time) const {
  Instance there = *this;
  there.place(between(transform, *end, time));
  if (sphere) {  // as Embree moves it
    const float r1 = sphere->radius * length(end->column(0));
    there.center = center * (1 - time) + end->point(sphere->center) * time;
    there.radius = radius * (1 - time) + r1 * time;
  }
  return there;
}

bool Scene::triangle_surface(const Instance& instance, uint32_t primitive, float u, float v, Surface& s) const {
  const Mesh& mesh = *instance.mesh;
  const Triangle t = mesh.triangles[primitive];
  const bool flat = !instance.world_positions.empty();
  Vec3 a, b, c;
  if (flat) {
    a = instance.world_positions[t.a], b = instance.world_positions[t.b], c = instance.world_positions[t.c];
  } else {
    a = instance.transform.point(mesh.positions[t.a]);
    b = instance.transform.point(mesh.positions[t.b]);
    c = instance.transform.point(mesh.positions[t.c]);
  }
  const Vec3 e1 = b - a, e2 = c - a;
  s.p = a + e1 * u + e2 * v;
  s.margin = flat ? margin_of(largest(a, b, c))
                  : margin_of(std::max({instance.transform.magnitude(mesh.positions[t.a]),
                                        instance.transform.magnitude(mesh.positions[t.b]),
                                        instance.transform.magnitude(mesh.positions[t.c])}));
  Vec3 n = cross(e1, e2) * instance.handedness;
  const float n2 = length_squared(n);
  if (!(n2 > 0)) return false;
  s.ng = n * (1 / std::sqrt(n2));
  s.ns = s.ng;
  if (!mesh.normals.empty()) {
    Vec3 ns = mesh.normals[t.a] * (1 - u - v) + mesh.normals[t.b] * u + mesh.normals[t.c] * v;
    if (!instance.identity) ns = instance.inverse.transposed(ns);
    const float l2 = length_squared(ns);
    if (l2 > 0) {
      s.ns = ns * (1 / std::sqrt(l2));
      if (dot(s.ns, s.ng) < 0) s.ng = -s.ng;  // the front is the side the normals point to
    }
  }
  return true;
}

double Scene::triangle_area(uint32_t instance, uint32_t primitive) const {
  const Instance& i = instances_[instance];
  const Triangle t = i.mesh->triangles[primitive];
  const auto corner = [&](uint32_t v) {
    return Imath::V3d(i.world_positions.empty() ? i.transform.point(i.mesh->positions[v]) : i.world_positions[v]);
  };
  const Imath::V3d a = corner(t.a);
  return 0.5 * (corner(t.b) - a).cross(corner(t.c) - a).length();
}

bool Scene::surface(const Ray& ray, const Hit& hit, Surface& s) const {
  const Instance& instance = instances_[hit.instance];
  return instance.end ? surface_of(instance.at(hit.time), ray, hit, s) : surface_of(instance, ray, hit, s);
}

bool Scene::surface_of(const Instance& instance, const Ray& ray, const Hit& hit, Surface& s) const {
  s.material = instance.material;
  s.light = instance.light;
  s.primitive = hit.primitive;
  s.reflectance = instance.material->reflectance;
  if (instance.mesh) return triangle_surface(instance, hit.primitive, hit.u, hit.v, s);
  if (instance.curves) return curve_surface(instance, ray, hit, s);
  const Vec3 n = ray.origin + ray.direction * hit.t - instance.center;
  const float n2 = length_squared(n);
  if (!(n2 > 0)) return false;
  s.ng = s.ns = n * (1 / std::sqrt(n2));
  s.p = instance.center + s.ng * instance.radius;
  s.margin = margin_of_sphere(instance.center, instance.radius);
  return true;
}

}  // namespace bdpt
