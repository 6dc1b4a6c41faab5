#include "light/kinds.h"

namespace bdpt {

const LightKind* const kLightKinds[] = {
    &kMeshLight,           &kTexturedMeshLight, &kSphereLight, &kPointLight,     &kSpotLight,        &kEnvironmentLight,
    &kEnvironmentMapLight, &kDirectionalLight,  &kSunLight,    &kProjectorLight, &kPhotometricLight,
};

std::unique_ptr<LightData> make_light(const LightDesc& desc, Light& light) {
  switch (desc.type) {
    case LightType::Point:
      return desc.photometry ? make_photometric(desc, light) : make_point(desc, light);
    case LightType::Spot:
      return desc.texture ? make_projector(desc, light) : make_spot(desc, light);
    case LightType::Environment:
      return desc.texture ? make_environment_map(desc, light) : make_environment(desc, light);
    case LightType::Directional:
      return desc.angular_radius > 0 ? make_sun(desc, light) : make_directional(desc, light);
  }
  return nullptr;
}

}  // namespace bdpt
