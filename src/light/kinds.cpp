#include "light/kinds.h"

namespace bdpt {

const LightKind* const kLightKinds[] = {
    &kMeshLight, &kSphereLight, &kPointLight, &kSpotLight, &kEnvironmentLight,
};

std::unique_ptr<LightData> make_light(const LightDesc& desc, Light& light) {
  switch (desc.type) {
    case LightType::Point:
      return make_point(desc, light);
    case LightType::Spot:
      return make_spot(desc, light);
    case LightType::Environment:
      return make_environment(desc, light);
  }
  return nullptr;
}

}  // namespace bdpt
