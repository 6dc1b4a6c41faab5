// From the host's instances to meshes in the world and in their atlases.
#pragma once

#include "bdpt.h"
#include "lightmap/uv_mesh.h"

#include <functional>

namespace bdpt {

struct AtlasSize {
  uint32_t width, height;
};

// size_of(atlas) is called for each instance; it may throw for an atlas that there is not. Throws InvalidArgument.
std::vector<UvMesh> read_uv_instances(const bdpt_uv_instance* instances, uint32_t count, uint32_t stride,
                                      const std::function<AtlasSize(uint32_t atlas)>& size_of);

}  // namespace bdpt
