// What sensors on the surfaces of a scene's instances share: which side receives, which normal counts, where a texel or
// a vertex looks, and what its outputs are.
#pragma once

#include "bake/hemisphere.h"
#include "bake/outputs.h"
#include "bake/receiving_instance.h"
#include "scene/scene.h"

#include <algorithm>
#include <memory>

namespace bdpt {

class SurfaceSensor : public Sensor {
 public:
  // If some instance is invisible, light would land on some measurements and not on others: then there is no t = 0.
  bool is_hittable() const final { return hittable_; }
  bool is_local() const final { return true; }
  bool is_surface() const final { return true; }
  const std::vector<OutputPlanes>& outputs() const final { return outputs_.list(); }
  bool responds() const final { return responds_; }
  bool look(const EyeStart& z0, const Vec3& w, SensorDirection& direction) const final;
  void respond(const SensorPlace& place, const Vec3& w, float* response) const final;

 protected:
  // Of structs that are ReceivingInstance.
  template <class Instances>
  SurfaceSensor(std::shared_ptr<const Scene> scene, const Instances& instances, const std::vector<OutputDesc>& outputs,
                bool geometric_normals)
      : scene_(std::move(scene)),
        outputs_(outputs),
        geometric_normals_(geometric_normals ||
                           std::all_of(instances.begin(), instances.end(),
                                       [&](const auto& i) { return scene_->mesh(i.instance)->normals.empty(); })),
        responds_(outputs_.respond(true, !geometric_normals_)),
        hittable_(std::all_of(instances.begin(), instances.end(),
                              [&](const auto& i) { return scene_->is_solid(i.instance); })),
        hemisphere_(all_fade(outputs) && geometric_normals_ ? 1 : 0.5f) {}

  // An eye subpath from a point of a triangle, but for its film position and P_A.
  EyeStart start_on(const ReceivingInstance& placed, uint32_t primitive, float u, float v,
                    const float direction[2]) const;
  // z_0 where light lands, but for its film position, P_A and W_e; false where light comes from behind.
  bool receive(const ReceivingInstance& placed, const Landing& landing, SensorPoint& z0) const;

  // Of the scene, the outputs and the normals.
  uint64_t base_hash() const;

  const std::shared_ptr<const Scene> scene_;

 private:
  Outputs outputs_;
  bool geometric_normals_, responds_, hittable_;
  HemisphereSampler hemisphere_;
};

}  // namespace bdpt
