#include "transport/sample_rates.h"

#include "sampling/hash.h"

namespace bdpt {

// The sum over the pixels of sigma^2 / r, sigma^2 relative as in Film::relative_error, is least for as many rays if r
// goes with sigma / sqrt(rays). sigma^2 / rays is halfway, by logarithms, between a region's own and its
// neighbourhood's.
void SampleRates::set(const RegionGrid& grid, const std::vector<RegionMeasure>& eye,
                      const std::vector<RegionMeasure>& all, uint64_t seed) {
  grid_ = grid;
  phase_ = hash_values(seed, 10);
  std::vector<double> pixels(grid.count());
  double sum = 0, count = 0;
  for (size_t i = 0; i < grid.count(); ++i) {
    pixels[i] = grid.pixels(i);
    sum += pixels[i] * all[i].mean;
    count += pixels[i];
  }
  const double least = 0.01 * (sum / count) * (sum / count);
  std::vector<double> gain(grid.count());
  for (size_t i = 0; i < grid.count(); ++i)
    if (eye[i].variance > 0 && eye[i].rays > 0)
      gain[i] = eye[i].variance / ((all[i].mean * all[i].mean + least) * eye[i].rays);
  const std::vector<double> around = grid.smooth(gain);
  for (size_t i = 0; i < grid.count(); ++i) gain[i] = gain[i] > 0 ? std::sqrt(gain[i] * around[i]) : around[i];
  const double most = *std::max_element(gain.begin(), gain.end());  // none at all: all alike
  for (double& g : gain) g = most > 0 ? std::max(g, 1e-12 * most) : 1;

  // The scale for which the mean is one, or nearest to it.
  const auto rates = [&](double scale) {
    double parts = 0;
    parts_.resize(grid.count());
    for (size_t i = 0; i < grid.count(); ++i) {
      parts_[i] =
          uint8_t(std::clamp(std::round(scale * std::sqrt(gain[i])), double(kLeastParts), double(kMost * kParts)));
      parts += pixels[i] * parts_[i];
    }
    return mean_ = parts / kParts / count;
  };
  double low = -100, high = 100;  // powers of two
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (rates(std::exp2(middle)) < 1 ? low : high) = middle;
  }
  const double less = 1 - rates(std::exp2(low)), more = rates(std::exp2(high)) - 1;
  if (less < more) rates(std::exp2(low));
}

}  // namespace bdpt
