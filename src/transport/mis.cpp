#include "transport/mis.h"

#include "transport/correlation.h"

#include <algorithm>
#include <vector>

namespace bdpt {

bool TechniqueClasses::from_mask(const TechniqueMask& mask, const SampleCounts& counts, TechniqueClasses& c) {
  // Paths of one edge share no technique with others: (0,2) and (2,0) may be off together with (1,1).
  const bool one_edge = mask.allows(0, 2) || mask.allows(1, 1) || mask.allows(2, 0);
  const auto count = [&](int s, int t) { return mask.allows(s, t) ? counts.of(s, t) : 0; };
  c.s0 = count(0, 3), c.s1 = count(1, 2), c.t0 = count(3, 0), c.t1 = count(2, 1);
  c.corner = count(1, 1), c.inner = count(2, 2);
  for (int i = 2; i < 32; ++i) {
    if (mask.allows(1, i) != mask.allows(1, 2) || mask.allows(i, 1) != mask.allows(2, 1)) return false;
    if ((one_edge || i > 2) && (mask.allows(0, i) != mask.allows(0, 3) || mask.allows(i, 0) != mask.allows(3, 0)))
      return false;
    for (int j = 2; j < 32; ++j)
      if (mask.allows(i, j) != mask.allows(2, 2)) return false;
  }
  return true;
}

namespace {

bool exists(const PathTechniques& path, const TechniqueMask& mask, int i) {
  const int k = path.count - 1, t = k + 1 - i;
  if (!mask.allows(i, t)) return false;
  if (i == 0) return path.s0_exists;
  if (t == 0) return path.t0_exists && (i > 2 || path.corner_exists);
  if (i == 1 && t == 1 && !path.corner_exists) return false;
  return !path.vertices[i - 1].specular && !path.vertices[i].specular;
}

// n_i p_i in units of p_s.
std::vector<double> densities(const PathTechniques& path, int s, const TechniqueMask& mask,
                              bool correlation_aware = false) {
  const int techniques = path.count + 1;
  // p_i relative to p_s, up and down from s by (10.9), before the corrections for single techniques.
  std::vector<double> p(size_t(path.count) + 1, 1.0);
  const auto own_index = size_t(s);
  for (size_t i = own_index; i + 1 < p.size(); ++i) p[i + 1] = p[i] * path.vertices[i].light / path.vertices[i].eye;
  for (size_t i = own_index; i > 0; --i) p[i - 1] = p[i] * path.vertices[i - 1].eye / path.vertices[i - 1].light;
  // 10.3.4.2: only s = 1 uses the density of direct lighting; (1,1) joins y_0 itself to a camera.
  if (path.count > 2 || path.counts.local) p[1] *= path.direct;
  std::vector<double> n(p.size());
  for (int i = 0; i < techniques; ++i)
    n[size_t(i)] = exists(path, mask, i) ? double(path.counts.of(i, techniques - 1 - i)) : 0;
  if (correlation_aware) count_correlated(path, n.data());
  for (size_t i = 0; i < p.size(); ++i) p[i] *= n[i];
  return p;
}

}  // namespace

double reference_weight(const PathTechniques& path, int s, const TransportOptions& options, const TechniqueMask& mask) {
  std::vector<double> p = densities(path, s, mask, options.correlation_aware);
  const double own = p[size_t(s)];
  if (!(own > 0)) return 0;
  for (double& v : p) v /= own;
  const double largest = *std::max_element(p.begin(), p.end());
  double sum = 0;
  switch (options.heuristic) {
    case Heuristic::Power:
      for (double v : p) sum += std::pow(v, double(options.beta));
      return 1 / sum;
    case Heuristic::Balance:
      for (double v : p) sum += v;
      return 1 / sum;
    case Heuristic::Cutoff:
      if (1 < double(options.cutoff) * largest) return 0;
      for (double v : p)
        if (v >= double(options.cutoff) * largest) sum += v;
      return 1 / sum;
    case Heuristic::Maximum:  // the first of equals
      return std::max_element(p.begin(), p.end()) - p.begin() == s ? 1 : 0;
    case Heuristic::Average:
      for (double v : p) sum += v > 0;
      return 1 / sum;
    case Heuristic::None:
      return 1;
  }
  return 0;
}

TechniqueShares balance_shares(const PathTechniques& path, int s, const TechniqueMask& mask) {
  const std::vector<double> p = densities(path, s, mask);
  double eye = 0, light = 0, all = 0;
  for (int i = 0; i <= path.count; ++i) {
    const int t = path.count - i;
    const double v = p[size_t(i)];
    all += v;
    if (i <= 1 && t >= (path.counts.local ? 1 : 2))
      eye += v;
    else if (t <= 1)
      light += v;
  }
  return {float(eye / all), float(light / all), float(p[size_t(s)] / all)};
}

}  // namespace bdpt
