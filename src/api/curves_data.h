// From the host's arrays to curves: checked, and copied into their unit.
#pragma once

#include "api/releases.h"
#include "base/memory.h"
#include "geometry/curves.h"

#include <memory>

namespace bdpt {

using CurvesReleases =
    Releases<bdpt_curves_desc, &bdpt_curves_desc::positions, &bdpt_curves_desc::radii, &bdpt_curves_desc::counts>;

// Throws InvalidArgument, MemoryLimit.
std::shared_ptr<const Curves> read_curves(const bdpt_curves_desc& desc, const std::shared_ptr<MemoryMeter>& meter);

}  // namespace bdpt
