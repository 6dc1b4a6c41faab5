#include "bake/points.h"

#include "geometry/margin.h"
#include "sampling/hash.h"

namespace bdpt {

namespace {

constexpr float kUniform = 1 / (4 * kPi);

bool is_free(const Vec3& normal) { return normal == Vec3(0); }
bool is_ball(const MeasuredPoint& point) { return is_free(point.normal) && point.radius > 0; }

float per_volume(float radius) {
  return float(3 / (4 * double(kPi) * double(radius) * double(radius) * double(radius)));
}

Vec3 sample_ball(float u0, float u1, float u2) { return sample_sphere(u0, u1) * std::cbrt(u2); }

std::vector<Ball> balls_of(const std::vector<MeasuredPoint>& points) {
  std::vector<Ball> balls;
  for (size_t i = 0; i < points.size(); ++i)
    if (is_ball(points[i])) balls.push_back({points[i].p, points[i].radius, uint32_t(i)});
  return balls;
}

bool is_base(const std::vector<MeasuredPoint>& points, const Outputs& outputs) {
  bool free = false, held = false;
  for (const MeasuredPoint& p : points) (is_free(p.normal) ? free : held) = true;
  return !(free && held) && !outputs.respond(held, false);
}

}  // namespace

Points::Points(std::vector<MeasuredPoint> points, const std::vector<OutputDesc>& outputs, float offset)
    : points_(std::move(points)),
      balls_(balls_of(points_)),
      outputs_(outputs),
      rows_(points_.size()),
      responds_(!is_base(points_, outputs_)),
      offset_(offset),
      hemisphere_(all_fade(outputs) ? 1 : 0.5f) {
  if (offset_ == 0)
    for (const MeasuredPoint& p : points_) offset_ = std::max(offset_, margin_of(largest(p.p)));
  if (std::any_of(points_.begin(), points_.end(), [](const MeasuredPoint& p) { return p.cone < kPi / 2; }))
    for (const MeasuredPoint& p : points_)
      cones_.push_back(p.cone < kPi / 2 ? hemisphere_.within(p.cone) : hemisphere_);
  hash_ = hash_combine(outputs_.hash(), hash_values(points_.size()));
  hash_ = hash_bytes(&offset_, sizeof(offset_), hash_);
  for (const MeasuredPoint& p : points_) {
    const float numbers[] = {p.p.x, p.p.y, p.p.z, p.normal.x, p.normal.y, p.normal.z, p.radius, p.cone};
    hash_ = hash_bytes(numbers, sizeof(numbers), hash_);
  }
}

EyeStart Points::start_at(int x, int y, const float u[5]) const {
  const size_t index = size_t(number(x, y));
  const MeasuredPoint& point = points_[index];
  EyeStart s;
  s.film = center_of(x, y);
  s.p = point.p;
  s.normal = s.shading = point.normal;
  s.density_position = 1;
  if (is_free(point.normal)) {
    s.direction = sample_sphere(u[2], u[3]);
    s.cosine = 1;
    s.density_direction = kUniform;
    s.weight = 1 / kUniform;
    if (point.radius > 0) {
      s.p += sample_ball(u[0], u[1], u[4]) * point.radius;
      s.density_position = per_volume(point.radius);
    }
  } else {
    const Frame frame(point.normal);
    if (point.radius > 0) {
      const Vec2 d = sample_disk(u[0], u[1]) * point.radius;
      s.p += frame.t * d.x + frame.b * d.y;
      s.density_position = 1 / (kPi * point.radius * point.radius);
    }
    s.margin = offset_;
    sampler_of(index).start(u + 2, s);
  }
  return s;
}

bool Points::look(const EyeStart& z0, const Vec3& w, SensorDirection& direction) const {
  direction = {1, kUniform, 1};
  return is_free(z0.normal) || sampler_of(rows_.number(z0.film)).look(z0.normal, w, direction);
}

float Points::chord_density(const EyeStart& z0, const Vec3& w, float distance) const {
  const uint32_t number = uint32_t(rows_.number(z0.film));
  const MeasuredPoint& point = points_[number];
  double begin, end;
  const Vec3 from = z0.p + w * (2 * point.radius);  // outside
  if (!is_ball(point) || !chord(from, -w, {point.p, point.radius, number}, begin, end)) return 0;
  const double near = std::max(begin, 2 * double(point.radius) - double(distance));
  return end > near ? float(1 / (end - near)) : 0;
}

void Points::cross(const Vec3& origin, const Vec3& direction, float tmax, std::vector<Crossing>& crossings) const {
  balls_.each(origin, direction, tmax, [&](const Ball& ball, double begin, double end) {
    crossings.push_back({ball.number, begin, end});
  });
}

SensorPoint Points::point_in(uint32_t number, const Vec3& p) const {
  SensorPoint z0;
  z0.film = rows_.place(number);
  z0.p = p;
  z0.importance = z0.density_position = per_volume(points_[number].radius);
  z0.density_direction = kUniform;
  return z0;
}

void Points::respond(const SensorPlace& place, const Vec3& w, float* response) const {
  const bool free = is_free(place.normal);
  outputs_.evaluate(w, place.normal, free ? 1 : dot(place.normal, w), response);
}

}  // namespace bdpt
