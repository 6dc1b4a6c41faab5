#include "lightmap/weld.h"

#include "sampling/hash.h"

namespace bdpt {

size_t Weld::Hash::operator()(const Cell& cell) const {
  const Cell positive{cell[0] + 0.0, cell[1] + 0.0, cell[2] + 0.0};  // -0 equals 0
  return size_t(hash_bytes(positive.data(), sizeof positive, 0));
}

uint32_t Weld::point(const Vec3d& p) {
  const double size = 2 * tolerance_;
  const auto cell = [&](double v) { return std::floor(v / size); };
  uint32_t first = uint32_t(points_.size());
  // What lies within the tolerance is in the cells of the corners of this box; two corners may share one.
  Cell low, high;
  for (int axis = 0; axis < 3; ++axis) {
    low[size_t(axis)] = cell(p[axis] - tolerance_);
    high[size_t(axis)] = cell(p[axis] + tolerance_);
  }
  for (int corner = 0; corner < 8; ++corner) {
    Cell c = low;
    bool twice = false;
    for (size_t axis = 0; axis < 3; ++axis)
      if (corner >> axis & 1) c[axis] = high[axis], twice |= high[axis] == low[axis];
    if (twice) continue;
    const auto found = cells_.find(c);
    if (found == cells_.end()) continue;
    for (const uint32_t i : found->second) {
      const Vec3d d = points_[i] - p;
      if (std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}) <= tolerance_) first = std::min(first, i);
    }
  }
  if (first == points_.size()) {
    points_.push_back(p);
    cells_[{cell(p.x), cell(p.y), cell(p.z)}].push_back(first);
  }
  return first;
}

}  // namespace bdpt
