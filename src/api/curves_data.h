// From the host's arrays to curves: checked, and copied into their unit.
#pragma once

#include "api/host_calls.h"
#include "base/memory.h"
#include "bdpt.h"
#include "geometry/curves.h"

#include <memory>

namespace bdpt {

// The releases that a description of curves brings; see MeshReleases. All data is copied.
class CurvesReleases {
 public:
  explicit CurvesReleases(const bdpt_curves_desc* desc);

 private:
  explicit CurvesReleases(const bdpt_curves_desc& desc);
  FinalCall positions_, radii_, counts_;
};

// Throws InvalidArgument, MemoryLimit.
std::shared_ptr<const Curves> read_curves(const bdpt_curves_desc& desc, const std::shared_ptr<MemoryMeter>& meter);

}  // namespace bdpt
