// From the host's arrays to a subdivision surface, and to the mesh that it becomes.
#pragma once

#include "api/host_calls.h"
#include "base/memory.h"
#include "bdpt.h"
#include "geometry/embree.h"
#include "geometry/mesh.h"

#include <array>
#include <memory>

namespace bdpt {

// The releases that a description of a subdivision surface brings; see MeshReleases. All data is copied.
class SubdivisionReleases {
 public:
  explicit SubdivisionReleases(const bdpt_subdivision_desc* desc);

 private:
  explicit SubdivisionReleases(const bdpt_subdivision_desc& desc);
  std::array<FinalCall, 9> calls_;
};

// Throws InvalidArgument, MemoryLimit, OutOfMemory, CallbackFailed.
std::shared_ptr<const Mesh> read_subdivision(const bdpt_subdivision_desc& desc, const RayDevice& device,
                                             const std::shared_ptr<MemoryMeter>& meter);

}  // namespace bdpt
