// Radiance from all directions by a picture.
#include "light/environment_map.h"

#include "light/infinity.h"
#include "light/kinds.h"

#include <numbers>

namespace bdpt {

namespace {

constexpr double kTwoPiExactly = 2 * std::numbers::pi;
// What direct lighting keeps of what does not stand out: all that shines can be found by s = 1 alone.
constexpr double kLeast = 0.1;

}  // namespace

EnvironmentMap::EnvironmentMap(const Picture& picture, const Transform& to_world)
    : picture_(picture), to_world_(to_world), width_(picture.width()), height_(picture.height()) {
  for (uint32_t y = 0; y <= height_; ++y) {
    const double s = std::sin(std::numbers::pi * y / height_ / 2);
    edges_.push_back(s * s);
  }
  std::vector<double> solid_angle;
  for (uint32_t y = 0; y < height_; ++y) {
    solid_angle.push_back(2 * kTwoPiExactly / width_ * (edges_[y + 1] - edges_[y]));
    inverse_solid_angle_.push_back(float(1 / solid_angle[y]));
  }
  const std::vector<float> means = picture_.means();
  const auto mean = [&](uint32_t x, uint32_t y) { return double(means[size_t(y) * width_ + x]); };
  all_ = TexelTable(width_, height_, [&](uint32_t x, uint32_t y) {
    const double part = mean(x, y) * solid_angle[y];
    total_ += part;
    return part;
  });
  const double average = total_ / (2 * kTwoPiExactly);
  direct_ = TexelTable(width_, height_, [&](uint32_t x, uint32_t y) {
    const double m = mean(x, y);
    return std::max(m - average, kLeast * m) * solid_angle[y];
  });
}

EnvironmentMap::Place EnvironmentMap::place_of(const Vec3& w) const {
  const Vec3 v = to_world_.transposed(w);  // to_world is orthonormal
  const float u = 0.5f + std::atan2(v.x, -v.z) / kTwoPi;
  const float theta = std::atan2(std::sqrt(v.x * v.x + v.z * v.z), v.y);
  return {u * float(width_), theta * kInvPi * float(height_)};
}

Rgb EnvironmentMap::radiance(const Vec3& w) const {
  const Place p = place_of(w);
  return picture_.at(p.x, p.y);
}

Vec3 EnvironmentMap::sample(bool direct, double rest, float u1, float u2) const {
  const TexelTable& table = direct ? direct_ : all_;
  if (table.empty()) return {0, 1, 0};  // black
  const TexelTable::Place t = table.sample(rest, u1, u2);
  const double s = edges_[t.y] + t.v * (edges_[t.y + 1] - edges_[t.y]);
  const double y = 1 - 2 * s, r = 2 * std::sqrt(std::max(0.0, s * (1 - s)));
  const double phi = kTwoPiExactly * ((double(t.x) + t.u) / width_ - 0.5);
  return unit(to_world_.vector(Vec3(float(r * std::sin(phi)), float(y), float(-r * std::cos(phi)))));
}

float EnvironmentMap::density(bool direct, const Vec3& w) const {
  const Place p = place_of(w);
  const uint32_t x = std::min(uint32_t(p.x), width_ - 1), y = std::min(uint32_t(p.y), height_ - 1);
  return (direct ? direct_ : all_).probability(x, y) * inverse_solid_angle_[y];
}

namespace {

const EnvironmentMap& map_of(const Light& light) { return static_cast<const EnvironmentMap&>(*light.data); }

double power(const Light& light) { return area_of_disk(light) * map_of(light).total(); }

void place(const Light& light, const PlaceNumbers& u, const Vec3& x, LightPoint& y0) {
  double rest = u.rest;
  if (!portals_of(light).sample_direction(x, rest, u.u1, u.u2, y0.normal))
    y0.normal = map_of(light).sample(true, rest, u.u1, u.u2);
}

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  start.y0.normal = map_of(light).sample(false, u.rest, u.u1, u.u2);
  start_on_disk(light, u, start);
}

Rgb emitted(const Light& light, const LightPoint& y0, const Vec3&) { return map_of(light).radiance(y0.normal); }

float position_density(const Light& light, const LightPoint& y0) { return map_of(light).density(false, y0.normal); }
float direct_density(const Light& light, const LightPoint& y0, const Vec3& x) {
  return portals_of(light).direction_density(x, y0.normal, map_of(light).density(true, y0.normal));
}

}  // namespace

const LightKind kEnvironmentMapLight =
    kind_at_infinity(true, power, start, place, emitted, position_density, direct_density);

std::unique_ptr<LightData> make_environment_map(const LightDesc& desc, Light& light) {
  light.kind = LightKindId::EnvironmentMap;
  auto map = std::make_unique<EnvironmentMap>(Picture(desc.texture, desc.radiance, true), desc.transform);
  map->portals = Portals(desc.portals);
  return map;
}

}  // namespace bdpt
