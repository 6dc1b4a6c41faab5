// The kinds of light; each is defined in the file of its name, and so are the functions that make one.
#pragma once

#include "light/light.h"

#include <memory>

namespace bdpt {

extern const LightKind kMeshLight, kTexturedMeshLight, kSphereLight, kPointLight, kSpotLight, kEnvironmentLight,
    kEnvironmentMapLight, kDirectionalLight, kSunLight, kProjectorLight, kPhotometricLight;

// Of a light without a surface: sets what the kind keeps in the record, and returns what it keeps beyond. center and
// radius are the scene's.
using MakeLight = std::unique_ptr<LightData>(const LightDesc& desc, Light& light);
MakeLight make_point, make_spot, make_environment, make_environment_map, make_directional, make_sun, make_projector,
    make_photometric;

std::unique_ptr<LightData> make_light(const LightDesc& desc, Light& light);

}  // namespace bdpt
