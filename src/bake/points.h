// The light that arrives at points in space, at small disks or in balls: vertices, light sensors, probes. Light passes
// through balls, and is measured there by the length of its way (t = 0).
#pragma once

#include "bake/balls.h"
#include "bake/hemisphere.h"
#include "bake/outputs.h"
#include "bake/rows.h"

#include <vector>

namespace bdpt {

struct MeasuredPoint {
  Vec3 p;
  Vec3 normal{0, 0, 0};  // unit: it sees the hemisphere round it; zero: it sees all directions
  float radius = 0;      // of a disk across the normal, or without one of a ball, over which the mean is taken
  float cone = kPi / 2;  // with a normal: the angle from it within which light counts
};

class Points final : public Sensor {
 public:
  // offset: how far along its normal a point's rays start; 0 = enough for a point that lies on a surface no larger than
  // the points' own coordinates.
  Points(std::vector<MeasuredPoint> points, const std::vector<OutputDesc>& outputs, float offset = 0);

  int width() const override { return rows_.width; }
  int height() const override { return rows_.height; }
  bool is_hittable() const override { return is_volume(); }
  uint64_t hash() const override { return hash_; }
  bool is_local() const override { return true; }
  int64_t number(int x, int y) const override { return rows_.number(x, y); }
  uint64_t count() const override { return points_.size(); }
  const std::vector<OutputPlanes>& outputs() const override { return outputs_.list(); }
  bool responds() const override { return responds_; }

  EyeStart start_at(int x, int y, const float u[5]) const override;
  bool look(const EyeStart& z0, const Vec3& w, SensorDirection& direction) const override;
  void respond(const SensorPlace& place, const Vec3& w, float* response) const override;
  bool is_volume() const override { return !balls_.empty(); }
  float chord_density(const EyeStart& z0, const Vec3& w, float distance) const override;
  void cross(const Vec3& origin, const Vec3& direction, float tmax, std::vector<Crossing>& crossings) const override;
  SensorPoint point_in(uint32_t number, const Vec3& p) const override;

 private:
  const HemisphereSampler& sampler_of(size_t point) const { return cones_.empty() ? hemisphere_ : cones_[point]; }

  std::vector<MeasuredPoint> points_;
  BallTree balls_;
  Outputs outputs_;
  Rows rows_;
  bool responds_;
  float offset_;
  HemisphereSampler hemisphere_;
  std::vector<HemisphereSampler> cones_;  // of each point, if any sees less than the hemisphere
  uint64_t hash_;
};

}  // namespace bdpt
