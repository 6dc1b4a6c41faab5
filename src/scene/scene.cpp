#include "scene/scene.h"

#include "geometry/margin.h"
#include "light/photometry.h"
#include "math/box.h"
#include "sampling/hash.h"

#include <array>
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

// Those that the first four kinds do not have; what is left at its default adds nothing.
template <class Add>
void add_numbers(const MaterialDesc& m, const Add& add) {
  const auto numbers = [](const MaterialDesc& d) {
    return std::array{d.diffuse_roughness,
                      d.transmittance.r,
                      d.transmittance.g,
                      d.transmittance.b,
                      d.coat,
                      d.coat_ior,
                      d.coat_alpha,
                      d.metalness,
                      d.specular,
                      d.specular_color.r,
                      d.specular_color.g,
                      d.specular_color.b,
                      d.sheen.r,
                      d.sheen.g,
                      d.sheen.b,
                      d.sheen_alpha,
                      d.transmission,
                      d.diffuse_transmission,
                      d.anisotropy,
                      d.tangent_cos,
                      d.tangent_sin,
                      d.mix,
                      float(d.mixed[0]),
                      float(d.mixed[1]),
                      float(d.thin_walled),
                      float(d.single_scattering)};
  };
  const auto own = numbers(m);
  if (own != numbers(MaterialDesc())) add(own);
}

uint64_t hash_scene(const SceneDesc& desc) {
  uint64_t h = hash_values(desc.shapes.size(), desc.instances.size());
  const auto add = [&](const auto& value) { h = hash_bytes(&value, sizeof(value), h); };
  for (const Shape& s : desc.shapes) {
    if (s.mesh) {
      h = hash_combine(h, s.mesh->content_hash);
    } else {
      add(s.sphere->center);
      add(s.sphere->radius);
    }
  }
  for (const auto& t : desc.textures) h = hash_combine(h, t ? t->content_hash() : 0);
  for (const MaterialDesc& m : desc.materials) {
    const float numbers[] = {m.reflectance.r, m.reflectance.g, m.reflectance.b, m.eta.r,      m.eta.g,
                             m.eta.b,         m.k.r,           m.k.g,           m.k.b,        m.ior,
                             m.alpha_u,       m.alpha_v,       m.emission.r,    m.emission.g, m.emission.b};
    add(numbers);
    h = hash_combine(h, hash_values(int(m.type), m.one_sided, m.emission_two_sided));
    if (m.emission_group > 0) h = hash_combine(h, m.emission_group);
    add_numbers(m, add);
    const auto add_lookup = [&](int texture, int channel, const UvMap& uv, const TextureSampler& s) {
      add(uv.m);
      add(s.level);
      h = hash_combine(h, hash_values(texture, channel, uv.set, int(s.wrap_u), int(s.wrap_v), int(s.filter)));
    };
    for (const TextureUse& use : m.textures) {
      add_lookup(use.texture, use.channel, use.uv, use.sampler);
      add(use.scale);
      h = hash_combine(h, hash_values(int(use.slot), use.squared));
    }
    if (m.interior >= 0 || m.priority > 0) h = hash_combine(h, hash_values(m.interior, m.priority));
    if (m.opacity.mode != Opacity::Mode::Opaque) {
      const Opacity& o = m.opacity;
      add(o.value);
      add(o.cutoff);
      h = hash_combine(h, uint64_t(o.mode));
      add_lookup(o.texture, o.channel, o.uv, o.sampler);
    }
    if (m.emission_exponent != 0) add(m.emission_exponent);
  }
  for (const auto& medium : desc.media) {
    const float numbers[] = {medium->sigma_a.r, medium->sigma_a.g, medium->sigma_a.b, medium->sigma_s.r,
                             medium->sigma_s.g, medium->sigma_s.b, medium->g};
    add(numbers);
  }
  if (desc.outside >= 0) h = hash_combine(h, uint64_t(desc.outside));
  for (const LightDesc& l : desc.lights) {
    const float numbers[] = {l.position.x,  l.position.y,  l.position.z,  l.direction.x, l.direction.y,
                             l.direction.z, l.intensity.r, l.intensity.g, l.intensity.b, l.radiance.r,
                             l.radiance.g,  l.radiance.b,  l.cos_outer,   l.cos_inner};
    add(numbers);
    h = hash_combine(h, uint64_t(l.type));
    if (l.group > 0) h = hash_combine(h, l.group);
    if (l.type == LightType::Directional) {
      add(l.irradiance);
      add(l.angular_radius);
    }
    if (l.texture) {
      h = hash_combine(h, l.texture->content_hash());
      add(l.transform.m);
    }
    if (l.photometry) h = hash_combine(h, l.photometry->hash());
    if (l.photometry || l.texture) add(l.up);
    for (const Portal& p : l.portals) {
      add(p.corner);
      add(p.edge_u);
      add(p.edge_v);
    }
  }
  for (const InstanceDesc& i : desc.instances) {
    add(i.transform.m);
    h = hash_combine(h, hash_values(i.shape, i.material));
    if (i.invisible) h = hash_combine(h, 1);
    if (i.moves) add(i.end.m);
  }
  return h;
}

}  // namespace

Scene::Scene(SceneDesc desc, const std::shared_ptr<const RayDevice>& device, const std::shared_ptr<MemoryMeter>& meter,
             const Progress& progress)
    : desc_(std::move(desc)) {
  if (desc_.instances.empty() && desc_.lights.empty())
    fail(ErrorCode::InvalidArgument, "the builder holds no instance and no light; add some before building");

  for (MaterialDesc& m : desc_.materials)
    for (int i = 0; i < 2 && m.type == MaterialType::Mix; ++i) m.parts[i] = &desc_.materials[size_t(m.mixed[i])];

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
    geometries[i] = {instance.mesh, instance.sphere,       instance.transform, instance.end, instance.world_positions,
                     false,         opacity_test(instance)};
    if (instance.mesh && instance.world_positions.empty()) {
      geometries[i].instanced = true;
      geometries[i].world_positions = object_positions(*instance.mesh);
    }
  }
  rays_ = std::make_unique<RayScene>(device, geometries, progress);
  info_.memory_embree = device->memory() > before ? device->memory() - before : 0;
  info_.memory = info_.memory_embree + booking_.bytes() + light_booking_.bytes();
  for (const Shape& s : desc_.shapes)
    if (s.mesh) info_.memory += s.mesh->memory;
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
  opacity_tests_.push_back(std::make_unique<const OpacityTest>(OpacityTest{
      opacity, texture, instance.mesh, instance.transform, instance.end ? *instance.end : instance.transform}));
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
  for (const InstanceDesc& d : desc_.instances) {
    Instance instance;
    const Shape& shape = desc_.shapes[size_t(d.shape)];
    instance.material = &desc_.materials[size_t(d.material)];
    instance.is_plain = instance.material->textures.empty() && !instance.material->is_anisotropic() &&
                        !(shape.mesh && !shape.mesh->colors.empty());
    instance.varies = varies(*instance.material);
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

void Scene::collect_lights() {
  Box box;
  std::unordered_map<const Mesh*, Box> boxes;  // of meshes that instances share
  std::vector<Lights::AreaLight> areas;
  for (size_t i = 0; i < instances_.size(); ++i) {
    Instance& instance = instances_[i];
    const bool emits = !is_black(instance.material->emission);
    if (emits && desc_.instances[i].invisible)
      fail(ErrorCode::InvalidArgument, "instance \"", desc_.instances[i].label,
           "\" is invisible, but its material emits light, which no ray could find: make it visible, or give it "
           "another material");
    Lights::AreaLight light;
    light.instance = int(i);
    light.radiance = instance.material->emission;
    light.exponent = instance.material->emission_exponent;
    light.two_sided = instance.material->emission_two_sided;
    light.group = instance.material->emission_group;
    const TextureUse* use = emits ? emission_use(*instance.material) : nullptr;
    if (use && instance.sphere)
      fail(ErrorCode::InvalidArgument, "instance \"", desc_.instances[i].label,
           "\" is a sphere, but its material has a texture of slot EMISSION, which shines from meshes alone: use a "
           "mesh, or a material without it");
    if (use) {
      light.texture = desc_.textures[size_t(use->texture)];
      light.sampler = use->sampler;
    }
    if (emits && instance.end)
      fail(ErrorCode::InvalidArgument, "instance \"", desc_.instances[i].label,
           "\" moves, but its material emits light: let it stand still, or give it another material");
    if (instance.sphere) {
      box.grow(instance.center, instance.radius);
      if (instance.end) {
        const Instance there = instance.at(1);
        box.grow(there.center, there.radius);
      }
    } else if (!instance.world_positions.empty()) {
      box.grow(box_of(*instance.mesh, instance.world_positions));
    } else {
      const auto [known, is_new] = boxes.try_emplace(instance.mesh);
      if (is_new) known->second = box_of(*instance.mesh, instance.mesh->positions);
      for (const Vec3& corner : known->second.corners()) {
        box.grow(instance.transform.point(corner));
        if (instance.end) box.grow(instance.end->point(corner));
      }
    }
    if (!emits) continue;
    if (instance.sphere) {
      light.is_sphere = true;
      light.center = instance.center;
      light.radius = instance.radius;
      light.area = 4 * kPi * instance.radius * instance.radius;
    } else {
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
    }
    if (light.area > 0) {
      instance.light = int(areas.size());
      areas.push_back(std::move(light));
    }
  }
  for (const LightDesc& l : desc_.lights)
    if (l.has_position() && box.empty()) box.grow(l.position);
  if (box.empty()) box.grow(Vec3(0));
  info_.bounds_min = box.low;
  info_.bounds_max = box.high;
  lights_.build(areas, desc_.lights, (box.low + box.high) * 0.5f, 0.5f * length(box.high - box.low));
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
  if (!instance.sphere) return triangle_surface(instance, hit.primitive, hit.u, hit.v, s);
  const Vec3 n = ray.origin + ray.direction * hit.t - instance.center;
  const float n2 = length_squared(n);
  if (!(n2 > 0)) return false;
  s.ng = s.ns = n * (1 / std::sqrt(n2));
  s.p = instance.center + s.ng * instance.radius;
  s.margin = margin_of_sphere(instance.center, instance.radius);
  return true;
}

}  // namespace bdpt
