// Points that are one within a tolerance.
#pragma once

#include "lightmap/uv_mesh.h"

#include <array>
#include <unordered_map>

namespace bdpt {

class Weld {
 public:
  explicit Weld(double tolerance) : tolerance_(tolerance) {}

  // The number of the first point that was given and lies within the tolerance along each axis: itself if none does.
  uint32_t point(const Vec3d& p);

 private:
  using Cell = std::array<double, 3>;
  struct Hash {
    size_t operator()(const Cell& cell) const;
  };

  double tolerance_;
  std::vector<Vec3d> points_;
  std::unordered_map<Cell, std::vector<uint32_t>, Hash> cells_;  // of twice the tolerance
};

}  // namespace bdpt
