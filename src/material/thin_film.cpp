#include "material/thin_film.h"

#include "material/fresnel.h"

#include <array>

namespace bdpt {
namespace {

constexpr float kLeastCosine = 1e-4f;
constexpr float kMostF0 = 0.9999f;           // more has no finite index
constexpr double kFirst = 360, kLast = 830;  // nanometres that are seen

double lobe(double x, double mean, double below, double above) {
  const double t = (x - mean) / (x < mean ? below : above);
  return std::exp(-t * t / 2);
}

// The CIE 1931 observer. Source: Wyman, Sloan and Shirley (2013), the fit by several lobes.
std::array<double, 3> observer(double x) {
  return {1.056 * lobe(x, 599.8, 37.9, 31.0) + 0.362 * lobe(x, 442.0, 16.0, 26.7) - 0.065 * lobe(x, 501.1, 20.4, 26.2),
          0.821 * lobe(x, 568.8, 46.9, 40.5) + 0.286 * lobe(x, 530.9, 16.3, 31.1),
          1.217 * lobe(x, 437.0, 11.8, 36.0) + 0.681 * lobe(x, 459.0, 26.0, 13.8)};
}

// From XYZ to linear Rec. 709, equal energy being white (Bradford).
constexpr double kToRgb[3][3] = {
    {3.1466577, -1.6664638, -0.4801939}, {-0.9955216, 1.9557567, 0.0397649}, {0.0635948, -0.2145632, 1.1509684}};

float index_of(float f0) {
  const float root = std::sqrt(std::min(f0, kMostF0));
  return (1 + root) / (1 - root);
}

// Real, of light that comes through i: across the plane of incidence, and in it.
struct Amplitudes {
  float s, p;
  Amplitudes(float cos_i, float index_i, float cos_t, float index_t)
      : s((index_i * cos_i - index_t * cos_t) / (index_i * cos_i + index_t * cos_t)),
        p((index_t * cos_i - index_i * cos_t) / (index_t * cos_i + index_i * cos_t)) {}
};

// Of Airy's sums, the mean of both polarisations: what the tables' cosines are multiplied by, and the bounds for any.
struct Airy {
  float sum = 0, first = 0, second = 0, rest = 0;
  float least = 0, most = 0;

  Airy(const Amplitudes& outer, const Amplitudes& inner) { add(outer.s, inner.s), add(outer.p, inner.p); }

  float reflectance(float cos1, float cos2, float cos3) const {
    return std::clamp(1 - sum - first * cos1 - second * cos2 - rest * cos3, least, most);
  }

 private:
  void add(float r, float r_inner) {
    const float a = r * r_inner, size = std::fabs(a);
    const float k = (1 - r * r) * (1 - r_inner * r_inner) / std::max(1 - a * a, 1e-12f);
    sum += 0.5f * k;
    first -= k * a;
    second += k * a * a;
    // From the third on as if all cosines were the third's: they are where the film is thin, and else near 0.
    rest -= k * a * a * a / (1 + a);
    least += 0.5f * std::max(1 - k * (1 + size) / std::max(1 - size, 1e-6f), 0.0f);
    most += 0.5f * (1 - k * (1 - size) / (1 + size));
  }
};

}  // namespace

const FilmCosines& FilmCosines::get() {
  static const FilmCosines cosines;
  return cosines;
}

FilmCosines::FilmCosines() {
  double whole[3] = {};
  for (double l = kFirst; l <= kLast; ++l)
    for (size_t c = 0; c < 3; ++c) whole[c] += observer(l)[c];
  double xyz[kNodes][3] = {};
  for (double l = kFirst; l <= kLast; ++l) {
    const std::array<double, 3> seen = observer(l);
    // cos(n x) of one step's x, from node to node: cos((n + 1) x) = 2 cos x cos(n x) - cos((n - 1) x).
    const double x = 2 * M_PI * double(kStep) / l, twice = 2 * std::cos(x);
    double cosine = 1, before = std::cos(x);
    for (auto& node : xyz) {
      for (size_t c = 0; c < 3; ++c) node[c] += seen[c] / whole[c] * cosine;
      const double next = twice * cosine - before;
      before = cosine, cosine = next;
    }
  }
  for (int i = 0; i < kNodes; ++i) {
    const auto channel = [&](int c) {
      return float(kToRgb[c][0] * xyz[i][0] + kToRgb[c][1] * xyz[i][1] + kToRgb[c][2] * xyz[i][2]);
    };
    cosines_[i] = {channel(0), channel(1), channel(2)};
  }
}

Rgb FilmCosines::at(float nanometres) const {
  const float place = nanometres * (1 / kStep);
  if (!(place < float(kNodes - 1))) return Rgb(0);  // nothing of them is left
  const auto node = size_t(place);
  const float part = place - float(node);
  return cosines_[node] * (1 - part) + cosines_[node + 1] * part;
}

// Light in the film.
struct ThinFilm::Incidence {
  float cosine, cosine_inside;
  Amplitudes outer;
  Rgb cos1, cos2, cos3;

  Incidence(const ThinFilm& film, float cosine_, float inside)
      : cosine(cosine_), cosine_inside(inside), outer(cosine_, 1, inside, film.ior_) {
    const float way = 2 * film.ior_ * film.thickness_ * inside;
    const FilmCosines& cosines = FilmCosines::get();
    cos1 = cosines.at(way), cos2 = cosines.at(2 * way), cos3 = cosines.at(3 * way);
  }
  Airy on(const ThinFilm& film, float base_ior, float cosine_below) const {
    return {outer, Amplitudes(cosine_inside, film.ior_, cosine_below, base_ior)};
  }
  Rgb reflectance(const Airy& red, const Airy& green, const Airy& blue) const {
    return {red.reflectance(cos1.r, cos2.r, cos3.r), green.reflectance(cos1.g, cos2.g, cos3.g),
            blue.reflectance(cos1.b, cos2.b, cos3.b)};
  }
};

Rgb ThinFilm::reflectance(float cosine, const Rgb& base_f0) const {
  cosine = std::max(cosine, kLeastCosine);
  const float inside = refracted_cosine_squared(cosine, ior_);
  if (!(inside > 0)) return Rgb(1);
  const Incidence light(*this, cosine, std::sqrt(inside));
  const auto on = [&](float f0) {
    const float index = index_of(f0);
    return light.on(*this, index, safe_sqrt(refracted_cosine_squared(cosine, index)));
  };
  const Airy red = on(base_f0.r), green = base_f0.g == base_f0.r ? red : on(base_f0.g),
             blue = base_f0.b == base_f0.r ? red : on(base_f0.b);
  return light.reflectance(red, green, blue);
}

Rgb ThinFilm::reflectance_on(float base_ior, float cosine) const {
  cosine = std::max(cosine, kLeastCosine);
  const float inside = refracted_cosine_squared(cosine, ior_), below = refracted_cosine_squared(cosine, base_ior);
  if (!(inside > 0) || !(below > 0)) return Rgb(1);
  const Incidence light(*this, cosine, std::sqrt(inside));
  const Airy airy = light.on(*this, base_ior, std::sqrt(below));
  return light.reflectance(airy, airy, airy);
}

// The amplitudes add up, as they do at their most.
float ThinFilm::most(float base_f0) const {
  const float base = std::sqrt(std::min(base_f0, kMostF0)), outer = (ior_ - 1) / (ior_ + 1);
  const float inner = std::fabs((base - outer) / (1 - outer * base)), size = std::fabs(outer);
  return sqr((size + inner) / (1 + size * inner));
}

}  // namespace bdpt
