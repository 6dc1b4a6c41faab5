// Reconstruction filters h_j, separable, integrating to one over the plane in pixels (Veach 10.3.1).
#pragma once

#include <cstdint>

namespace bdpt {

enum class FilterType { Box, Tent, Gaussian, Mitchell, BlackmanHarris };

struct FilterDesc {
  FilterType type = FilterType::Box;
  float radius = 0;  // 0 = the filter's own
  float a = 0;       // Gaussian: standard deviation, 0 = 0.5; Mitchell: B
  float b = 0;       // Mitchell: C; B = C = 0 means 1/3 each
};

class Filter {
 public:
  explicit Filter(const FilterDesc& desc);
  float radius() const { return radius_; }
  // The one-dimensional factor at a distance from the pixel's centre; zero beyond the radius.
  float operator()(float x) const;
  static float default_radius(FilterType type);

 private:
  float raw(float x) const;
  FilterType type_;
  float radius_, a_, b_, scale_;
};

}  // namespace bdpt
