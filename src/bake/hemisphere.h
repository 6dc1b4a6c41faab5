// How sensors look out: over the hemisphere round a normal or a cone of it, a part of the directions by the cosine and
// the rest evenly. With a cosine alone no direction near the horizon would be found for measurements that do not fade
// there.
#pragma once

#include "sampling/warp.h"
#include "sensor/sensor.h"

namespace bdpt {

class HemisphereSampler {
 public:
  explicit HemisphereSampler(float cosine_part) : q_(cosine_part) {}
  // The same within an angle of the normal, (0, pi/2].
  HemisphereSampler within(float angle) const {
    HemisphereSampler cone(q_);
    const double half = std::sin(double(angle) / 2);
    cone.sine2_ = float(std::pow(std::sin(double(angle)), 2));
    cone.one_minus_cos_ = float(2 * half * half);
    return cone;
  }
  // The direction of an eye subpath whose place is known, its densities and its weight.
  void start(const float u[2], EyeStart& z0) const {
    const Vec3 local = sample(u[0], u[1]);
    z0.direction = Frame(z0.normal).to_world(local);
    z0.cosine = std::max(local.z, 1e-7f);
    z0.density_direction = density(z0.cosine);
    z0.weight = 1 / z0.density_direction;
  }
  // As Sensor::look(), for W_e^(1) = 1 on the normal's side.
  bool look(const Vec3& normal, const Vec3& w, SensorDirection& direction) const {
    direction.cosine = dot(normal, w);
    if (!(direction.cosine > 0) || 1 - direction.cosine > one_minus_cos_) return false;
    direction.importance = 1;
    direction.density = density(direction.cosine);
    return true;
  }
  // Per projected solid angle.
  float density(float cosine) const {
    return q_ * kInvPi / sine2_ + (q_ < 1 ? (1 - q_) / (kTwoPi * one_minus_cos_ * cosine) : 0.0f);
  }

 private:
  // In the frame of the normal.
  Vec3 sample(float u0, float u1) const {
    if (u0 >= q_) return sample_cone(std::min((u0 - q_) / (1 - q_), 0x1.fffffep-1f), u1, one_minus_cos_);
    if (sine2_ == 1) return sample_cosine_hemisphere(u0 / q_, u1);
    const Vec2 d = sample_disk(u0 / q_, u1) * std::sqrt(sine2_);
    return {d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y)};
  }
  float q_;
  float sine2_ = 1, one_minus_cos_ = 1;  // of the cone
};

}  // namespace bdpt
