// The textures that vary a material.
#pragma once

#include "api/builder.h"
#include "api/check.h"

namespace bdpt {

// Reads what a material's description says of textures, by checked slots, into the entry.
void read_texture_uses(bdpt_builder& builder, const Subject& material, const bdpt_material_desc& desc,
                       MaterialEntry& entry);

}  // namespace bdpt
