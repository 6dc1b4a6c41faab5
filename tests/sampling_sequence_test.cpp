// Random numbers: stratified where they should be, independent where they should be.
#include "sampling/discrete.h"
#include "sampling/sampler.h"
#include "statistics.h"

#include <gtest/gtest.h>

#include <set>

namespace bdpt::sampling_sequence_test {

using statistics::chi_square_test;
using statistics::kSignificance;

// Every elementary interval of 2^a x 2^b cells, a + b = m, holds one of each 2^m points that follow each other.
TEST(SamplingSobol, FirstTwoDimensionsAreAZeroTwoSequence) {
  for (uint64_t scramble : {0ull, 7ull, 0xffffffffffffffffull})
    for (uint32_t group : {0u, 3u, 57u})
      for (int m : {4, 8}) {
        const uint32_t n = 1u << m;
        for (uint32_t block : {0u, 1u, 5u})
          for (int a = 0; a <= m; ++a) {
            std::vector<int> count(n);
            for (uint32_t i = 0; i < n; ++i) {
              const Four u = sobol4({scramble, block * n + i}, group);
              ++count[(size_t(u[0] * float(1 << a)) << (m - a)) + size_t(u[1] * float(1 << (m - a)))];
            }
            for (int c : count) ASSERT_EQ(c, 1) << "m = " << m << ", a = " << a << ", block " << block;
          }
      }
}

TEST(SamplingSobol, EachOfTheFourDimensionsIsStratified) {
  for (uint32_t group = 0; group < 40; ++group)
    for (int m : {1, 5, 10}) {
      const uint32_t n = 1u << m;
      for (int d = 0; d < 4; ++d) {
        std::vector<int> count(n);
        for (uint32_t i = 0; i < n; ++i) ++count[size_t(sobol4({99, 3 * n + i}, group)[d] * float(n))];
        for (int c : count) ASSERT_EQ(c, 1) << "dimension " << d << ", m = " << m;
      }
    }
}

using Draw = Four (*)(const Stream&, uint32_t);

class SamplingStreams : public ::testing::TestWithParam<Draw> {};

// Pairs of numbers on a grid of 16 x 16 cells.
double uniformity(const std::vector<std::pair<float, float>>& pairs) {
  std::vector<double> observed(256), expected(256, double(pairs.size()) / 256);
  for (const auto& [a, b] : pairs) {
    EXPECT_TRUE(a >= 0 && a < 1 && b >= 0 && b < 1);
    ++observed[size_t(a * 16) * 16 + size_t(b * 16)];
  }
  return chi_square_test(observed, expected);
}

constexpr int kPairs = 20000;

TEST_P(SamplingStreams, AreUniformOverSeeds) {
  for (uint32_t index : {0u, 1u, 12345u})
    for (int d = 0; d < 3; ++d) {
      std::vector<std::pair<float, float>> pairs;
      for (uint64_t i = 0; i < kPairs; ++i) {
        const Four u = GetParam()({hash_values(1, i), index}, 5);
        pairs.emplace_back(u[d], u[d + 1]);
      }
      EXPECT_GT(uniformity(pairs), kSignificance / 50) << index << ' ' << d;
    }
}

TEST_P(SamplingStreams, OfNeighbouringSequencesAreUncorrelated) {
  for (int d = 0; d < 4; ++d) {
    std::vector<std::pair<float, float>> pairs;
    for (uint64_t i = 0; i < kPairs; ++i)
      pairs.emplace_back(GetParam()({hash_values(1, i), 3}, 0)[d], GetParam()({hash_values(1, i + 1), 3}, 0)[d]);
    EXPECT_GT(uniformity(pairs), kSignificance / 50) << d;
  }
}

TEST_P(SamplingStreams, OfDifferentGroupsOfOneSequenceAreUncorrelated) {
  for (uint32_t group : {1u, 2u, 4u, 40u})
    for (int d = 0; d < 4; ++d) {
      std::vector<std::pair<float, float>> same, others;
      for (uint32_t i = 0; i < kPairs; ++i) {
        const Four a = GetParam()({11, i}, 0), b = GetParam()({11, i}, group);
        same.emplace_back(a[d], b[d]);
        others.emplace_back(a[d], b[3 - d]);
      }
      EXPECT_GT(uniformity(same), kSignificance / 50) << group << ' ' << d;
      EXPECT_GT(uniformity(others), kSignificance / 50) << group << ' ' << d;
    }
}

INSTANTIATE_TEST_SUITE_P(Both, SamplingStreams, ::testing::Values(&sobol4, &independent4));

TEST(SamplingIndependent, ConsecutiveNumbersAreUncorrelated) {
  for (int lag : {1, 2, 7})
    for (int d = 0; d < 4; ++d) {
      std::vector<std::pair<float, float>> pairs;
      for (uint32_t i = 0; i < kPairs; ++i)
        pairs.emplace_back(independent4({5, i}, 2)[d], independent4({5, i + uint32_t(lag)}, 2)[3 - d]);
      EXPECT_GT(uniformity(pairs), kSignificance / 20) << lag << ' ' << d;
    }
  std::vector<std::pair<float, float>> within;
  for (uint32_t i = 0; i < kPairs; ++i) {
    const Four u = independent4({6, i}, 2);
    within.emplace_back(u[0], u[3]);
  }
  EXPECT_GT(uniformity(within), kSignificance / 20);
}

TEST(SamplingPermute, IsAPermutationAndReachesEveryPlace) {
  for (uint32_t n : {1u, 2u, 3u, 9u, 16u, 25u, 64u, 1000u})
    for (uint32_t seed = 0; seed < 200; ++seed) {
      std::vector<int> seen(n);
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t p = permute(i, n, seed);
        ASSERT_LT(p, n);
        ASSERT_EQ(seen[p]++, 0) << n << ' ' << seed;
      }
    }
  constexpr uint32_t n = 16;
  std::vector<double> observed(n * n), expected(n * n, 1000.0 / n * 16);
  for (uint32_t seed = 0; seed < 16000; ++seed)
    for (uint32_t i = 0; i < n; ++i) ++observed[i * n + permute(i, n, uint32_t(hash_values(seed)))];
  EXPECT_GT(chi_square_test(observed, expected), kSignificance);
}

TEST(SamplingDiscrete, ChoosesWithItsProbabilitiesAndKeepsTheRestOfTheNumber) {
  const std::vector<double> weights = {0, 3, 1e-3, 0, 1, 2, 0};
  const Discrete d(weights);
  EXPECT_NEAR(d.total(), 6.001, 1e-12);
  double sum = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    sum += d.probability(i);
    EXPECT_NEAR(d.probability(i), weights[i] / 6.001, 1e-7);
  }
  EXPECT_NEAR(sum, 1, 1e-6);
  constexpr int n = 1 << 20;
  std::vector<double> observed(weights.size() * 16), expected;
  for (int i = 0; i < n; ++i) {
    double u = (i + 0.5) / n;
    const size_t chosen = d.sample(u);
    ASSERT_TRUE(u >= 0 && u < 1);
    ++observed[chosen * 16 + size_t(u * 16)];
  }
  for (size_t i = 0; i < weights.size(); ++i)
    for (int k = 0; k < 16; ++k) {
      // Evenly spaced numbers: a cell is off by one or two.
      EXPECT_NEAR(observed[i * 16 + size_t(k)], n * weights[i] / 6.001 / 16, 2) << i << ' ' << k;
    }
  for (double edge : {0.0, 0x1.fffffffffffffp-1}) {
    double u = edge;
    EXPECT_GT(d.probability(d.sample(u)), 0) << edge;
  }
  EXPECT_TRUE(Discrete().empty());
  EXPECT_TRUE(Discrete({0, 0}).empty());
  EXPECT_FLOAT_EQ(Discrete({1e-30, 3e-30}).probability(1), 0.75f);
}

}  // namespace bdpt::sampling_sequence_test
