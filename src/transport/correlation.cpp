#include "transport/correlation.h"

#include <algorithm>
#include <vector>

namespace bdpt {

namespace {

// Near is within a degree, seen from the sensor through a field of view of 45 degrees: so large a part of the image,
// and of the directions of a light without a place. What the image shows of x_{k-1} per area is the eye's density
// there, so that A is this part over it.
constexpr double kPartOfImage = 1.4e-3, kDirections = 9.6e-4;

}  // namespace

void count_correlated(const PathTechniques& path, double* n) {
  const int k = path.count - 1;
  if (k < 3 || !(path.counts.connections > 1)) return;
  const PathVertex* x = path.vertices;
  const double area = kPartOfImage / x[k - 1].eye;
  // The chance of x_i, given the vertex before it on its side: behind a specular one there is no choice.
  const auto near = [&](double density, const PathVertex& before) {
    return before.specular ? 1 : std::min(1.0, area * density);
  };
  // What the light's side has come by up to x_i: y_0 ... y_i. A light without area is found by its choice alone.
  std::vector<double> light(static_cast<size_t>(k));
  const double extent = !path.corner_exists ? kDirections : path.s0_exists ? area : 1;
  light[0] = std::min(1.0, extent * x[0].light);
  for (int i = 1; i < k; ++i) light[size_t(i)] = light[size_t(i) - 1] * near(x[i].light, x[i - 1]);
  // The same of the eye's side. Within a pixel its first vertex is all but known.
  double eye = 1;
  for (int i = k - 1; i >= 2; --i) {
    if (i < k - 1) eye *= near(x[i].eye, x[i + 1]);
    const double other = light[size_t(i) - 1], both = eye + other - eye * other;
    if (n[i] > 1 && both > 0) n[i] = std::max(1.0, n[i] * (eye / both));
  }
}

}  // namespace bdpt
