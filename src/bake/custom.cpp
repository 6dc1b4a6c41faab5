#include "bake/custom.h"

#include "sampling/hash.h"

#include <array>
#include <limits>

namespace bdpt {

namespace {

float cosine_of(const SensorPlace& place, const Vec3& w) { return place.normal == Vec3(0) ? 1 : dot(place.normal, w); }

// In place of a factor: what it makes is not finite, and is counted and left out.
constexpr float kUnsound = std::numeric_limits<float>::quiet_NaN();

bool is_density(float v) { return v > 0 && std::isfinite(v); }

// What cannot be started from: it is left out, and counted.
bool is_sound(const EyeStart& s) {
  const float numbers[] = {s.p.x,         s.p.y,         s.p.z,    s.direction.x,
                           s.direction.y, s.direction.z, s.weight, s.weight_position};
  for (float v : numbers)
    if (!std::isfinite(v)) return false;
  return is_density(s.density_position) && is_density(s.density_direction) && s.cosine > 0 &&
         std::fabs(length_squared(s.direction) - 1) < 1e-3f;
}

}  // namespace

Custom::Custom(std::shared_ptr<const Measurement> measurement, uint64_t count, int planes, uint64_t hash)
    : measurement_(std::move(measurement)), rows_(count) {
  OutputPlanes all;
  all.count = planes;
  outputs_.push_back(all);
  hash_ = hash_values(hash, count, planes, measurement_->has_density(), measurement_->has_response(),
                      measurement_->has_landing());
}

EyeStart Custom::start_at(int x, int y, const float u[5]) const {
  const SamplePlace place{x, y, {u[0], u[1], u[2], u[3], 0}};
  EyeStart start;
  start_many(1, &place, &start);
  return start;
}

void Custom::start_many(size_t n, const SamplePlace* places, EyeStart* starts) const {
  std::vector<uint64_t> measurements(n);
  std::vector<std::array<float, 4>> numbers(n);
  for (size_t i = 0; i < n; ++i) {
    measurements[i] = uint64_t(number(places[i].x, places[i].y));
    std::copy(places[i].u, places[i].u + 4, numbers[i].begin());
  }
  measurement_->start(uint32_t(n), measurements.data(), reinterpret_cast<const float(*)[4]>(numbers.data()), starts);
  for (size_t i = 0; i < n; ++i) {
    EyeStart& s = starts[i];
    s.film = rows_.place(measurements[i]);
    s.shading = s.normal;
    s.cosine = cosine_of(s, s.direction);
    s.weight = s.weight_position / s.density_direction;
    if (!is_sound(s)) s.weight = s.weight_position = kUnsound;
  }
}

bool Custom::look(const EyeStart& z0, const Vec3& w, SensorDirection& direction) const {
  direction.cosine = cosine_of(z0, w);
  if (!(direction.cosine > 0)) return false;
  direction.importance = 1;
  direction.density = measurement_->density(rows_.number(z0.film), z0, w);
  if (!is_density(direction.density)) direction.importance = kUnsound;
  return true;
}

bool Custom::land(const Landing& landing, SensorPoint& z0) const {
  uint64_t measurement = 0;
  z0.p = landing.p;
  if (!measurement_->land(landing, measurement, z0)) return false;
  const Vec3 w = -landing.direction;
  if (!(cosine_of(z0, w) > 0)) return false;
  z0.film = rows_.place(measurement);
  z0.shading = z0.normal;
  z0.density_direction = measurement_->density(measurement, z0, w);
  if (!is_density(z0.density_position) || !is_density(z0.density_direction)) z0.importance = kUnsound;
  return true;
}

void Custom::respond(const SensorPlace& place, const Vec3& w, float* response) const {
  measurement_->respond(rows_.number(place.film), place, w, response);
}

}  // namespace bdpt
