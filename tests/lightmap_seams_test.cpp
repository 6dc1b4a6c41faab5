// The solution is the minimum of what it says it minimises.
#include "lightmap/seams.h"

#include <gtest/gtest.h>

#include <random>

namespace bdpt::lightmap_seams_test {

constexpr uint32_t kSide = 12;
using Pixels = std::vector<double>;

double lookup(const Pixels& pixels, const Vec2d& point) {
  double sum = 0;
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x)
      sum += pixels[y * kSide + x] * std::max(0.0, 1 - std::fabs(point.x - x - 0.5)) *
             std::max(0.0, 1 - std::fabs(point.y - y - 0.5));
  return sum;
}

// By its definition; no seam is within half a texel of the border.
double objective(const std::vector<Seam>& seams, const Pixels& pixels, const Pixels& original, double lambda) {
  double sum = 0;
  for (const Seam& s : seams) {
    const double length = std::max((s.a.to - s.a.from).length(), (s.b.to - s.b.from).length());
    const int n = std::max(1, int(std::ceil(2 * length)));
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) / n;
      const double d =
          lookup(pixels, s.a.from + (s.a.to - s.a.from) * t) - lookup(pixels, s.b.from + (s.b.to - s.b.from) * t);
      sum += length / n * d * d;
    }
  }
  for (size_t i = 0; i < pixels.size(); ++i) sum += lambda * (pixels[i] - original[i]) * (pixels[i] - original[i]);
  return sum;
}

TEST(LightmapSeams, TheSolutionIsTheMinimum) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(1, kSide - 1), value(0, 1);
  for (const double lambda : {0.001, 0.1, 10.0}) {
    std::vector<Seam> seams(5);
    for (Seam& s : seams)
      for (SeamSide* side : {&s.a, &s.b}) {
        side->from = Vec2d(place(random), place(random));
        side->to = Vec2d(place(random), place(random));
      }
    std::vector<float> pixels(kSide * kSide);
    for (float& v : pixels) v = float(value(random));
    SeamSolve options;
    options.channels = 1;
    options.lambda = lambda;
    options.tolerance = 1e-10;
    const SeamFix fix = solve_seams(seams, {{kSide, kSide, pixels.data(), nullptr}}, options);
    EXPECT_TRUE(fix.converged);
    const Pixels original(pixels.begin(), pixels.end());
    Pixels solved = original;
    for (size_t i = 0; i < fix.texels.size(); ++i) solved[fix.texels[i].texel] = fix.values[i];
    const double least = objective(seams, solved, original, lambda);
    EXPECT_LT(least, objective(seams, original, original, lambda));
    for (size_t i = 0; i < solved.size(); ++i)
      for (const double step : {-0.01, 0.01}) {
        Pixels moved = solved;
        moved[i] += step;
        // Along any axis it rises by at least lambda times the square of the step, but for the floats' rounding.
        EXPECT_GT(objective(seams, moved, original, lambda), least + 0.9 * lambda * step * step - 1e-7);
      }
  }
}

}  // namespace bdpt::lightmap_seams_test
