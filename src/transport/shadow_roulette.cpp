#include "transport/shadow_roulette.h"

namespace bdpt {

// delta* of each region, smoothed: few samples find few of the rare bright ones, and one that they find must not stop
// the rays of a region. The geometric mean of a region and its neighbours is moved little by either.
void ShadowRoulette::set_efficient(const RegionGrid& grid, const std::vector<RegionMeasure>& measures) {
  grid_ = grid;
  thresholds_.assign(grid.count(), 0);
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      double logs = 0;
      int count = 0;
      for (int y = std::max(0, row - 1); y <= std::min(grid.rows() - 1, row + 1); ++y)
        for (int x = std::max(0, column - 1); x <= std::min(grid.columns() - 1, column + 1); ++x) {
          const RegionMeasure& m = measures[size_t(y) * size_t(grid.columns()) + size_t(x)];
          if (m.variance > 0 && m.rays > 0) logs += 0.5 * std::log(m.variance / m.rays), ++count;
        }
      if (count > 0) thresholds_[size_t(row) * size_t(grid.columns()) + size_t(column)] = float(std::exp(logs / count));
    }
}

}  // namespace bdpt
