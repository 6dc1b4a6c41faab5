#include "light/sky.h"

#include <numbers>

namespace bdpt {

namespace {

// Appendix A.2: each coefficient A to E is slope T + offset.
constexpr double kSlope[3][5] = {{0.1787, -0.3554, -0.0227, 0.1206, -0.0670},
                                 {-0.0193, -0.0665, -0.0004, -0.0641, -0.0033},
                                 {-0.0167, -0.0950, -0.0079, -0.0441, -0.0109}};
constexpr double kOffset[3][5] = {{-1.4630, 0.4275, 5.3251, -2.5771, 0.3703},
                                  {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452},
                                  {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529}};
// The chromaticities at the zenith, by powers of the turbidity, from T² down, and of the sun's angle, from the third.
constexpr double kZenith[2][3][4] = {
    {{0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}},
    {{0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}}};

double angle_between(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(double(dot(a, b)), -1.0, 1.0)); }

}  // namespace

Sky::Sky(const Vec3& to_sun, double turbidity) : to_sun_(to_sun) {
  const double t = turbidity, sun = angle_between(to_sun, Vec3(0, 1, 0));
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 5; ++k) coefficient_[i][k] = kSlope[i][k] * t + kOffset[i][k];
  const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * sun);
  zenith_[0] = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  for (int i = 0; i < 2; ++i) {
    double value = 0;
    for (const auto& row : kZenith[i]) value = value * t + ((row[0] * sun + row[1]) * sun + row[2]) * sun + row[3];
    zenith_[i + 1] = value;
  }
  for (int i = 0; i < 3; ++i) at_zenith_[i] = perez(i, 1, sun);
}

double Sky::perez(int i, double cos_theta, double gamma) const {
  const double* c = coefficient_[i];
  const double cosine = std::cos(gamma);
  return (1 + c[0] * std::exp(c[1] / cos_theta)) * (1 + c[2] * std::exp(c[3] * gamma) + c[4] * cosine * cosine);
}

Rgb Sky::radiance(const Vec3& w) const {
  const double cos_theta = std::max(double(w.y), 1e-3), gamma = angle_between(w, to_sun_);
  double v[3];
  for (int i = 0; i < 3; ++i) v[i] = zenith_[i] * perez(i, cos_theta, gamma) / at_zenith_[i];
  const double luminance = std::max(v[0], 0.0), x = luminance * v[1] / v[2], z = luminance * (1 - v[1] - v[2]) / v[2];
  const auto positive = [](double c) { return float(std::max(c, 0.0)); };
  return {positive(3.2404542 * x - 1.5371385 * luminance - 0.4985314 * z),
          positive(-0.9692660 * x + 1.8760108 * luminance + 0.0415560 * z),
          positive(0.0556434 * x - 0.2040259 * luminance + 1.0572252 * z)};
}

}  // namespace bdpt
