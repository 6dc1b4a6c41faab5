// What textures and vertex colours make of a surface.
#include "scene/scene.h"

namespace bdpt {

namespace {

// How the point of a triangle moves with its texture coordinates; false where they do not vary.
bool derivatives(const Vec3& e1, const Vec3& e2, const Vec2& d1, const Vec2& d2, Vec3& dp_du, Vec3& dp_dv) {
  const float det = d1.x * d2.y - d1.y * d2.x;
  if (det == 0) return false;
  dp_du = (e1 * d2.y - e2 * d1.y) * (1 / det);
  dp_dv = (e2 * d1.x - e1 * d2.x) * (1 / det);
  return true;
}

// Where a height is looked up, of four: a step along u and back, and along v and back.
constexpr uint32_t kBumpSides = 4;
Vec2 bump_side(uint32_t number, const Vec2& step) {
  const float sign = number % 2 == 0 ? 1.0f : -1.0f;
  return number < 2 ? Vec2(sign * step.x, 0) : Vec2(0, sign * step.y);
}

}  // namespace

Vec2 Scene::uv_at(const Instance& instance, int set, const Hit& hit, const Vec3& ng) const {
  if (instance.mesh) return instance.mesh->uv_at(set, hit.primitive, hit.u, hit.v);
  if (instance.curves) return Vec2(instance.curves->along(hit.primitive, hit.u), 0);
  return uv_of_sphere(unit(instance.transform.transposed(ng)));
}

bool Scene::uv_frame(const Instance& instance, int set, const Hit& hit, const Vec3& ng, UvFrame& frame) const {
  frame.uv = uv_at(instance, set, hit, ng);
  if (instance.sphere) {
    const Vec3 n = unit(instance.transform.transposed(ng));
    const float ring = std::sqrt(n.x * n.x + n.y * n.y);
    if (ring == 0) return false;
    const float radius = instance.sphere->radius;
    frame.dp_du = instance.transform.vector(Vec3(-n.y, n.x, 0) * (kTwoPi * radius));
    frame.dp_dv = instance.transform.vector(Vec3(-n.x * n.z, -n.y * n.z, ring * ring) * (kPi * radius / ring));
    return true;
  }
  if (instance.curves) return false;  // nothing varies across a curve; its direction is the surface's tangent
  const Mesh& mesh = *instance.mesh;
  const Triangle t = mesh.triangles[hit.primitive];
  const auto corner = [&](uint32_t i) {
    return instance.world_positions.empty() ? instance.transform.point(mesh.positions[i]) : instance.world_positions[i];
  };
  const Vec3 a = corner(t.a);
  Vec2 uv[3];
  mesh.uv_corners(set, hit.primitive, uv);
  return derivatives(corner(t.b) - a, corner(t.c) - a, uv[1] - uv[0], uv[2] - uv[0], frame.dp_du, frame.dp_dv);
}

bool Scene::uv_frame(const Instance& instance, const TextureUse& use, const Hit& hit, const Vec3& ng,
                     UvFrame& frame) const {
  UvFrame mesh_frame{Vec2(0), Vec3(0), Vec3(0)};
  const bool varies = uv_frame(instance, use.uv.set, hit, ng, mesh_frame);
  frame.uv = use.uv(mesh_frame.uv);
  // The chain rule with the inverse of their map.
  const float* m = use.uv.m;
  const float det = m[0] * m[4] - m[1] * m[3];
  frame.dp_du = (mesh_frame.dp_du * m[4] - mesh_frame.dp_dv * m[3]) * (1 / det);
  frame.dp_dv = (mesh_frame.dp_dv * m[0] - mesh_frame.dp_du * m[1]) * (1 / det);
  return varies;
}

Vec2 Scene::step_of(const TextureUse& use) const {
  if (use.is_hosts) return desc_.host_textures[size_t(use.texture)]->step;
  const Texture& texture = *desc_.textures[size_t(use.texture)];
  return Vec2(1 / float(texture.width()), 1 / float(texture.height()));
}

void Scene::bend_normal(const Instance& instance, const TextureUse& use, const Hit& hit, const Rgba* answers,
                        Surface& s) const {
  UvFrame uv_frame_of_use;
  const bool varies = uv_frame(instance, use, hit, s.ng, uv_frame_of_use);
  const Vec2 uv = uv_frame_of_use.uv;
  const Vec3 dp_du = uv_frame_of_use.dp_du, dp_dv = uv_frame_of_use.dp_dv;
  // Answer `number` of the host's, or that of an image.
  const auto look_up = [&](const Vec2& place, uint32_t number) {
    return use.is_hosts ? answers[use.answer + number]
                        : desc_.textures[size_t(use.texture)]->lookup(place, use.sampler);
  };
  if (use.slot == Slot::Bump) {
    if (!varies) return;
    const Vec2 step = step_of(use);
    const auto height = [&](uint32_t number) { return look_up(uv + bump_side(number, step), number)[use.channel]; };
    const float dh_du = use.scale * (height(0) - height(1)) / (2 * step.x),
                dh_dv = use.scale * (height(2) - height(3)) / (2 * step.y);
    // The gradient g in the plane of the normal: g dp_du = dh_du, g dp_dv = dh_dv.
    const float volume = dot(s.ns, cross(dp_du, dp_dv));
    if (volume == 0) return;
    const Vec3 gradient = (cross(dp_dv, s.ns) * dh_du + cross(s.ns, dp_du) * dh_dv) * (1 / volume);
    s.ns = unit(s.ns - gradient);
    return;
  }
  Vec3 t;
  float sign;
  if (instance.mesh && !instance.mesh->tangents.empty()) {
    const Triangle k = instance.mesh->triangles[hit.primitive];
    const View<Tangent>& tangents = instance.mesh->tangents;
    const Tangent a = tangents[k.a], b = tangents[k.b], c = tangents[k.c];
    t = instance.transform.vector(a.direction * (1 - hit.u - hit.v) + b.direction * hit.u + c.direction * hit.v);
    sign = a.sign * instance.handedness;
  } else {
    if (!varies) return;
    t = dp_du;
    sign = dot(cross(s.ns, dp_du), dp_dv) < 0 ? -1.0f : 1.0f;
  }
  const Frame frame(s.ns, t);
  const Rgba texel = look_up(uv, 0);
  const Vec3 n((2 * texel[0] - 1) * use.scale, sign * (2 * texel[1] - 1) * use.scale, 2 * texel[2] - 1);
  if (n.z > 0) s.ns = unit(frame.to_world(n));
}

// Textures that multiply numbers; `own` is where they are multiplied, the reflectance apart.
void Scene::vary(const MaterialDesc& material, const Instance& instance, const Hit& hit, const Vec3& ng,
                 const Rgba* answers, Rgb& reflectance, Material* own) const {
  for (const TextureUse& use : material.textures) {
    if (use.slot == Slot::Normal || use.slot == Slot::Bump || use.slot == Slot::Emission) continue;
    const Rgba texel = use.is_hosts ? answers[use.answer]
                                    : desc_.textures[size_t(use.texture)]->lookup(
                                          use.uv(uv_at(instance, use.uv.set, hit, ng)), use.sampler);
    const float number = use.squared ? sqr(texel[use.channel]) : texel[use.channel];
    switch (use.slot) {
      case Slot::Reflectance:
        reflectance *= to_rgb(texel);
        break;
      case Slot::Roughness:
        own->alpha_u *= number;
        own->alpha_v *= number;
        break;
      case Slot::DiffuseRoughness:
        own->diffuse_roughness *= number;
        break;
      case Slot::Transmittance:
        own->transmittance *= to_rgb(texel);
        break;
      case Slot::Metalness:
        own->metalness *= number;
        break;
      case Slot::Specular:
        own->specular *= number;
        break;
      case Slot::SpecularColor:
        own->specular_color *= to_rgb(texel);
        break;
      case Slot::Coat:
        own->coat *= number;
        break;
      case Slot::CoatRoughness:
        own->coat_alpha *= number;
        break;
      case Slot::Sheen:
        own->sheen *= to_rgb(texel);
        break;
      case Slot::SheenRoughness:
        own->sheen_alpha *= number;
        break;
      case Slot::Transmission:
        own->transmission *= number;
        break;
      case Slot::DiffuseTransmission:
        own->diffuse_transmission *= number;
        break;
      case Slot::Anisotropy: {
        own->anisotropy *= texel[2];
        const float x = 2 * texel[0] - 1, y = 2 * texel[1] - 1, l = std::sqrt(x * x + y * y);
        if (!(l > 0)) break;
        const float c = own->tangent_cos, d = own->tangent_sin;
        own->tangent_cos = (c * x - d * y) / l;
        own->tangent_sin = (d * x + c * y) / l;
        break;
      }
      case Slot::Mix:
        own->mix *= number;
        break;
      case Slot::Film:
        own->film *= number;
        break;
      case Slot::FilmThickness:
        own->film_thickness =
            material.least_film_thickness + (own->film_thickness - material.least_film_thickness) * number;
        break;
      case Slot::Normal:
      case Slot::Bump:
      case Slot::Emission:  // the light's own
        break;
    }
  }
}

// One of the two that a mix is made of: the scene's, or a copy whose numbers are those of the place.
const Material* Scene::part(const MaterialDesc& mix, int index, const Instance& instance, const Hit& hit,
                            const Vec3& ng, const Rgba* answers, MaterialStore& store) const {
  const MaterialDesc& material = desc_.materials[size_t(mix.mixed[index])];
  if (material.textures.empty()) return &material;
  Material& own = store.add(material);
  vary(material, instance, hit, ng, answers, own.reflectance, &own);
  return &own;
}

void Scene::shade(const Hit& hit, Surface& s, MaterialStore& store, const Rgba* answers) const {
  const Instance& instance = instances_[hit.instance];
  if (instance.is_plain) return;
  instance.end ? shade_as(instance.at(hit.time), hit, s, store, answers) : shade_as(instance, hit, s, store, answers);
}

void Scene::shade_as(const Instance& instance, const Hit& hit, Surface& s, MaterialStore& store,
                     const Rgba* answers) const {
  const MaterialDesc& material = *instance.material;
  if (instance.mesh && !instance.mesh->colors.empty())
    s.reflectance *= to_rgb(instance.mesh->color(hit.primitive, hit.u, hit.v));
  const Vec3 ng = s.ng;
  if (instance.varies) {
    Material& own = store.add(material);
    s.material = &own;
    vary(material, instance, hit, ng, answers, s.reflectance, &own);
    if (material.type == MaterialType::Mix) {
      const Rgba* of_part = answers + material.answers;
      for (int i = 0; i < 2; ++i) {
        own.parts[i] = part(material, i, instance, hit, ng, of_part, store);
        of_part += desc_.materials[size_t(material.mixed[i])].answers;
      }
    }
  } else {
    vary(material, instance, hit, ng, answers, s.reflectance, nullptr);
  }
  for (const TextureUse& use : material.textures)
    if (use.slot == Slot::Normal || use.slot == Slot::Bump) bend_normal(instance, use, hit, answers, s);
  if (!s.material->is_anisotropic() || instance.curves) return;
  UvFrame frame;
  if (uv_frame(instance, 0, hit, s.ng, frame))
    s.tangent = frame.dp_du;
  else
    s.tangent = Vec3(0);
}

// --- The host's textures ---

void Scene::number_answers() {
  for (MaterialDesc& material : desc_.materials)
    for (TextureUse& use : material.textures) {
      if (!use.is_hosts) continue;
      use.answer = material.answers;
      material.answers += use.slot == Slot::Bump ? kBumpSides : 1;
    }
}

bool Scene::asks_host(const MaterialDesc& material) const {
  if (material.answers > 0) return true;
  return material.type == MaterialType::Mix && (desc_.materials[size_t(material.mixed[0])].answers > 0 ||
                                                desc_.materials[size_t(material.mixed[1])].answers > 0);
}

void Scene::gather(const Ray& ray, const Hit& hit, HostLookups& lookups) const {
  lookups.add_hit();
  if (hit.instance == kMiss || !instances_[hit.instance].asks_host) return;
  const Instance& instance = instances_[hit.instance];
  instance.end ? gather_as(instance.at(hit.time), ray, hit, lookups) : gather_as(instance, ray, hit, lookups);
}

void Scene::gather_as(const Instance& instance, const Ray& ray, const Hit& hit, HostLookups& lookups) const {
  Surface surface;
  if (!surface_of(instance, ray, hit, surface)) return;
  const MaterialDesc& material = *instance.material;
  gather(material, instance, hit, surface, lookups);
  for (int i = 0; i < 2 && material.type == MaterialType::Mix; ++i)
    gather(desc_.materials[size_t(material.mixed[i])], instance, hit, surface, lookups);
}

// As many places as the material has answers, in their order.
void Scene::gather(const MaterialDesc& material, const Instance& instance, const Hit& hit, const Surface& surface,
                   HostLookups& lookups) const {
  const uint64_t id = desc_.instances[hit.instance].id;
  for (const TextureUse& use : material.textures) {
    if (!use.is_hosts) continue;
    if (use.slot != Slot::Bump) {
      const Vec2 uv = use.uv(uv_at(instance, use.uv.set, hit, surface.ng));
      lookups.add(size_t(use.texture), {uv, surface.p, id});
      continue;
    }
    UvFrame frame;
    uv_frame(instance, use, hit, surface.ng, frame);
    for (uint32_t i = 0; i < kBumpSides; ++i) {
      const Vec2 side = bump_side(i, step_of(use));
      lookups.add(size_t(use.texture), {frame.uv + side, surface.p + frame.dp_du * side.x + frame.dp_dv * side.y, id});
    }
  }
}

}  // namespace bdpt
