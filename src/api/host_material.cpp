#include "api/host_material.h"

#include "api/desc.h"
#include "render/float_mode.h"

namespace bdpt {
namespace {

void copy(const Vec3& from, float to[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

bdpt_scattering_place place_of(const Material& m, const Rgb& reflectance, const Vec3& previous) {
  bdpt_scattering_place place{};
  copy(previous, place.previous);
  place.reflectance[0] = reflectance.r, place.reflectance[1] = reflectance.g, place.reflectance[2] = reflectance.b;
  place.roughness[0] = m.alpha_u, place.roughness[1] = m.alpha_v;
  return place;
}

class HostFunctions final : public HostMaterial {
 public:
  HostFunctions(const bdpt_host_material& desc, FinalCall drop) : desc_(desc), drop_(std::move(drop)) {
    hash = desc.hash;
  }

  bool evaluate(const Material& m, const Rgb& reflectance, const Vec3& previous, const Vec3& next,
                BsdfValue& value) const override {
    const bdpt_scattering_place place = place_of(m, reflectance, previous);
    float direction[3];
    copy(next, direction);
    bdpt_scattering_value v{};
    const HostFloatMode mode;
    if (desc_.evaluate(desc_.user, &place, direction, &v) != 0) return false;
    value = {to_rgb(v.f), v.density, v.density_reverse};
    return true;
  }
  bool sample(const Material& m, const Rgb& reflectance, const Vec3& previous, const float u[3],
              Vec3& next) const override {
    const bdpt_scattering_place place = place_of(m, reflectance, previous);
    float direction[3] = {};
    const HostFloatMode mode;
    if (desc_.sample(desc_.user, &place, u, direction) != 0) return false;
    next = to_vec3(direction);
    return true;
  }

 private:
  bdpt_host_material desc_;
  FinalCall drop_;
};

}  // namespace

FinalCall host_drop(const bdpt_material_desc* material) {
  const bdpt_host_material* host = is_readable(material) ? copy_readable(*material).host : nullptr;
  if (!is_readable(host)) return {};
  const bdpt_host_material h = copy_readable(*host);
  return {h.drop, h.user};
}

std::shared_ptr<const HostMaterial> read_host_material(const Subject& material, const bdpt_host_material& desc,
                                                       FinalCall drop) {
  material.check_flag("host->transmits", desc.transmits);
  if (!desc.evaluate) material.refuse("host->evaluate", "is NULL: give both functions");
  if (!desc.sample) material.refuse("host->sample", "is NULL: give both functions");
  return std::make_shared<const HostFunctions>(desc, std::move(drop));
}

}  // namespace bdpt
