// Russian roulette for shadow rays (Veach 10.4): a connection that would add little is tested for visibility with the
// probability q = min(1, c / delta) only, and then counts 1 / q times.
//
// The threshold delta is given, or it is Veach's standard deviation per ray, delta* = sqrt(sigma_0^2 / n_0). He finds
// sigma_0^2 and n_0 from the samples just taken; here a pilot finds them for each region of the image (image_pilot.h),
// so that every range of passes has the same thresholds and no sample decides about itself.
#pragma once

#include "math/vec.h"
#include "transport/region_grid.h"

#include <cmath>
#include <vector>

namespace bdpt {

class ShadowRoulette {
 public:
  bool plays() const { return !thresholds_.empty(); }
  void set_fixed(float threshold) { grid_ = RegionGrid({0, 0, 1, 1}), thresholds_ = {threshold}; }
  void set_efficient(const RegionGrid& grid, const std::vector<RegionMeasure>& measures);
  // q of a contribution to this place of the film.
  float probability(const FilmPosition& film, const Rgb& contribution) const {
    const float c = norm(contribution), threshold = thresholds_[thresholds_.size() == 1 ? 0 : grid_.region(film)];
    return c < threshold ? c / threshold : 1;
  }

 private:
  RegionGrid grid_;
  std::vector<float> thresholds_;
};

}  // namespace bdpt
