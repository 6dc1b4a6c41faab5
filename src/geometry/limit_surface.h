// The limit of Catmull and Clark's subdivision, by Embree. Beside embree.cpp, this pair of files is the only one that
// knows Embree.
#pragma once

#include "geometry/embree.h"
#include "geometry/subdivision.h"

#include <cstdint>
#include <vector>

namespace bdpt {

class LimitSurface {
 public:
  // Both must live on. Throws MemoryLimit, OutOfMemory.
  LimitSurface(const RayDevice& device, const ControlCage& cage);
  ~LimitSurface();
  LimitSurface(const LimitSurface&) = delete;
  LimitSurface& operator=(const LimitSurface&) = delete;

  // Position, and unit normal (zero where there is none), at places of a face: u goes from its corner `quad` to the
  // next, v to the one before, whole edges of a face of four corners (then quad is 0), halves of them of any other.
  void evaluate(uint32_t face, uint32_t quad, const std::vector<Vec2>& uv, std::vector<Vec3>& positions,
                std::vector<Vec3>& normals) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bdpt
