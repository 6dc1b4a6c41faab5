// The directives before WorldBegin but the camera: film, pixel filter, sampler, integrator.
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pbrt/params.h"
#include "scene_description.h"

namespace bdpt_tool {

void read_film(const std::string& type, const ParamList& params, SceneDescription& scene, Diagnostics& diagnostics);
void read_filter(const std::string& type, const ParamList& params, SceneDescription& scene, Diagnostics& diagnostics);
void read_sampler(const std::string& type, const ParamList& params, SceneDescription& scene, Diagnostics& diagnostics);
void read_integrator(const std::string& type, const ParamList& params, SceneDescription& scene,
                     Diagnostics& diagnostics);

}  // namespace bdpt_tool
