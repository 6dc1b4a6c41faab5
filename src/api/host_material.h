// The host's functions of a material, as the renderer calls them.
#pragma once

#include "api/check.h"
#include "api/host_calls.h"
#include "bdpt.h"
#include "material/host.h"

#include <memory>

namespace bdpt {

// The drop that is owed for the material's functions, from the moment they can be read.
FinalCall host_drop(const bdpt_material_desc* material);
// Throws where desc is incomplete.
std::shared_ptr<const HostMaterial> read_host_material(const Subject& material, const bdpt_host_material& desc,
                                                       FinalCall drop);

}  // namespace bdpt
