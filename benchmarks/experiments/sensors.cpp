// SPDX-License-Identifier: Apache-2.0
#include "sensors.h"

#include <memory>

#include "api/handles.h"
#include "sampling/hash.h"
#include "sampling/warp.h"
#include "sensor/sensor.h"

namespace bdpt_experiments {
namespace {

// W_e = 1 / (pi A) over the upper hemisphere, sampled by the cosine: every eye subpath weighs one. The sensor hovers
// over the floor, so that light meets it first.
class FloorSensor final : public bdpt::Sensor {
 public:
  explicit FloorSensor(int texels) : texels_(texels) {}

  int width() const override { return texels_; }
  int height() const override { return texels_; }
  bool is_hittable() const override { return true; }
  std::uint64_t hash() const override { return bdpt::hash_values(texels_, 0x466c6f6f72); }

  bdpt::EyeStart start(const bdpt::FilmPosition& film, const float lens[2], const bdpt::PixelRect&) const override {
    bdpt::EyeStart s;
    s.film = film;
    s.p = point(film);
    s.normal = kUp;
    const bdpt::Vec2 disk = bdpt::sample_disk(lens[0], lens[1]);
    const float height = std::sqrt(std::max(1 - disk.x * disk.x - disk.y * disk.y, 1e-12f));
    s.direction = bdpt::unit(bdpt::Vec3(disk.x, height, disk.y));
    s.cosine = s.direction.y;
    s.density_position = 1 / kArea;
    s.density_direction = bdpt::kInvPi;
    s.weight = 1;
    return s;
  }

  bool sample_toward(const bdpt::Vec3& x, const float lens[2], const bdpt::PixelRect&,
                     bdpt::SensorPoint& z0) const override {
    if (!(x.y > kHover)) return false;
    see({lens[0] * float(texels_), lens[1] * float(texels_)}, z0);
    return true;
  }

  bool hit(const bdpt::Vec3& origin, const bdpt::Vec3& direction, float tmax, const bdpt::PixelRect&,
           bdpt::SensorPoint& z0) const override {
    if (!(direction.y < 0)) return false;
    const float t = (kHover - origin.y) / direction.y;
    if (!(t > 0 && t < tmax)) return false;
    const bdpt::Vec3 p = origin + direction * t;
    const bdpt::FilmPosition film((p.x + 1) / 2 * float(texels_), (p.z + 1) / 2 * float(texels_));
    if (!(film.x >= 0 && film.x < float(texels_) && film.y >= 0 && film.y < float(texels_))) return false;
    see(film, z0);
    return true;
  }

 private:
  static constexpr float kArea = 4, kHover = 1e-4f;
  static constexpr bdpt::Vec3 kUp{0, 1, 0};

  bdpt::Vec3 point(const bdpt::FilmPosition& film) const {
    return {2 * film.x / float(texels_) - 1, kHover, 2 * film.y / float(texels_) - 1};
  }
  void see(const bdpt::FilmPosition& film, bdpt::SensorPoint& z0) const {
    z0.film = film;
    z0.p = point(film);
    z0.normal = kUp;
    z0.density_position = 1 / kArea;
    z0.density_direction = bdpt::kInvPi;
    z0.importance = z0.density_position * z0.density_direction;
  }

  int texels_;
};

}  // namespace

void measure_floor(Stage& stage, std::uint32_t texels) {
  auto handle = std::make_unique<bdpt_sensor>();
  handle->context = bdpt::Ref<bdpt_context>(stage.context.get());
  handle->sensor = std::make_shared<const FloorSensor>(int(texels));
  stage.sensor.reset(handle.release());
  stage.width = stage.height = texels;
}

}  // namespace bdpt_experiments
