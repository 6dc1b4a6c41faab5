// The host's functions of a material, as the renderer calls them.
#pragma once

#include "api/check.h"
#include "bdpt.h"
#include "material/host.h"

#include <memory>

namespace bdpt {

// Throws where desc is incomplete; nothing is called then.
std::shared_ptr<const HostMaterial> read_host_material(const Subject& material, const bdpt_host_material& desc);

}  // namespace bdpt
