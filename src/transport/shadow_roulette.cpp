#include "transport/shadow_roulette.h"

namespace bdpt {

// delta* of each region, smoothed.
void ShadowRoulette::set_efficient(const RegionGrid& grid, const std::vector<RegionMeasure>& measures) {
  grid_ = grid;
  std::vector<double> squares;
  for (const RegionMeasure& m : measures) squares.push_back(m.variance > 0 && m.rays > 0 ? m.variance / m.rays : 0);
  thresholds_.clear();
  for (double square : grid.smooth(squares)) thresholds_.push_back(float(std::sqrt(square)));
}

}  // namespace bdpt
