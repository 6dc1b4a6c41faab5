// Chromaticities of the caller.
#pragma once

#include "bdpt.h"
#include "color/primaries.h"

namespace bdpt {

// Rec. 709 where it is NULL. Throws where no colours have them.
Primaries to_primaries(const bdpt_chromaticities* chromaticities);
bdpt_chromaticities to_chromaticities(const Primaries& primaries);

}  // namespace bdpt
