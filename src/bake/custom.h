// Measurements of the host's own: its functions start eye subpaths and say what a direction measures.
#pragma once

#include "bake/rows.h"

#include <memory>

namespace bdpt {

// The host's functions, checked: each throws where the host reports an error. They may run on any thread.
class Measurement {
 public:
  virtual ~Measurement() = default;
  virtual bool has_density() const = 0;
  virtual bool has_response() const = 0;
  virtual bool has_landing() const = 0;
  virtual void start(uint32_t n, const uint64_t* measurements, const float (*numbers)[4], EyeStart* starts) const = 0;
  // P_sigma-perp of w at a place.
  virtual float density(uint64_t measurement, const SensorPlace& place, const Vec3& w) const = 0;
  // W_e^(1) of each plane.
  virtual void respond(uint64_t measurement, const SensorPlace& place, const Vec3& w, float* response) const = 0;
  // Which measurement light that lands on a surface belongs to; false for none.
  virtual bool land(const Landing& landing, uint64_t& measurement, SensorPoint& z0) const = 0;
};

class Custom final : public Sensor {
 public:
  // hash: of all that the host's functions decide.
  Custom(std::shared_ptr<const Measurement> measurement, uint64_t count, int planes, uint64_t hash);

  int width() const override { return rows_.width; }
  int height() const override { return rows_.height; }
  bool is_hittable() const override { return measurement_->has_landing() && measurement_->has_density(); }
  uint64_t hash() const override { return hash_; }
  bool is_local() const override { return true; }
  bool is_surface() const override { return is_hittable(); }
  bool can_look() const override { return measurement_->has_density(); }
  int64_t number(int x, int y) const override { return rows_.number(x, y); }
  uint64_t count() const override { return rows_.count; }
  const std::vector<OutputPlanes>& outputs() const override { return outputs_; }
  bool responds() const override { return measurement_->has_response(); }

  EyeStart start_at(int x, int y, const float u[5]) const override;
  void start_many(size_t n, const SamplePlace* places, EyeStart* starts) const override;
  bool look(const EyeStart& z0, const Vec3& w, SensorDirection& direction) const override;
  bool land(const Landing& landing, SensorPoint& z0) const override;
  void respond(const SensorPlace& place, const Vec3& w, float* response) const override;

 private:
  std::shared_ptr<const Measurement> measurement_;
  Rows rows_;
  std::vector<OutputPlanes> outputs_;
  uint64_t hash_;
};

}  // namespace bdpt
