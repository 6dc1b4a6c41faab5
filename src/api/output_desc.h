// Outputs of sensors, as the host asks for them.
#pragma once

#include "api/check.h"
#include "api/desc.h"
#include "bake/outputs.h"

namespace bdpt {

// The outputs asked for; `otherwise` alone where none are.
std::vector<OutputDesc> read_outputs(const Subject& sensor, const bdpt_output_desc* outputs, uint32_t count,
                                     uint32_t stride, OutputKind otherwise);

}  // namespace bdpt
