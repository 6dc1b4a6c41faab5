// From the host's arrays to a mesh: checked, copied or borrowed.
#pragma once

#include "api/host_calls.h"
#include "base/memory.h"
#include "geometry/mesh.h"

#include <memory>

namespace bdpt {

// The releases that a mesh description brings. They are owed from the moment it can be read, so also when it is then
// refused; of a struct whose size is that of no version, nothing can be read and nothing is called.
class MeshReleases {
 public:
  explicit MeshReleases(const bdpt_mesh_desc* desc);
  FinalCall positions, indices, normals, uv[2], colors, tangents;

 private:
  explicit MeshReleases(const bdpt_mesh_desc& desc);
};

// Throws InvalidArgument, MemoryLimit. Of the releases it takes those whose data the mesh borrows.
std::shared_ptr<const Mesh> read_mesh(const bdpt_mesh_desc& desc, MeshReleases& releases,
                                      const std::shared_ptr<MemoryMeter>& meter);

}  // namespace bdpt
