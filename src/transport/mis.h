// All of the weights' arithmetic (Veach 9.2 and 10.2).
//
// The weight of technique s for a path needs the ratios p_i / p_s of all techniques i = 0 ... k+1, each p_i times the
// number n_i of samples that its technique takes (9.2). By (10.9)
//   p_i / p_{i+1} = other(x_i) / own(x_i)      seen from the light's side, i < s
// with own(x) and other(x) the densities per area with which the light's and the eye's side sample x; and alike with
// the sides exchanged for i > s. Each side's techniques give a norm of ratios
//   S = ( sum_i (n_i p_i / p_s)^beta )^(1/beta),
// and the power heuristic is w = 1 / (1 + (S_L / n_s)^beta + (S_E / n_s)^beta). Norms, not sums of powers: whatever
// beta, the numbers stay within the range of a float.
//
// S is had in constant time from two numbers kept at each vertex. With i the number of the vertex within its subpath
// (y_i or z_i), || || the beta-norm and rev the projected density of sampling x_{i-1} from x_i, given x_{i+1}:
//   S_{i+1} = other(x_i) / own(x_i) || u_i, rev v_i ||
//   v_i     = G(x_i, x_{i-1}) / own(x_{i-1}) || u_{i-1}, rev_{i-1} v_{i-1} ||
//   u_i     = n_i if the technique with i vertices of this side exists, else 0.
// It does not exist when x_{i-1} or x_i is specular (10.3.5) or when it is masked. u_1 of the light's side, the
// technique s = 1, is n_1 P_A^d(y_0) / P_A(y_0) by 10.3.4.2.
#pragma once

#include "transport/options.h"

#include <cmath>
#include <cstdint>

namespace bdpt {

// The norm and the weight for one exponent.
class PowerHeuristic {
 public:
  explicit PowerHeuristic(float beta = 2) : beta_(beta), inverse_(1 / beta), kind_(beta == 2 ? 2 : beta == 1 ? 1 : 0) {}

  // || a, b ||, for a, b >= 0.
  float combine(float a, float b) const {
    const float larger = a > b ? a : b, smaller = a > b ? b : a;
    if (kind_ == 2) {
      if (larger < 1e18f) return std::sqrt(a * a + b * b);
      return std::isinf(larger) ? larger : larger * std::sqrt(1 + (smaller / larger) * (smaller / larger));
    }
    if (kind_ == 1) return a + b;
    if (!(larger > 0) || std::isinf(larger)) return larger;
    return larger * std::pow(1 + std::pow(smaller / larger, beta_), inverse_);
  }
  // 1 / (1 + a^beta + b^beta).
  float weight(float a, float b) const {
    if (kind_ == 2) return 1 / (1 + a * a + b * b);
    if (kind_ == 1) return 1 / (1 + a + b);
    return 1 / (1 + std::pow(a, beta_) + std::pow(b, beta_));
  }

 private:
  float beta_, inverse_;
  int kind_;
};

// n_{s,t}: how many samples each technique takes for one eye subpath. A plan's word.
struct SampleCounts {
  float light = 1;        // light subpaths: (s,0), (s,1)
  float direct = 1;       // fresh light vertices at each eye vertex: (1,t)
  float connections = 1;  // light vertices y_{s-1} met by each eye vertex: (s,t) with both >= 2
  bool local = false;     // sensor: its z_0 is an eye vertex like others, and t = 0 takes
  float pass = 1;         // the light subpaths of a whole pass
  float of(int s, int t) const {
    if (t == 0) return local ? pass : light;
    if (t == 1 && !local) return light;
    return s == 0 ? 1 : s == 1 ? direct : connections;
  }
};

// The same by classes of techniques, for the running sums: they cannot tell one technique between the ends from
// another. 0 where a class does not take part.
struct TechniqueClasses {
  float s0 = 1, s1 = 1, t0 = 1, t1 = 1;  // (0,t), (1,t), (s,0), (s,1) with the other count >= 2
  float corner = 1;                      // (1,1)
  float inner = 1;                       // (s,t) with both >= 2
  // True if the mask says the same of every technique within each class.
  static bool from_mask(const TechniqueMask& mask, const SampleCounts& counts, TechniqueClasses& classes);
};

// One vertex of a whole path, for the reference below.
struct PathVertex {
  double light;  // density with which the light's side samples it
  double eye;    // density with which the eye's side does
  bool specular;
};

// The plain loop over (10.9): the reference for the running sums, and the way of the heuristics that are not sums.
// vertices are x_0 ... x_k; direct is P_A^d(x_0) / P_A(x_0); s0_exists is false where eye subpaths cannot hit x_0,
// t0_exists where light subpaths cannot hit x_k, corner_exists where neither (1,1) nor (2,0) is done: x_0 is no point.
struct PathTechniques {
  const PathVertex* vertices;
  int count;  // k + 1
  double direct = 1;
  bool s0_exists = true, t0_exists = true, corner_exists = true;
  SampleCounts counts{};
};
double reference_weight(const PathTechniques& path, int s, const TransportOptions& options, const TechniqueMask& mask);
inline double reference_weight(const PathTechniques& path, int s, const TransportOptions& options) {
  return reference_weight(path, s, options, options.techniques);
}

// What the balance heuristic gives to the techniques of a path, by kinds; the rest is that of inner connections.
struct TechniqueShares {
  float eye = 0, light = 0;  // s <= 1 and t >= 2, of a local sensor t >= 1; all else with t <= 1
  float own = 0;             // the weight of the technique that the path came by
};
// s: the technique that the path came by.
TechniqueShares balance_shares(const PathTechniques& path, int s, const TechniqueMask& mask);

}  // namespace bdpt
