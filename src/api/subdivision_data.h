// From the host's arrays to a subdivision surface, and to the mesh that it becomes.
#pragma once

#include "api/releases.h"
#include "base/memory.h"
#include "geometry/embree.h"
#include "geometry/mesh.h"

#include <memory>

namespace bdpt {

using SubdivisionReleases =
    Releases<bdpt_subdivision_desc, &bdpt_subdivision_desc::positions, &bdpt_subdivision_desc::face_counts,
             &bdpt_subdivision_desc::indices, &bdpt_subdivision_desc::uv, &bdpt_subdivision_desc::uv_indices,
             &bdpt_subdivision_desc::crease_edges, &bdpt_subdivision_desc::crease_weights,
             &bdpt_subdivision_desc::corners, &bdpt_subdivision_desc::corner_weights>;

// Throws InvalidArgument, MemoryLimit, OutOfMemory, CallbackFailed.
std::shared_ptr<const Mesh> read_subdivision(const bdpt_subdivision_desc& desc, const RayDevice& device,
                                             const std::shared_ptr<MemoryMeter>& meter);

}  // namespace bdpt
