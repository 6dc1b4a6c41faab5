// Outputs of cameras, as the host asks for them.
#pragma once

#include "api/check.h"
#include "api/desc.h"
#include "sensor/sensor.h"

#include <vector>

namespace bdpt {

// The picture, and what is asked for beside it.
std::vector<OutputPlanes> read_camera_outputs(const Subject& camera, const bdpt_camera_desc& desc);

}  // namespace bdpt
