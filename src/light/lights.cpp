#include "light/lights.h"

#include "geometry/margin.h"
#include "sampling/warp.h"

#include <limits>

namespace bdpt {

namespace {

// 1 - cos of the half-angle under which a sphere appears from a distance d > r, safe for small angles.
float one_minus_cos_cap(float radius, float d2) {
  const float sin2 = std::min(1.0f, radius * radius / d2);
  return sin2 / (1 + safe_sqrt(1 - sin2));
}

// The point of a sphere where its normal is n.
void place_on_sphere(const Vec3& center, float radius, const Vec3& n, LightPoint& y0) {
  y0.normal = n;
  y0.p = center + n * radius;
  y0.margin = margin_of_sphere(center, radius);
}

// Whether x sees a sphere as a cap from outside. Points on the sphere itself, rounded to either side, do not. One
// function, never inlined: sampling and density must not round differently.
[[gnu::noinline]] bool sees_cap(const Vec3& center, float radius, const Vec3& x) {
  return length_squared(center - x) > radius * radius * 1.0001f;
}

// A point of a sphere, within what x sees of it.
void place_on_visible_sphere(const Vec3& center, float radius, const Vec3& x, float u0, float u1, LightPoint& y0) {
  const Vec3 to_center = center - x;
  const float d2 = length_squared(to_center);
  if (!sees_cap(center, radius, x)) return place_on_sphere(center, radius, sample_sphere(u0, u1), y0);
  const Vec3 local = sample_cone(u0, u1, one_minus_cos_cap(radius, d2));
  const Vec3 w = Frame(to_center * (1 / std::sqrt(d2))).to_world(local);
  const float sin2 = 1 - local.z * local.z;
  const float t = std::sqrt(d2) * local.z - safe_sqrt(radius * radius - d2 * sin2);
  place_on_sphere(center, radius, unit(x + w * t - center), y0);
}

double power_of_area(const Lights::AreaLight& a) {
  return double(norm(a.radiance)) * kPi * a.area * (a.two_sided ? 2 : 1);
}

}  // namespace

void Lights::add_area(const AreaLight& area) {
  Light light;
  light.kind = area.is_sphere ? Kind::Sphere : Kind::Triangles;
  light.two_sided = area.two_sided;
  light.group = uint8_t(area.group);
  light.radiance = area.radiance;
  light.inverse_area = 1 / area.area;
  light.center = area.center;
  light.radius = area.radius;
  light.first = uint32_t(triangles_.size());
  light.triangles = uint32_t(area.triangles.size());
  lights_.push_back(light);
  double total = 0, sum = 0;
  for (const LightTriangle& t : area.triangles) total += t.area();
  for (LightTriangle t : area.triangles) {
    t.below = sum / total;
    sum += t.area();
    triangles_.push_back(t);
  }
  const LightTriangle* triangle = &triangles_[light.first];
  for (uint32_t k = 0, i = 0; k < light.triangles; ++k) {
    while (i + 1 < light.triangles && triangle[i + 1].below <= double(k) / light.triangles) ++i;
    guide_.push_back(i);
  }
}

void Lights::build(const std::vector<AreaLight>& areas, const std::vector<LightDesc>& others, const Vec3& center,
                   float radius) {
  others_ = others;
  center_ = center;
  radius_ = std::max(radius, 1e-6f);
  std::vector<double> power;
  for (const AreaLight& a : areas) {
    power.push_back(power_of_area(a));
    add_area(a);
    any_hittable_ = true;
  }
  for (size_t i = 0; i < others_.size(); ++i) {
    const LightDesc& o = others_[i];
    Light light;
    light.first = uint32_t(i);
    light.group = uint8_t(o.group);
    switch (o.type) {
      case LightType::Point:
        all_hittable_ = false;
        power.push_back(4.0 * kPi * norm(o.intensity));
        break;
      case LightType::Spot:
        all_hittable_ = false;
        light.kind = Kind::Spot;
        power.push_back(2.0 * kPi * norm(o.intensity) * (1 - 0.5 * (double(o.cos_inner) + o.cos_outer)));
        break;
      case LightType::Environment:
        light.kind = Kind::Environment;
        power.push_back(4.0 * kPi * kPi * double(radius_) * radius_ * norm(o.radiance));
        environment_ = int(lights_.size());
        environment_radiance_ = o.radiance;
        any_hittable_ = true;
        break;
    }
    lights_.push_back(light);
  }
  by_power_ = Discrete(power);
  uint32_t emitter = 0;
  for (size_t i = 0; i < lights_.size(); ++i) {
    if (!by_power_.empty()) lights_[i].choice = by_power_.probability(i);
    lights_[i].first_emitter = emitter;
    emitter += emitter_count(int(i));
  }
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

float Lights::spot_falloff(const LightDesc& spot, const Vec3& w) const {
  const float c = dot(w, spot.direction) / length(w);
  if (c <= spot.cos_outer) return 0;
  if (c >= spot.cos_inner) return 1;
  const float t = (c - spot.cos_outer) / (spot.cos_inner - spot.cos_outer);
  return t * t * (3 - 2 * t);
}

bool Lights::start(const float u[4], const float v[2], const LightChoice& by, LightStart& start) const {
  if (empty()) return false;
  double u0 = join(u[0], u[3]);
  const int light = choose(u0, by);
  const float chosen = choice(light, by);
  const Light& l = at(light);
  LightPoint& y0 = start.y0;
  y0 = LightPoint{};
  y0.light = light;
  switch (l.kind) {
    case Kind::Triangles:
    case Kind::Sphere: {
      y0.has_area = true;
      if (l.kind == Kind::Sphere) {
        place_on_sphere(l.center, l.radius, sample_sphere(u[1], u[2]), y0);
      } else {
        place_on_triangle(l, choose_triangle(light, u0), u[1], u[2], y0);
      }
      // A two-sided light takes a side by the first half of the direction's first number.
      float v0 = v[0];
      Vec3 n = y0.normal;
      if (l.two_sided) {
        v0 *= 2;
        if (v0 >= 1) v0 -= 1, n = -n;
      }
      start.direction = Frame(n).to_world(sample_cosine_hemisphere(v0, v[1]));
      start.origin = y0.p;
      start.density_position = chosen * l.inverse_area;
      start.density_direction = l.two_sided ? 0.5f * kInvPi : kInvPi;
      start.weight = l.radiance * (1 / (start.density_position * start.density_direction));
      return true;
    }
    case Kind::Point: {
      const LightDesc& o = other(l);
      y0.p = start.origin = o.position;
      start.direction = sample_sphere(v[0], v[1]);
      start.density_position = chosen;
      start.density_direction = 0.25f * kInvPi;
      start.weight = o.intensity * (4 * kPi / chosen);
      return true;
    }
    case Kind::Spot: {
      const LightDesc& o = other(l);
      y0.p = start.origin = o.position;
      start.direction = Frame(o.direction).to_world(sample_cone(v[0], v[1], 1 - o.cos_outer));
      start.density_position = chosen;
      start.density_direction = 1 / (kTwoPi * (1 - o.cos_outer));
      start.weight = o.intensity * (spot_falloff(o, start.direction) / (chosen * start.density_direction));
      return true;
    }
    case Kind::Environment: {
      y0.infinite = true;
      y0.normal = sample_sphere(u[1], u[2]);
      start.direction = -y0.normal;
      const Vec2 d = sample_disk(v[0], v[1]);
      const Frame frame(y0.normal);
      start.origin = center_ + (y0.normal + frame.t * d.x + frame.b * d.y) * radius_;
      start.density_position = chosen * 0.25f * kInvPi;
      start.density_direction = kInvPi / (radius_ * radius_);
      start.weight = environment_radiance_ * (1 / (start.density_position * start.density_direction));
      return true;
    }
  }
  return false;
}

uint32_t Lights::choose_triangle(int light, double& u) const {
  constexpr uint32_t kFew = 4;
  const Light& l = at(light);
  if (l.triangles < 2) return l.first;
  const LightTriangle* triangle = &triangles_[l.first];
  uint32_t k = l.triangles > kFew ? guide_[l.first + size_t(u * double(l.triangles))] : 0;
  while (k > 0 && triangle[k].below > u) --k;  // the table's place is rounded
  while (k + 1 < l.triangles && triangle[k + 1].below <= u) ++k;
  return l.first + k;
}

void Lights::place_on_triangle(const Light& light, uint32_t triangle, float u1, float u2, LightPoint& y0) const {
  const LightTriangle& t = triangles_[triangle];
  y0.primitive = triangle - light.first;
  const Vec2 b = sample_triangle(u1, u2);
  y0.p = t.corner + t.edge1 * b.x + t.edge2 * b.y;
  y0.normal = t.normal;
  y0.margin = t.margin;
}

bool Lights::place_direct(int index, uint32_t triangle, const Vec3& x, float u1, float u2, DirectLight& direct) const {
  LightPoint& y0 = direct.y0;
  y0 = LightPoint{};
  y0.light = index;
  const Light& l = at(index);
  switch (l.kind) {
    case Kind::Environment:
      y0.infinite = true;
      y0.normal = direct.direction = sample_sphere(u1, u2);
      direct.distance = std::numeric_limits<float>::infinity();
      direct.radiance = environment_radiance_;
      return true;
    case Kind::Triangles:
      y0.has_area = true;
      place_on_triangle(l, triangle, u1, u2, y0);
      break;
    case Kind::Sphere:
      y0.has_area = true;
      place_on_visible_sphere(l.center, l.radius, x, u1, u2, y0);
      break;
    case Kind::Point:
    case Kind::Spot:
      y0.p = other(l).position;
      break;
  }
  const Vec3 to_light = y0.p - x;
  direct.radiance = emitted(y0, -to_light);
  const float d2 = length_squared(to_light);
  if (is_black(direct.radiance) || !(d2 > 0)) return false;
  direct.distance = std::sqrt(d2);
  direct.direction = to_light * (1 / direct.distance);
  return true;
}

Rgb Lights::emitted(const LightPoint& y0, const Vec3& w) const {
  if (y0.has_area) return radiance(y0.light, y0.normal, w);
  const LightDesc& o = other(at(y0.light));
  return o.type == LightType::Spot ? o.intensity * spot_falloff(o, w) : o.intensity;
}

Rgb Lights::radiance(int light, const Vec3& normal, const Vec3& w) const {
  const Light& l = at(light);
  const float c = dot(normal, w);
  return c > 0 || (l.two_sided && c < 0) ? l.radiance : Rgb();
}

float Lights::direction_density(const LightPoint& y0, const Vec3& w) const {
  const Light& l = at(y0.light);
  switch (l.kind) {
    case Kind::Triangles:
    case Kind::Sphere:
      if (l.two_sided) return 0.5f * kInvPi;
      return dot(y0.normal, w) > 0 ? kInvPi : 0;
    case Kind::Point:
      return 0.25f * kInvPi;
    case Kind::Spot: {
      const LightDesc& o = other(l);
      return dot(w, o.direction) > o.cos_outer ? 1 / (kTwoPi * (1 - o.cos_outer)) : 0;
    }
    case Kind::Environment:
      return kInvPi / (radius_ * radius_);
  }
  return 0;
}

float Lights::disk_distance(const Vec3& p, const Vec3& w) const {
  const Vec3 from = p - center_;
  const float along = dot(from, w);
  return length_squared(from - w * along) < radius_ * radius_ ? radius_ - along : 0;
}

float Lights::position_density(const LightPoint& y0, const LightChoice& by) const {
  const float chosen = choice(y0.light, by) * at(y0.light).inverse_area;
  return y0.infinite ? chosen * 0.25f * kInvPi : chosen;
}

float Lights::direct_density(const LightPoint& y0, const Vec3& x, float chosen) const {
  if (y0.infinite) return chosen * 0.25f * kInvPi;
  if (!y0.has_area) return chosen;
  const Light& l = at(y0.light);
  if (l.kind != Kind::Sphere || !sees_cap(l.center, l.radius, x)) return chosen * l.inverse_area;
  const float center2 = length_squared(l.center - x);
  const Vec3 w = x - y0.p;
  const float d2 = length_squared(w);
  const float cos_y = dot(y0.normal, w) / std::sqrt(d2);
  if (!(cos_y > 0)) return 0;  // the far side is never chosen
  return chosen * cos_y / (kTwoPi * one_minus_cos_cap(l.radius, center2) * d2);
}

float Lights::direct_density_of_triangle(const LightPoint& y0, float chosen) const {
  const LightTriangle& t = triangles_[at(y0.light).first + y0.primitive];
  return chosen * 2 / length(cross(t.edge1, t.edge2));
}

uint32_t Lights::emitter_count(int light) const {
  const Light& l = at(light);
  return l.kind == Kind::Triangles ? l.triangles : l.kind == Kind::Environment ? 0 : 1;
}

std::vector<Emitter> Lights::emitters() const {
  std::vector<Emitter> all;
  for (uint32_t light = 0; light < lights_.size(); ++light) {
    const Light& l = lights_[light];
    if (l.kind == Kind::Environment) continue;
    if (l.kind != Kind::Triangles) {
      all.push_back(emitter_of(l));
      all.back().light = light;
      continue;
    }
    for (uint32_t k = 0; k < l.triangles; ++k) {
      const uint32_t triangle = l.first + k;
      const LightTriangle& t = triangles_[triangle];
      Emitter e;
      e.light = light, e.triangle = triangle;
      e.low = e.high = t.corner;
      for (const Vec3& corner : {t.corner + t.edge1, t.corner + t.edge2}) {
        e.low = Vec3(std::min(e.low.x, corner.x), std::min(e.low.y, corner.y), std::min(e.low.z, corner.z));
        e.high = Vec3(std::max(e.high.x, corner.x), std::max(e.high.y, corner.y), std::max(e.high.z, corner.z));
      }
      e.axis = t.normal;
      e.cos_o = 1;
      e.intensity = double(norm(l.radiance)) * t.area();
      e.two_sided = l.two_sided;
      all.push_back(e);
    }
  }
  return all;
}

Emitter Lights::emitter_of(const Light& light) const {
  Emitter e;
  if (light.kind == Kind::Sphere) {
    e.low = light.center - Vec3(light.radius);
    e.high = light.center + Vec3(light.radius);
    e.intensity = double(norm(light.radiance)) * kPi * light.radius * light.radius;
    return e;
  }
  const LightDesc& o = other(light);
  e.low = e.high = o.position;
  e.intensity = norm(o.intensity);
  if (light.kind == Kind::Spot) {
    e.axis = o.direction;
    e.cos_o = o.cos_inner;
    e.cos_e = std::cos(std::acos(double(o.cos_outer)) - std::acos(double(o.cos_inner))) - 1e-4;  // cosines are rounded
  }
  return e;
}

}  // namespace bdpt
