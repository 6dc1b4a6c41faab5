#include "material/albedo.h"

#include "material/fresnel.h"
#include "material/sheen.h"

namespace bdpt {
namespace {

constexpr int kSteps = 20;     // along each number that a microfacet is sampled with
constexpr float kTurn = 0.6f;  // fitted: seen along the smoother direction, an anisotropic surface seems rougher

// A place between the nodes of one axis.
struct Place {
  int node;
  float part;  // of the node after
};

// Of x in [0,1] among n nodes from 0 to 1.
Place place(float x, int n) {
  const float at = std::clamp(x, 0.0f, 1.0f) * float(n - 1);
  const int node = std::min(int(at), n - 2);
  return {node, at - float(node)};
}

// Near the horizon albedos change fast: nodes are even in the root of the cosine.
Place place_of_cosine(float cosine, int n) { return place(safe_sqrt(cosine), n); }
float cosine_at(int i, int n) { return sqr(float(i) / float(n - 1)); }
// Above the tables' lowest, below which all cosines count as it.
float usable_cosine_at(int i, int n) { return std::max(cosine_at(i, n), 1e-4f); }

// Of small alphas, too.
Place place_of_alpha(float alpha, int n) { return place(safe_sqrt(alpha), n); }
float alpha_at(int i, int n) { return sqr(float(i) / float(n - 1)); }

float mix(float a, float b, float t) { return a + (b - a) * t; }

template <int n>
float at(const float (&row)[n], const Place& c) {
  return mix(row[c.node], row[c.node + 1], c.part);
}
template <int m, int n>
float at(const float (&table)[m][n], const Place& a, const Place& c) {
  return mix(at(table[a.node], c), at(table[a.node + 1], c), a.part);
}

// The integral of 2 cos d(cos) over what lies between the nodes of a row.
template <int n>
float mean(const float (&row)[n]) {
  double sum = 0;
  for (int i = 0; i + 1 < n; ++i) {
    // With x the root of the cosine: 4 x^3 dx of a linear function, by its antiderivatives.
    const double x0 = double(i) / (n - 1), x1 = double(i + 1) / (n - 1), h = x1 - x0;
    const double fourth = x1 * x1 * x1 * x1 - x0 * x0 * x0 * x0,
                 fifth = 0.8 * (x1 * x1 * x1 * x1 * x1 - x0 * x0 * x0 * x0 * x0);
    const double slope = (double(row[i + 1]) - double(row[i])) / h;
    sum += (double(row[i]) - slope * x0) * fourth + slope * fifth;
  }
  return float(sum);
}

Vec3 from(float cosine) { return Vec3(safe_sqrt(1 - cosine * cosine), 0, cosine); }

// Calls function(p, h, part) for microfacet normals that are seen from a direction, and what part they are of all.
template <class Function>
void for_each_visible(const Ggx& ggx, float cosine, const Function& function) {
  const Vec3 p = from(cosine);
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      // Half a turn: the other is its image. And more of the steep ones, few as they are.
      const float u0 = 0.5f * (float(i) + 0.5f) / kSteps, rest = (float(j) + 0.5f) / kSteps;
      function(p, ggx.sample_visible(p, u0, 1 - rest * rest), 2 * rest / (kSteps * kSteps));
    }
}

// G2 / G1.
float unshadowed(const Ggx& ggx, const Vec3& p, const Vec3& n) {
  return smith_g2_over_g1(p.z, ggx.stretched_length(p), std::fabs(n.z), ggx.stretched_length(n));
}

}  // namespace

const MetalAlbedo& MetalAlbedo::get() {
  static const MetalAlbedo albedo;
  return albedo;
}

MetalAlbedo::MetalAlbedo() {
  for (int a = 0; a < kAlphas; ++a) {
    const float alpha = alpha_at(a, kAlphas);
    for (int c = 0; c < kCosines; ++c) {
      const float cosine = usable_cosine_at(c, kCosines);
      double all = 0, grazing = 0;
      if (a == 0) {
        all = 1, grazing = schlick_part(cosine);
      } else {
        const Ggx ggx(alpha, alpha);
        for_each_visible(ggx, cosine, [&](const Vec3& p, const Vec3& h, float part) {
          const float cos_h = dot(p, h);
          const Vec3 n = h * (2 * cos_h) - p;
          if (!(n.z > 0)) return;
          const float weight = part * unshadowed(ggx, p, n);
          all += weight, grazing += weight * schlick_part(cos_h);
        });
      }
      all_[a][c] = float(all), grazing_[a][c] = float(grazing);
    }
    all_mean_[a] = mean(all_[a]), grazing_mean_[a] = mean(grazing_[a]);
  }
}

float MetalAlbedo::all(float alpha, float cosine) const {
  return at(all_, place_of_alpha(alpha, kAlphas), place_of_cosine(cosine, kCosines));
}
float MetalAlbedo::all_mean(float alpha) const { return at(all_mean_, place_of_alpha(alpha, kAlphas)); }
SchlickAlbedo MetalAlbedo::both(float alpha, float cosine) const {
  const Place a = place_of_alpha(alpha, kAlphas), c = place_of_cosine(cosine, kCosines);
  return {at(all_, a, c), at(grazing_, a, c)};
}
SchlickAlbedo MetalAlbedo::both_mean(float alpha) const {
  const Place a = place_of_alpha(alpha, kAlphas);
  return {at(all_mean_, a), at(grazing_mean_, a)};
}

const BoundaryAlbedo& BoundaryAlbedo::get() {
  static const BoundaryAlbedo albedo;
  return albedo;
}

BoundaryAlbedo::BoundaryAlbedo() {
  float etas[kEtas];
  for (int e = 0; e < kEtas; ++e) etas[e] = float(std::pow(10, 2.0 * e / (kEtas - 1) - 1));
  double reflected[kEtas], all[kEtas];
  for (int a = 0; a < kAlphas; ++a) {
    const float alpha = alpha_at(a, kAlphas);
    const Ggx ggx(alpha, alpha);
    for (int c = 0; c < kCosines; ++c) {
      const float cosine = usable_cosine_at(c, kCosines);
      std::fill(reflected, reflected + kEtas, 0), std::fill(all, all + kEtas, 0);
      for_each_visible(ggx, cosine, [&](const Vec3& p, const Vec3& h, float part) {
        const float cos_h = dot(p, h);
        if (!(cos_h > 0)) return;
        const Vec3 r = h * (2 * cos_h) - p;
        const float weight = r.z > 0 ? part * unshadowed(ggx, p, r) : 0;
        for (int e = 0; e < kEtas; ++e) {
          const float eta = etas[e], cos2_t = refracted_cosine_squared(cos_h, eta), cos_t = safe_sqrt(cos2_t);
          const float reflectance = cos2_t > 0 ? fresnel_dielectric(cos_h, cos_t, eta) : 1;
          reflected[e] += reflectance * weight;
          all[e] += reflectance * weight;
          if (!(reflectance < 1)) continue;
          const Vec3 t = h * (cos_h / eta - cos_t) - p * (1 / eta);
          if (t.z < 0) all[e] += (1 - reflectance) * part * unshadowed(ggx, p, t);
        }
      });
      for (int e = 0; e < kEtas; ++e) {
        reflected_[e][a][c] = float(reflected[e]);
        all_[e][a][c] = a == 0 ? 1 : float(all[e]);
      }
    }
    for (int e = 0; e < kEtas; ++e) reflected_mean_[e][a] = mean(reflected_[e][a]), all_mean_[e][a] = mean(all_[e][a]);
  }
}

BoundaryAlbedo::Eta BoundaryAlbedo::at(float eta) {
  const Place p = place(0.5f + 0.5f * std::log10(eta), kEtas);
  return {p.node, p.part};
}
BoundaryAlbedo::Eta BoundaryAlbedo::Eta::reciprocal() const { return {kEtas - 2 - node, 1 - part}; }

float BoundaryAlbedo::reflected(float alpha, float cosine, const Eta& e) const {
  const Place a = place_of_alpha(alpha, kAlphas), c = place_of_cosine(cosine, kCosines);
  return mix(bdpt::at(reflected_[e.node], a, c), bdpt::at(reflected_[e.node + 1], a, c), e.part);
}
float BoundaryAlbedo::reflected_mean(float alpha, const Eta& e) const {
  return bdpt::at(reflected_mean_, {e.node, e.part}, place_of_alpha(alpha, kAlphas));
}
float BoundaryAlbedo::all(float alpha, float cosine, const Eta& e) const {
  const Place a = place_of_alpha(alpha, kAlphas), c = place_of_cosine(cosine, kCosines);
  return mix(bdpt::at(all_[e.node], a, c), bdpt::at(all_[e.node + 1], a, c), e.part);
}
float BoundaryAlbedo::all_mean(float alpha, const Eta& e) const {
  return bdpt::at(all_mean_, {e.node, e.part}, place_of_alpha(alpha, kAlphas));
}

const SheenAlbedo& SheenAlbedo::get() {
  static const SheenAlbedo albedo;
  return albedo;
}

SheenAlbedo::SheenAlbedo() {
  constexpr int kTurns = 32, kHeights = 32;
  for (int a = 0; a < kAlphas; ++a) {
    const Sheen sheen(alpha_at(a, kAlphas));
    for (int c = 0; c < kCosines; ++c) {
      const Vec3 p = from(usable_cosine_at(c, kCosines));
      double sum = 0;
      for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kTurns; ++j) {
          const float z = (float(i) + 0.5f) / kHeights, r = safe_sqrt(1 - z * z),
                      phi = kPi * (float(j) + 0.5f) / kTurns;
          sum += double(sheen.f(p, Vec3(r * std::cos(phi), r * std::sin(phi), z)) * z);
        }
      all_[a][c] = float(sum * 2 * M_PI / (kTurns * kHeights));
    }
  }
}

float SheenAlbedo::all(float alpha, float cosine) const {
  return at(all_, place_of_alpha(alpha, kAlphas), place_of_cosine(cosine, kCosines));
}

float isotropic_alpha(const Ggx& ggx, const Vec3& v) {
  if (ggx.alpha_u == ggx.alpha_v) return ggx.alpha_u;
  const float turn = 0.5f * kTurn * (v.x * v.x - v.y * v.y);
  return std::sqrt(sqr(ggx.alpha_u) * (0.5f - turn) + sqr(ggx.alpha_v) * (0.5f + turn));
}

}  // namespace bdpt
