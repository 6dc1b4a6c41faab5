// The figures of the experiments: relative variance and its ratios, with their errors.
#include "experiments/estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace experiments_estimate_test {

using namespace bdpt_experiments;
using Images = std::vector<std::vector<float>>;

constexpr std::size_t kAll = 1000;  // past the last image

Images normal_images(std::size_t images, std::size_t pixels, double mean, double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal{float(mean), float(deviation)};
  Images result(images, std::vector<float>(pixels));
  for (auto& image : result)
    for (float& pixel : image) pixel = normal(random);
  return result;
}

TEST(ExperimentEstimate, RelativeVarianceIsThatOfThePixels) {
  const Images images = normal_images(8, 20000, 2, 0.1, 1);
  // 20000 pixels with seven degrees of freedom: the standard error is 0.4 %.
  EXPECT_NEAR(relative_variance(images, kAll, reference_of(images)), 0.01 / 4.04, 0.015 * 0.01 / 4.04);
}

TEST(ExperimentEstimate, LightThatIsSeldomFoundCountsByTheReference) {
  // One in a hundred samples carries all of a mean of one: the variance is 99.
  std::mt19937 random(2);
  std::bernoulli_distribution found(0.01);
  Images rare(6, std::vector<float>(100000));
  for (auto& image : rare)
    for (float& pixel : image) pixel = found(random) ? 100 : 0;
  const auto reference = reference_of(Images(2, std::vector<float>(100000, 1)));
  EXPECT_NEAR(relative_variance(rare, kAll, reference), 99 / 1.01, 3);
  EXPECT_LT(relative_variance(rare, kAll, reference_of(rare)), 10);  // by their own mean most of it is lost
}

TEST(ExperimentEstimate, JackknifeErrorIsTheSpreadOverRuns) {
  constexpr int kRuns = 400, kTurns = 10;
  double sum = 0, squares = 0, errors = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Images a = normal_images(1, kTurns, 5, 1, 10 + unsigned(run));
    const Estimate mean = jackknife(kTurns, [&](std::size_t without) {
      double total = 0;
      for (std::size_t i = 0; i < kTurns; ++i)
        if (i != without) total += a[0][i];
      return total / (kTurns - (without < kTurns ? 1 : 0));
    });
    sum += mean.value, squares += mean.value * mean.value, errors += mean.error;
  }
  const double spread = std::sqrt(squares / kRuns - sum / kRuns * (sum / kRuns));
  EXPECT_NEAR(errors / kRuns, spread, 0.12 * spread);
}

TEST(ExperimentEstimate, TextShowsTheDigitsThatTheErrorLetsStand) {
  EXPECT_EQ(text({12.345, 0.42}), "12.3 ± 0.4");
  EXPECT_EQ(text({0.020590, 0.0005}), "0.0206 ± 0.0005");
  EXPECT_EQ(text({4215.7, 324}), "4216 ± 324");
  EXPECT_EQ(text({9.853, 0}), "9.85");
  EXPECT_EQ(text({NAN, 0}), "–");
}

}  // namespace experiments_estimate_test
