// The colour of a clear sky: Preetham, Shirley and Smits, A Practical Analytic Model for Daylight (1999).
#pragma once

#include "math/vec.h"

namespace bdpt {

class Sky {
 public:
  // to_sun: unit, above the horizon, +y up. turbidity: of haze, 1.7 to 10.
  Sky(const Vec3& to_sun, double turbidity);
  // Linear Rec. 709, its Y in kcd/m²; w: unit, above the horizon.
  Rgb radiance(const Vec3& w) const;
  // Y alone at the zenith.
  double zenith() const { return zenith_[0]; }

 private:
  // The five coefficients of Perez's function and the value at the zenith, for Y, x and y.
  double perez(int i, double cos_theta, double gamma) const;

  Vec3 to_sun_;
  double coefficient_[3][5], zenith_[3], at_zenith_[3];
};

}  // namespace bdpt
