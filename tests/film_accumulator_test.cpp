// Sums that are exact: no order, no thread and no merge can change a bit.
#include "film/film.h"
#include "statistics.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <limits>
#include <random>
#include <thread>

namespace bdpt::film_accumulator_test {

Accumulator sum_of(const std::vector<float>& values) {
  Accumulator a;
  for (float v : values) a.add_shared(Accumulator::steps(v));
  return a;
}
bool same(const Accumulator& a, const Accumulator& b) { return a.low == b.low && a.high == b.high; }

std::vector<float> random_values(size_t n) {
  statistics::Uniform uniform(1);
  std::vector<float> values;
  for (size_t i = 0; i < n; ++i)
    values.push_back((uniform() - 0.4f) * std::exp2(90 * uniform() - 50) *
                     (uniform() < 0.02f ? Accumulator::kMaximum * 0x1p-40f : 1));
  return values;
}

TEST(FilmAccumulator, HoldsEveryFloatOfItsRangeExactly) {
  // 24 bits from 2^-24 on are whole steps of 2^-48.
  for (float v = 0x1.abcdep-24f; v <= Accumulator::kMaximum; v *= 1.9f)
    for (float signed_v : {v, -v, std::nextafter(v, 0.0f)})
      EXPECT_EQ(sum_of({signed_v}).value(), double(signed_v)) << v;
  EXPECT_EQ(sum_of({Accumulator::kMaximum}).value(), double(Accumulator::kMaximum));
  EXPECT_EQ(sum_of({-Accumulator::kMaximum}).value(), -double(Accumulator::kMaximum));
}

TEST(FilmAccumulator, RoundsTowardZeroBelowItsSteps) {
  EXPECT_EQ(sum_of({0x1.8p-48f}).value(), 0x1p-48);
  EXPECT_EQ(sum_of({-0x1.8p-48f}).value(), -0x1p-48);
  EXPECT_EQ(sum_of({0x1p-49f}).value(), 0);
  EXPECT_EQ(sum_of({1e-40f}).value(), 0);
}

TEST(FilmAccumulator, ManyOfTheLargestDoNotOverflow) {
  for (float sign : {1.0f, -1.0f}) {
    Accumulator a = sum_of({sign * Accumulator::kMaximum});
    for (int doubling = 1; doubling <= 30; ++doubling) {
      a.add(Accumulator(a));
      ASSERT_EQ(a.value(), std::ldexp(double(sign * Accumulator::kMaximum), doubling)) << doubling;
    }
  }
}

TEST(FilmAccumulator, CancelsExactly) {
  std::vector<float> values = random_values(1000);
  const size_t n = values.size();
  for (size_t i = 0; i < n; ++i) values.push_back(-values[n - 1 - i]);
  EXPECT_TRUE(same(sum_of(values), Accumulator()));
}

TEST(FilmAccumulator, AnyOrderGivesTheSameBits) {
  std::vector<float> values = random_values(5000);
  const Accumulator expected = sum_of(values);
  std::mt19937 engine(5);
  for (int i = 0; i < 10; ++i) {
    std::shuffle(values.begin(), values.end(), engine);
    EXPECT_TRUE(same(sum_of(values), expected));
    // And in two parts.
    Accumulator a = sum_of({values.begin(), values.begin() + 1234});
    a.add(sum_of({values.begin() + 1234, values.end()}));
    EXPECT_TRUE(same(a, expected));
  }
}

TEST(FilmAccumulator, ConcurrentAddsLoseNothing) {
  const std::vector<float> values = random_values(20000);
  Accumulator expected;
  for (int i = 0; i < 4; ++i) expected.add(sum_of(values));
  Accumulator shared;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        for (float v : values) shared.add_shared(Accumulator::steps(v));
      });
  }
  EXPECT_TRUE(same(shared, expected));
}

TEST(FilmAccumulator, FilmRejectsWhatIsTooLargeOrNoNumberAndCountsIt) {
  FilmDesc desc;
  desc.width = desc.height = 2;
  desc.normalize_by_weights = false;
  desc.groups = 1;
  Film film(desc, nullptr);
  const float inf = std::numeric_limits<float>::infinity(), largest = Accumulator::kMaximum;
  for (float bad : {inf, -inf, std::nanf(""), std::nextafter(largest, inf), -std::nextafter(largest, inf), FLT_MAX}) {
    film.add_eye_sample({0.5f, 0.5f}, Rgb(1, bad, 1));
    film.add_light_sample({0.5f, 0.5f}, Rgb(1, 1, bad));
  }
  film.add_eye_sample({1.5f, 0.5f}, Rgb(largest, -largest, 3));
  film.add_light_sample({0.5f, 1.5f}, Rgb(-largest, largest / 3, 3));
  film.end_pass(0, 0, 2);
  film.commit_pass(0);
  EXPECT_EQ(film.rejected(), 12u);
  float pixels[12];
  film.read(FilmLayer::Color, 0, 0, {0, 0, 2, 2}, false, pixels, 6);
  const float expected[12] = {0, 0, 0, largest, -largest, 3, -largest, largest / 3, 3, 0, 0, 0};
  for (int i = 0; i < 12; ++i) EXPECT_EQ(pixels[i], expected[i]) << i;
  film.read(FilmLayer::Rejected, 0, 0, {0, 0, 2, 2}, false, pixels, 6);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(pixels[i], i < 3 ? 12 : 0) << i;
}

// One word holds sums below 2^15: of some groups, of all, or of none; and a film is read in runs of pixels.
TEST(FilmAccumulator, AFilmIsReadOverGroupsHoweverWideTheSums) {
  FilmDesc desc;
  desc.width = 70, desc.height = 1;
  desc.normalize_by_weights = false;
  desc.groups = 3;
  Film film(desc, nullptr);
  const float values[4][5] = {{1, 20000, 1e6f, 20000, 20000},
                              {2, 20000, 2e6f, -1e6f, 20000},
                              {4, 20000, -3e6f, 1e6f, -30000},
                              {8, -20000, 4e6f, 20000, 20000}};
  const auto fill = [&](size_t pass) {
    for (int x = 0; x < desc.width; ++x) film.add_eye_sample({float(x) + 0.5f, 0.5f}, Rgb(values[pass][x % 5]));
  };
  film.begin(FilmRecipe{});
  for (size_t pass = 0; pass < 3; ++pass) {
    fill(pass);
    film.end_pass(pass, 0, 1);
    film.commit_pass(pass);
  }
  film.set_partial(true);
  fill(3);
  for (const bool partial : {false, true}) {
    std::vector<float> pixels(3 * 70);
    film.read(FilmLayer::Color, 0, 0, {0, 0, 70, 1}, partial, pixels.data(), 3 * 70);
    for (size_t i = 0; i < pixels.size(); ++i) {
      double sum = 0;
      for (size_t pass = 0; pass < (partial ? 4 : 3); ++pass) sum += double(values[pass][i / 3 % 5]);
      EXPECT_EQ(pixels[i], float(sum * (1 / (partial ? 4.0 : 3.0)))) << i << ' ' << partial;
    }
  }
}

TEST(FilmAccumulator, RejectedContributionsBelongToTheirPixelAndPass) {
  FilmDesc desc;
  desc.width = 3, desc.height = 2;
  Film film(desc, nullptr), other(desc, nullptr);
  const auto at = [](const Film& f, bool partial) {
    std::vector<float> pixels(18), first;
    f.read(FilmLayer::Rejected, 0, 0, {0, 0, 3, 2}, partial, pixels.data(), 9);
    for (size_t i = 0; i < 18; i += 3) {
      EXPECT_EQ(pixels[i], pixels[i + 1]);
      EXPECT_EQ(pixels[i], pixels[i + 2]);
      first.push_back(pixels[i]);
    }
    return first;
  };
  const auto fill = [](Film& f, uint64_t pass, bool whole) {
    f.begin(FilmRecipe{});
    f.set_partial(true);
    f.reject({2.5f, 1.5f});
    f.add_eye_sample({2.5f, 1.5f}, Rgb(std::nanf("")));
    f.add_light_sample({0.2f, 1.9f}, Rgb(std::nanf("")));
    f.reject({std::nanf(""), 0});  // of no pixel
    f.reject({-0.5f, 0});
    if (!whole) return;
    f.end_pass(pass, 0, 2);
    f.commit_pass(pass);
  };
  fill(film, 0, true);
  EXPECT_EQ(at(film, false), (std::vector<float>{0, 0, 0, 1, 0, 2}));
  fill(film, 1, false);
  EXPECT_EQ(at(film, false), (std::vector<float>{0, 0, 0, 1, 0, 2}));
  EXPECT_EQ(at(film, true), (std::vector<float>{0, 0, 0, 2, 0, 4}));
  film.discard_pass();
  EXPECT_EQ(at(film, true), (std::vector<float>{0, 0, 0, 1, 0, 2}));
  fill(other, 1, true);
  film.merge(other);
  EXPECT_EQ(at(film, false), (std::vector<float>{0, 0, 0, 2, 0, 4}));
  EXPECT_EQ(film.rejected(), 10u);
  float part[3];
  film.read(FilmLayer::Rejected, 0, 0, {2, 1, 3, 2}, false, part, 3);
  EXPECT_EQ(part[0], 4);
  film.clear();
  EXPECT_EQ(at(film, true), std::vector<float>(6));
}

}  // namespace bdpt::film_accumulator_test
