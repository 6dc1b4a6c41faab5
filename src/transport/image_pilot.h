// What a few samples tell of each region of the image: how much they vary, and what they cost. Their random numbers are
// reserved and they measure nothing, so every range of passes learns the same. Costs are counted in rays, never in
// seconds.
#pragma once

#include "transport/block.h"
#include "transport/light_pool.h"
#include "transport/region_grid.h"

#include <vector>

namespace bdpt {

class ImagePilot {
 public:
  explicit ImagePilot(const Engine& engine);
  // First the pool, for plans that have one; then the rows. Tasks of a kind in parallel.
  uint32_t pool_tasks() const { return pool_.pieces(); }
  void fill_pool(Block& block, uint32_t task);
  void finish_pool() { pool_.finish(engine_.options.pool_selection); }
  uint32_t row_tasks() const { return uint32_t(grid_.rows()); }
  void run_row(Block& block, uint32_t task);

  const RegionGrid& grid() const { return grid_; }
  std::vector<RegionMeasure> measures() const;
  // Of the eye samples alone, t >= 2; rays: of one more eye sample, with the light subpaths that it brings.
  const std::vector<RegionMeasure>& eye_measures() const { return regions_; }

 private:
  PixelRect square(const PixelRect& region, int column, int row, uint32_t i) const;
  void measure_square(Block& block, const PixelRect& square, uint32_t row, RegionMeasure& region);

  const Engine& engine_;
  RegionGrid grid_;
  uint32_t passes_, squares_;
  LightPool pool_;
  std::vector<RegionMeasure> regions_;             // the eye's part
  std::vector<std::vector<RegionMeasure>> light_;  // the light image's part, by tasks
  std::vector<uint64_t> pool_rays_;
};

}  // namespace bdpt
