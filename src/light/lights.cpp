#include "light/lights.h"

#include "geometry/texture.h"
#include "light/kinds.h"
#include "light/texel_table.h"
#include "light/textured_mesh.h"

#include <limits>

namespace bdpt {

void Lights::add(const Light& light) {
  const LightKind& kind = kind_of(light);
  const int index = int(lights_.size());
  any_hittable_ = any_hittable_ || kind.hittable;
  all_hittable_ = all_hittable_ && kind.hittable;
  if (kind.infinite) infinite_.push_back(index);
  if (kind.infinite && kind.hittable) hittable_infinite_.push_back(index);
  lights_.push_back(light);
}

void Lights::add_mesh(const AreaLight& area, Light& light) {
  if (area.texture) {
    auto mesh = std::make_unique<TexturedMesh>(area.triangles, area.uv, area.texture, area.sampler);
    meshes_.add(area.triangles, mesh->weights(), light);
    mesh->place_among(meshes_, light.first);
    light.kind = LightKindId::TexturedMesh;
    light.data = mesh.get();
    data_.push_back(std::move(mesh));
    return;
  }
  std::vector<double> areas;
  for (const LightTriangle& t : area.triangles) areas.push_back(t.area());
  meshes_.add(area.triangles, areas, light);
  light.data = &meshes_;
}

void Lights::build(const std::vector<AreaLight>& areas, const std::vector<LightDesc>& others, const Vec3& center,
                   float radius) {
  center_ = center;
  radius_ = std::max(radius, 1e-6f);
  for (const AreaLight& a : areas) {
    Light light;
    light.kind = a.is_sphere ? LightKindId::Sphere : LightKindId::Mesh;
    light.two_sided = a.two_sided;
    light.group = uint8_t(a.group);
    light.radiance = a.radiance;
    light.exponent = a.exponent;
    light.inverse_area = 1 / a.area;
    light.center = a.center;
    light.radius = a.radius;
    if (!a.is_sphere) add_mesh(a, light);
    add(light);
  }
  for (const LightDesc& o : others) {
    Light light;
    light.group = uint8_t(o.group);
    light.center = center_;
    light.radius = radius_;
    data_.push_back(make_light(o, light));
    light.data = data_.back().get();
    add(light);
  }
  std::vector<double> power;
  for (const Light& l : lights_) power.push_back(kind_of(l).power(l));
  by_power_ = Discrete(power);
  uint32_t emitter = 0;
  for (size_t i = 0; i < lights_.size(); ++i) {
    Light& l = lights_[i];
    if (!by_power_.empty()) l.choice = by_power_.probability(i);
    l.first_emitter = emitter;
    emitter += kind_of(l).is_mesh ? l.triangles : kind_of(l).infinite ? 0 : 1;
  }
}

uint64_t Lights::table_bytes(const std::vector<LightDesc>& lights) {
  uint64_t bytes = 0;
  for (const LightDesc& l : lights)
    if (l.texture) bytes += (l.has_position() ? 1 : 2) * TexelTable::memory_of(l.texture->width(), l.texture->height());
  return bytes;
}

int Lights::choose(double& u, const LightChoice& by) const {
  if (by.table) return int(by.table->sample(u));
  if (!by.uniform) return int(by_power_.sample(u));
  u *= double(lights_.size());
  const int light = int(u);
  u -= light;
  return light;
}

float Lights::choice(int light, const LightChoice& by) const {
  if (by.table) return by.table->probability(size_t(light));
  return by.uniform ? 1.0f / float(lights_.size()) : at(light).choice;
}

LightPoint Lights::point_of(int light) const {
  const LightKind& kind = kind_of(at(light));
  LightPoint y0;
  y0.light = light;
  y0.infinite = kind.infinite;
  y0.has_area = kind.has_area;
  y0.hittable = kind.hittable;
  return y0;
}

bool Lights::start(const float u[4], const float v[3], const LightChoice& by, LightStart& start) const {
  if (empty()) return false;
  double rest = join(u[0], u[3]);
  const int light = choose(rest, by);
  const float chosen = choice(light, by);
  const Light& l = at(light);
  const LightKind& kind = kind_of(l);
  start.y0 = point_of(light);
  const uint32_t triangle = choose_triangle(light, rest);
  kind.start(l, {{rest, triangle, u[1], u[2]}, v[0], v[1], v[2]}, start);
  start.density_position = chosen * kind.position_density(l, start.y0);
  start.density_direction = kind.direction_density(l, start.y0, start.origin, start.direction);
  const Rgb emitted = kind.emitted(l, start.y0, start.direction);
  // What is rounded outward, at the very edge, has no density and carries nothing.
  const float density = start.density_position * start.density_direction;
  start.weight = is_black(emitted) || !(start.density_direction > 0) ? Rgb() : emitted * (1 / density);
  return true;
}

bool Lights::place_direct(int light, const PlaceNumbers& u, const Vec3& x, DirectLight& direct) const {
  LightPoint& y0 = direct.y0;
  y0 = point_of(light);
  const Light& l = at(light);
  const LightKind& kind = kind_of(l);
  kind.place(l, u, x, y0);
  if (kind.infinite) {
    direct.direction = y0.normal;
    direct.distance = std::numeric_limits<float>::infinity();
    direct.radiance = kind.emitted(l, y0, -y0.normal);
    return !is_black(direct.radiance);
  }
  const Vec3 to_light = y0.p - x;
  direct.radiance = kind.emitted(l, y0, -to_light);
  const float d2 = length_squared(to_light);
  if (is_black(direct.radiance) || !(d2 > 0)) return false;
  direct.distance = std::sqrt(d2);
  direct.direction = to_light * (1 / direct.distance);
  return true;
}

float Lights::disk_distance(const Vec3& p, const Vec3& w) const {
  const Vec3 from = p - center_;
  const float along = dot(from, w);
  return length_squared(from - w * along) < radius_ * radius_ ? radius_ - along : 0;
}

std::vector<Emitter> Lights::emitters() const {
  std::vector<Emitter> all;
  for (uint32_t light = 0; light < lights_.size(); ++light) {
    const Light& l = lights_[light];
    if (kind_of(l).infinite) continue;
    for (uint32_t k = 0; k < (kind_of(l).is_mesh ? l.triangles : 1); ++k) {
      all.push_back(kind_of(l).bounds(l, l.first + k));
      all.back().light = light;
    }
  }
  return all;
}

}  // namespace bdpt
