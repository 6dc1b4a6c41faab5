// Thin films against Airy's sum, wavelength by wavelength.
#include "material/thin_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>
#include <iterator>

#include "material/fresnel.h"
#include "statistics.h"

namespace bdpt::material_thin_film_test {

using Complex = std::complex<double>;

// A film of real index on a base of real index, one polarisation after the other.
struct Film {
  double index, nanometres;
  Complex cos_2, r12[2], r23[2];

  Film(double cos_1, double film, double base, double nanometres_) : index(film), nanometres(nanometres_) {
    const Complex sin_1 = std::sqrt(1 - cos_1 * cos_1);
    cos_2 = std::sqrt(1.0 - sin_1 * sin_1 / (film * film));
    const Complex cos_3 = std::sqrt(1.0 - sin_1 * sin_1 / (base * base));
    const auto part = [](Complex a, Complex b) { return (a - b) / (a + b); };
    r12[0] = part(cos_1, film * cos_2), r23[0] = part(film * cos_2, base * cos_3);
    r12[1] = part(film * cos_1, cos_2), r23[1] = part(base * cos_2, film * cos_3);
  }
  // What is reflected of unpolarised light of one wavelength: Born and Wolf, 1.6.4, equation 57.
  double reflectance(double wavelength) const {
    const Complex turn = std::exp(Complex(0, 4 * M_PI * index * nanometres / wavelength) * cos_2);
    double sum = 0;
    for (int i = 0; i < 2; ++i) sum += 0.5 * std::norm((r12[i] + r23[i] * turn) / (1.0 + r12[i] * r23[i] * turn));
    return sum;
  }
  // The largest that reflections from the fourth on can be.
  double rest() const {
    double sum = 0;
    for (int i = 0; i < 2; ++i) {
      const double a = std::abs(r12[i] * r23[i]);
      sum += (1 - std::norm(r12[i])) * (1 - std::norm(r23[i])) / (1 - a * a) * std::pow(a, 4) / (1 - a);
    }
    return sum;
  }
};

// CIE 1931, in steps of 10 nm from 380. Source: CIE 15, table T.4.
constexpr double kObserver[][3] = {
    {0.001368, 0.000039, 0.006450}, {0.004243, 0.000120, 0.020050}, {0.014310, 0.000396, 0.067850},
    {0.043510, 0.001210, 0.207400}, {0.134380, 0.004000, 0.645600}, {0.283900, 0.011600, 1.385600},
    {0.348280, 0.023000, 1.747060}, {0.336200, 0.038000, 1.772110}, {0.290800, 0.060000, 1.669200},
    {0.195360, 0.090980, 1.287640}, {0.095640, 0.139020, 0.812950}, {0.032010, 0.208020, 0.465180},
    {0.004900, 0.323000, 0.272000}, {0.009300, 0.503000, 0.158200}, {0.063270, 0.710000, 0.078250},
    {0.165500, 0.862000, 0.042160}, {0.290400, 0.954000, 0.020300}, {0.433450, 0.994950, 0.008750},
    {0.594500, 0.995000, 0.003900}, {0.762100, 0.952000, 0.002100}, {0.916300, 0.870000, 0.001650},
    {1.026300, 0.757000, 0.001100}, {1.062200, 0.631000, 0.000800}, {1.002600, 0.503000, 0.000340},
    {0.854450, 0.381000, 0.000190}, {0.642400, 0.265000, 0.000050}, {0.447900, 0.175000, 0.000020},
    {0.283500, 0.107000, 0.000000}, {0.164900, 0.061000, 0.000000}, {0.087400, 0.032000, 0.000000},
    {0.046770, 0.017000, 0.000000}, {0.022700, 0.008210, 0.000000}, {0.011359, 0.004102, 0.000000},
    {0.005790, 0.002091, 0.000000}, {0.002899, 0.001047, 0.000000}, {0.001440, 0.000520, 0.000000}};
constexpr double kFirst = 380, kStep = 10;

// XYZ of a spectrum, all wavelengths alike being (1, 1, 1); between the table's nodes linear, in steps of 1 nm.
template <class Spectrum>
std::array<double, 3> xyz_of(const Spectrum& spectrum) {
  std::array<double, 3> sum = {}, whole = {};
  for (size_t i = 0; i + 1 < std::size(kObserver); ++i)
    for (int k = 0; k < 10; ++k) {
      const double wavelength = kFirst + kStep * double(i) + k, value = spectrum(wavelength);
      for (size_t c = 0; c < 3; ++c) {
        const double seen = kObserver[i][c] * (1 - k / 10.0) + kObserver[i + 1][c] * (k / 10.0);
        sum[c] += seen * value;
        whole[c] += seen;
      }
    }
  for (size_t c = 0; c < 3; ++c) sum[c] /= whole[c];
  return sum;
}

// Linear Rec. 709, with equal energy white (Bradford).
std::array<double, 3> rgb_of(const std::array<double, 3>& xyz) {
  constexpr double m[3][3] = {
      {3.1466577, -1.6664638, -0.4801939}, {-0.9955216, 1.9557567, 0.0397649}, {0.0635948, -0.2145632, 1.1509684}};
  std::array<double, 3> rgb = {};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) rgb[i] += m[i][j] * xyz[j];
  return rgb;
}

double f0_of(double index) { return std::pow((index - 1) / (index + 1), 2); }

// Colours that Rec. 709 cannot have are clamped to what the film can reflect of any wavelength.
TEST(ThinFilm, ReflectsAirysSumOverAllWavelengths) {
  double worst[3] = {};  // up to an index of 1.8 and 50 degrees, to 70 degrees, and beyond
  for (const double film : {1.1, 1.3, 1.5, 1.8, 2.4})
    for (const double base : {1.0, 1.33, 1.5, 2.0, 4.0, 19.0})
      for (const double nanometres : {0.0, 50.0, 120.0, 250.0, 400.0, 700.0, 1200.0, 3000.0})
        for (const double degrees : {0.0, 30.0, 50.0, 70.0, 85.0}) {
          const double cosine = std::cos(degrees * M_PI / 180);
          double least = 1, most = 0;
          const Film exact(cosine, film, base, nanometres);
          const auto reflected = [&](double wavelength) {
            const double r = exact.reflectance(wavelength);
            least = std::min(least, r), most = std::max(most, r);
            return r;
          };
          const std::array<double, 3> expected = rgb_of(xyz_of(reflected));
          const ThinFilm thin{float(film), float(nanometres)};
          const Rgb r = thin.reflectance(float(cosine), Rgb(float(f0_of(base)))),
                    refracting = thin.reflectance_on(float(base), float(cosine));
          const float channels[] = {r.r, r.g, r.b};
          // The tables' observer is a fit. From the fourth reflection on all have the third's colour.
          const double tolerance = 0.004 + 0.03 * (most - least) + 2 * exact.rest();
          for (size_t c = 0; c < 3; ++c) {
            const double clamped = std::clamp(expected[c], least, most);
            // Bounds of both polarisations together are wider than what they reach together.
            const double value = double(channels[c]), low = std::min(clamped, expected[c]),
                         high = std::max(clamped, expected[c]);
            const double off = std::max({low - value, value - high, 0.0});
            double& so_far = worst[film > 2 || degrees > 75 ? 2 : degrees > 60 ? 1 : 0];
            so_far = std::max(so_far, off);
            ASSERT_LT(off, tolerance) << film << " on " << base << ", " << nanometres << " nm, at " << degrees
                                      << ", channel " << c << ": " << channels[c] << ", " << expected[c] << " in "
                                      << least << " to " << most;
          }
          EXPECT_NEAR(r.r, refracting.r, 2e-4);
          EXPECT_NEAR(r.g, refracting.g, 2e-4);
          EXPECT_NEAR(r.b, refracting.b, 2e-4);
        }
  EXPECT_LT(worst[0], 0.01);
  EXPECT_LT(worst[1], 0.05);
  RecordProperty("worst_beyond", std::to_string(worst[2]));
}

TEST(ThinFilm, OfNoThicknessIsNoFilm) {
  for (const float film : {1.1f, 1.5f, 2.4f})
    for (const float base : {1.2f, 1.5f, 3.0f})
      for (const float cosine : {1.0f, 0.6f, 0.2f, 0.01f}) {
        const Rgb r = ThinFilm(film, 0).reflectance_on(base, cosine);
        const float bare = fresnel_outside(cosine, base);
        EXPECT_NEAR(r.r, bare, 2e-5) << film << ' ' << base << ' ' << cosine;
        EXPECT_NEAR(r.g, bare, 2e-5);
        EXPECT_NEAR(r.b, bare, 2e-5);
      }
}

TEST(ThinFilm, ReflectsNoMoreThanItsMostAndNoLessThanNothing) {
  statistics::Uniform uniform(3);
  for (int i = 0; i < 200000; ++i) {
    const ThinFilm film(0.5f + 4 * uniform(), 4000 * uniform() * uniform());
    const float f0 = uniform();
    const Rgb normal = film.reflectance(1, Rgb(f0)), r = film.reflectance(uniform(), Rgb(f0, uniform(), 1));
    for (const Rgb& c : {normal, r})
      for (const float v : {c.r, c.g, c.b}) {
        ASSERT_GE(v, 0);
        ASSERT_LE(v, 1 + 1e-6f);
      }
    ASSERT_LE(norm(normal), film.most(f0) + 1e-4f) << f0;
  }
}

TEST(ThinFilm, OfAMetalIsColored) {
  // A quarter of green's wavelength and a half lead to opposite colours.
  const Rgb quarter = ThinFilm(1.8f, 550 / 1.8f / 4).reflectance(1, Rgb(0.5f)),
            half = ThinFilm(1.8f, 550 / 1.8f / 2).reflectance(1, Rgb(0.5f));
  EXPECT_LT(quarter.g, 0.5f * half.g);
  EXPECT_GT(quarter.b, quarter.g);
}

}  // namespace bdpt::material_thin_film_test
