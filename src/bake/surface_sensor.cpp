#include "bake/surface_sensor.h"

#include "sampling/hash.h"

namespace bdpt {

EyeStart SurfaceSensor::start_on(const ReceivingInstance& placed, uint32_t primitive, float u, float v,
                                 const float direction[2]) const {
  Surface surface{};
  scene_->point(placed.instance, primitive, u, v, surface);
  const float side = placed.flip ? -1.0f : 1.0f;
  EyeStart s;
  s.p = surface.p;
  s.normal = surface.ng * side;
  s.shading = geometric_normals_ ? s.normal : surface.ns * side;
  s.margin = surface.margin;
  hemisphere_.start(direction, s);
  return s;
}

bool SurfaceSensor::receive(const ReceivingInstance& placed, const Landing& landing, SensorPoint& z0) const {
  const float side = placed.flip ? -1.0f : 1.0f;
  z0.normal = landing.ng * side;
  const float cosine = -dot(z0.normal, landing.direction);
  if (!(cosine > 0)) return false;
  z0.shading = geometric_normals_ ? z0.normal : landing.ns * side;
  z0.p = landing.p;
  z0.density_direction = hemisphere_.density(cosine);
  return true;
}

bool SurfaceSensor::look(const EyeStart& z0, const Vec3& w, SensorDirection& direction) const {
  return hemisphere_.look(z0.normal, w, direction);
}

void SurfaceSensor::respond(const SensorPlace& place, const Vec3& w, float* response) const {
  outputs_.evaluate(w, place.shading, dot(place.normal, w), response);
}

uint64_t SurfaceSensor::base_hash() const {
  return hash_combine(hash_values(scene_->info().hash, geometric_normals_), outputs_.hash());
}

}  // namespace bdpt
