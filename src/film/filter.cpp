#include "film/filter.h"

#include <cmath>

namespace bdpt {

float Filter::default_radius(FilterType type) {
  switch (type) {
    case FilterType::Box:
      return 0.5f;
    case FilterType::Tent:
      return 1;
    case FilterType::Gaussian:
      return 1.5f;
    case FilterType::Mitchell:
    case FilterType::BlackmanHarris:
      return 2;
  }
  return 0.5f;
}

Filter::Filter(const FilterDesc& desc) : type_(desc.type), radius_(desc.radius), a_(desc.a), b_(desc.b), scale_(1) {
  if (radius_ == 0) radius_ = default_radius(type_);
  if (type_ == FilterType::Gaussian && a_ == 0) a_ = 0.5f;
  if (type_ == FilterType::Mitchell && a_ == 0 && b_ == 0) a_ = b_ = 1.0f / 3;
  // The midpoint rule with 4096 steps: the integral to far better than a float.
  constexpr int steps = 4096;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += raw(radius_ * float((i + 0.5) / steps));
  scale_ = float(1 / (2 * double(radius_) * sum / steps));
}

float Filter::raw(float x) const {
  x = std::fabs(x);
  switch (type_) {
    case FilterType::Box:
      return 1;
    case FilterType::Tent:
      return 1 - x / radius_;
    case FilterType::Gaussian: {
      const auto g = [this](float v) { return std::exp(-v * v / (2 * a_ * a_)); };
      return std::fmax(0.0f, g(x) - g(radius_));
    }
    case FilterType::Mitchell: {  // Mitchell and Netravali (1988), stretched to the radius
      const float v = 2 * x / radius_, B = a_, C = b_;
      if (v >= 2) return 0;
      if (v >= 1)
        return ((-B - 6 * C) * v * v * v + (6 * B + 30 * C) * v * v + (-12 * B - 48 * C) * v + (8 * B + 24 * C)) / 6;
      return ((12 - 9 * B - 6 * C) * v * v * v + (-18 + 12 * B + 6 * C) * v * v + (6 - 2 * B)) / 6;
    }
    case FilterType::BlackmanHarris: {
      const float v = 3.14159265f * (x / radius_ + 1);
      return 0.35875f - 0.48829f * std::cos(v) + 0.14128f * std::cos(2 * v) - 0.01168f * std::cos(3 * v);
    }
  }
  return 0;
}

float Filter::operator()(float x) const {
  // Half open, so that a box of radius 0.5 gives each point to one pixel.
  if (!(x >= -radius_ && x < radius_)) return 0;
  return scale_ * raw(x);
}

}  // namespace bdpt
