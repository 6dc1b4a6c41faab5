// What a contribution to the base of a measurement counts in each plane of the film.
#pragma once

#include "math/vec.h"
#include "sensor/sensor.h"

#include <vector>

namespace bdpt {

class Responses {
 public:
  explicit Responses(const Sensor& sensor)
      : sensor_(sensor),
        planes_(size_t(sensor.planes())),
        plain_(sensor.is_plain()),
        responds_(sensor.responds()),
        response_(planes_, 1.0f) {
    for (const OutputPlanes& o : sensor.outputs())
      (o.seen == Seen::Unshadowed ? unshadowed_
       : is_of_surface(o.seen)    ? sees_surfaces_
                                  : sees_) |= o.seen != Seen::Light;
  }

  size_t planes() const { return planes_; }
  bool is_plain() const { return plain_; }               // one plane, and it is the base
  bool sees() const { return sees_; }                    // whether some output is about what first rays see
  bool sees_surfaces() const { return sees_surfaces_; }  // or the surfaces that they meet
  bool unshadowed() const { return unshadowed_; }        // whether some output is about light that nothing blocks
  // For eye subpaths that are about to start.
  void reset(size_t samples) { starts_.assign(responds_ ? samples * planes_ : 0, kUnknown); }

  // Calls add(plane, factor) for each plane that takes a group's light over so many edges, for an eye subpath's first
  // direction.
  template <class Add>
  void each(uint32_t sample, const EyeStart& z0, uint32_t edges, uint32_t group, Add&& add) {
    visit(first_response(sample, z0), edges, group, add);
  }
  // The same for any direction w from z_0.
  template <class Add>
  void each(const SensorPlace& z0, const Vec3& w, uint32_t edges, uint32_t group, Add&& add) {
    if (responds_) sensor_.respond(z0, w, response_.data());
    visit(response_.data(), edges, group, add);
  }
  // The same where the sensor's outputs are parts of its base.
  template <class Add>
  void each(uint32_t edges, uint32_t group, Add&& add) {
    visit(response_.data(), edges, group, add);
  }
  // Direct light that nothing blocks.
  template <class Add>
  void each_unshadowed(const SensorPlace& z0, const Vec3& w, uint32_t group, Add&& add) {
    if (responds_) sensor_.respond(z0, w, response_.data());
    for (const OutputPlanes& o : sensor_.outputs())
      if (o.seen == Seen::Unshadowed && o.takes(group)) add(size_t(o.first), response_[size_t(o.first)]);
  }
  // What an eye subpath's first ray sees: up to a distance, the back of something or not; weight: alpha_2. Calls
  // add(plane, value).
  template <class Add>
  void see(uint32_t sample, const EyeStart& z0, float distance, bool back, float weight, Add&& add) {
    const float* response = first_response(sample, z0);
    for (const OutputPlanes& o : sensor_.outputs()) {
      const Rgb seen = value_of(o, z0.direction, distance, back);
      if (is_black(seen)) continue;
      for (int plane = o.first; plane < o.first + o.count; ++plane) {
        const float v = o.seen == Seen::Fronts ? 1 : weight * response[plane];
        if (v != 0) add(size_t(plane), seen * v);
      }
    }
  }
  size_t memory() const { return (starts_.capacity() + response_.capacity()) * sizeof(float); }

 private:
  static Rgb value_of(const OutputPlanes& o, const Vec3& direction, float distance, bool back) {
    const bool near = distance <= o.reach;
    switch (o.seen) {
      case Seen::Light:
      case Seen::Unshadowed:
      default:
        break;
      case Seen::Openness:
        return Rgb(near ? 0.0f : 1.0f);
      case Seen::Direction:
        return near ? Rgb() : Rgb(direction.x, direction.y, direction.z);
      case Seen::Distance: {
        const float d = near ? distance : o.reach;
        return {d, d * d, near ? 1.0f : 0.0f};
      }
      case Seen::Fronts:
        return Rgb(back ? 0.0f : 1.0f);
    }
    return Rgb();
  }
  const float* first_response(uint32_t sample, const EyeStart& z0) {
    if (!responds_) return response_.data();
    float* known = starts_.data() + sample * planes_;
    if (known[0] == kUnknown) sensor_.respond(z0, z0.direction, known);
    return known;
  }
  static constexpr float kUnknown = -3e38f;
  template <class Add>
  void visit(const float* response, uint32_t edges, uint32_t group, Add&& add) {
    for (const OutputPlanes& o : sensor_.outputs())
      if (o.takes(edges, group))
        for (int plane = o.first; plane < o.first + o.count; ++plane)
          if (response[plane] != 0) add(size_t(plane), response[plane]);
  }

  const Sensor& sensor_;
  size_t planes_;
  bool plain_, responds_, sees_ = false, sees_surfaces_ = false, unshadowed_ = false;
  std::vector<float> response_;  // of the direction in hand
  std::vector<float> starts_;    // of the eye subpaths' first directions, once they were asked for
};

}  // namespace bdpt
