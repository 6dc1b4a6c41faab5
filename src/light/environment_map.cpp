// Radiance from all directions by a picture.
#include "light/environment_map.h"

#include "geometry/texture.h"
#include "light/infinity.h"
#include "light/kinds.h"

#include <numbers>

namespace bdpt {

namespace {

constexpr double kTwoPiExactly = 2 * std::numbers::pi;
// What direct lighting keeps of what does not stand out: all that shines can be found by s = 1 alone.
constexpr double kLeast = 0.1;

}  // namespace

EnvironmentMap::EnvironmentMap(std::shared_ptr<const Texture> picture, const Rgb& scale, const Transform& to_world)
    : picture_(std::move(picture)),
      scale_(scale),
      to_world_(to_world),
      width_(picture_->width()),
      height_(picture_->height()) {
  for (uint32_t y = 0; y <= height_; ++y) {
    const double s = std::sin(std::numbers::pi * y / height_ / 2);
    edges_.push_back(s * s);
  }
  std::vector<double> solid_angle;
  for (uint32_t y = 0; y < height_; ++y) {
    solid_angle.push_back(2 * kTwoPiExactly / width_ * (edges_[y + 1] - edges_[y]));
    inverse_solid_angle_.push_back(float(1 / solid_angle[y]));
  }
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

Rgb EnvironmentMap::texel(int64_t x, int64_t y) const {
  const int64_t w = width_, h = height_;
  return picture_->texel(uint32_t((x + w) % w), uint32_t(std::clamp<int64_t>(y, 0, h - 1))) * scale_;
}

// The mean over a texel of what is linear between the middles of texels: 1/8, 6/8 and 1/8 of three.
double EnvironmentMap::mean(uint32_t x, uint32_t y) const {
  constexpr float kPart[] = {0.125f, 0.75f, 0.125f};
  Rgb sum;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) sum += texel(int64_t(x) + i, int64_t(y) + j) * (kPart[i + 1] * kPart[j + 1]);
  return double(norm(sum));
}

EnvironmentMap::Place EnvironmentMap::place_of(const Vec3& w) const {
  const Vec3 v = to_world_.transposed(w);  // to_world is orthonormal
  const float u = 0.5f + std::atan2(v.x, -v.z) / kTwoPi;
  const float theta = std::atan2(std::sqrt(v.x * v.x + v.z * v.z), v.y);
  return {u * float(width_), theta * kInvPi * float(height_)};
}

Rgb EnvironmentMap::radiance(const Vec3& w) const {
  const Place p = place_of(w);
  const float x = p.x - 0.5f, y = p.y - 0.5f, fx = std::floor(x), fy = std::floor(y);
  const float wx = x - fx, wy = y - fy;
  const int64_t x0 = int64_t(fx), y0 = int64_t(fy);
  return (texel(x0, y0) * (1 - wx) + texel(x0 + 1, y0) * wx) * (1 - wy) +
         (texel(x0, y0 + 1) * (1 - wx) + texel(x0 + 1, y0 + 1) * wx) * wy;
}

Vec3 EnvironmentMap::sample(bool direct, double rest, float u1, float u2) const {
  const TexelTable& table = direct ? direct_ : all_;
  if (table.empty()) return {0, 1, 0};  // black
  // More digits for both: a picture may have a sun, and beside it many texels that are hardly ever chosen.
  const double digits = rest * 0x1p12, high = std::floor(digits);
  double u = join(u1, float(high * 0x1p-12)), v = join(u2, float(digits - high));
  const TexelTable::Texel t = table.sample(u, v);
  const double s = edges_[t.y] + v * (edges_[t.y + 1] - edges_[t.y]);
  const double y = 1 - 2 * s, r = 2 * std::sqrt(std::max(0.0, s * (1 - s)));
  const double phi = kTwoPiExactly * ((double(t.x) + u) / width_ - 0.5);
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

void place(const Light& light, const PlaceNumbers& u, const Vec3&, LightPoint& y0) {
  y0.normal = map_of(light).sample(true, u.rest, u.u1, u.u2);
}

void start(const Light& light, const StartNumbers& u, LightStart& start) {
  start.y0.normal = map_of(light).sample(false, u.rest, u.u1, u.u2);
  start_on_disk(light, u.v1, u.v2, start);
}

Rgb emitted(const Light& light, const LightPoint& y0, const Vec3&) { return map_of(light).radiance(y0.normal); }

float position_density(const Light& light, const LightPoint& y0) { return map_of(light).density(false, y0.normal); }
float direct_density(const Light& light, const LightPoint& y0, const Vec3&) {
  return map_of(light).density(true, y0.normal);
}

}  // namespace

const LightKind kEnvironmentMapLight = {
    .has_area = false,
    .infinite = true,
    .hittable = true,
    .power = power,
    .start = start,
    .place = place,
    .emitted = emitted,
    .position_density = position_density,
    .direction_density = density_on_disk,
    .direct_density = direct_density,
    .bounds = nullptr,
};

std::unique_ptr<LightData> make_environment_map(const LightDesc& desc, Light& light) {
  light.kind = LightKindId::EnvironmentMap;
  return std::make_unique<EnvironmentMap>(desc.texture, desc.radiance, desc.transform);
}

}  // namespace bdpt
