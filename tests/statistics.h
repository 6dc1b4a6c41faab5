// Tests of hypotheses for code that samples. All take a chance of false alarm: kSignificance, per test. Seeds are
// fixed, so the chance is taken once, when a test or the numbers it draws change, and not with every run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace bdpt::statistics {

// A run has some hundred tests: a false alarm in one of a thousand changes.
inline constexpr double kSignificance = 1e-5;
// Of a normal distribution, the deviation exceeded on either side with that chance.
inline constexpr double kMaxDeviation = 4.42;

// P(X > z) of the normal distribution.
inline double normal_tail(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

// P(X > chi2) with this many degrees of freedom (Wilson and Hilferty 1931; good to a few percent from 5 degrees on).
inline double chi_square_tail(double chi2, double degrees) {
  const double variance = 2 / (9 * degrees);
  return normal_tail((std::cbrt(chi2 / degrees) - (1 - variance)) / std::sqrt(variance));
}

// Pearson's test that counts follow the expected ones: the chance of a worse fit. Bins are pooled, the least expected
// first, until each pool expects at least 5. A count where nothing is expected gives 0. The expected counts must sum
// to what the sum of the observed ones is expected to be; where the latter is fixed, it is one degree of freedom less.
[[gnu::noinline]] inline double chi_square_test(const std::vector<double>& observed,
                                                const std::vector<double>& expected, bool fixed_total = true) {
  std::vector<size_t> order(expected.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return expected[a] < expected[b]; });
  double chi2 = 0, degrees = fixed_total ? -1 : 0, pool_observed = 0, pool_expected = 0;
  for (size_t i : order) {
    if (expected[i] <= 0 && observed[i] > 0) return 0;
    pool_observed += observed[i], pool_expected += expected[i];
    if (pool_expected < 5) continue;
    chi2 += (pool_observed - pool_expected) * (pool_observed - pool_expected) / pool_expected;
    degrees += 1;
    pool_observed = pool_expected = 0;
  }
  return degrees < 1 ? 1 : chi_square_tail(chi2, degrees);
}

// Mean and standard error of a stream of values.
class Estimate {
 public:
  void add(double x) {
    ++count_;
    const double delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (x - mean_);
  }
  int64_t count() const { return count_; }
  double mean() const { return mean_; }
  double variance() const { return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0; }
  double standard_error() const { return std::sqrt(variance() / static_cast<double>(count_)); }

 private:
  int64_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

// Deviation of an estimate from the value it should have, in standard errors. `tolerance` is how far the value itself
// may be off (rounding, quadrature).
inline double deviation(const Estimate& estimate, double value, double tolerance = 0) {
  const double excess = std::max(0.0, std::fabs(estimate.mean() - value) - tolerance);
  return excess == 0 ? 0 : excess / estimate.standard_error();
}

// Deviation of two independent estimates of one value from each other.
inline double deviation(const Estimate& a, const Estimate& b) {
  const double difference = std::fabs(a.mean() - b.mean());
  return difference == 0 ? 0 : difference / std::hypot(a.standard_error(), b.standard_error());
}

// Deviation of a count of successes among trials from their probability.
inline double count_deviation(int64_t successes, int64_t trials, double probability, double tolerance = 0) {
  const double n = static_cast<double>(trials), p = std::clamp(probability, 0.0, 1.0);
  const double excess = std::max(0.0, std::fabs(static_cast<double>(successes) / n - probability) - tolerance);
  return excess == 0 ? 0 : excess / std::sqrt(p * (1 - p) / n);
}

// Uniform numbers in [0,1), the same on every platform.
class Uniform {
 public:
  explicit Uniform(uint32_t seed) : engine_(seed) {}
  float operator()() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }

 private:
  std::mt19937 engine_;
};

}  // namespace bdpt::statistics
