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
        response_(planes_, 1.0f) {}

  size_t planes() const { return planes_; }
  bool is_plain() const { return plain_; }  // one plane, and it is the base
  // For eye subpaths that are about to start.
  void reset(size_t samples) { starts_.assign(responds_ ? samples * planes_ : 0, kUnknown); }

  // Calls add(plane, factor) for each plane that takes a group's light over so many edges, for an eye subpath's first
  // direction.
  template <class Add>
  void each(uint32_t sample, const EyeStart& z0, uint32_t edges, uint32_t group, Add&& add) {
    const float* response = response_.data();
    if (responds_) {
      float* known = starts_.data() + sample * planes_;
      if (known[0] == kUnknown) sensor_.respond(z0, z0.direction, known);
      response = known;
    }
    visit(response, edges, group, add);
  }
  // The same for any direction w from z_0.
  template <class Add>
  void each(const SensorPlace& z0, const Vec3& w, uint32_t edges, uint32_t group, Add&& add) {
    if (responds_) sensor_.respond(z0, w, response_.data());
    visit(response_.data(), edges, group, add);
  }
  size_t memory() const { return (starts_.capacity() + response_.capacity()) * sizeof(float); }

 private:
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
  bool plain_, responds_;
  std::vector<float> response_;  // of the direction in hand
  std::vector<float> starts_;    // of the eye subpaths' first directions, once they were asked for
};

}  // namespace bdpt
