// What the film says of its own error is true.
#include "rendering.h"

namespace bdpt::film_error_test {

using namespace rendering;

struct Setup {
  std::string name;
  SamplerType sampler;
  int groups;
  uint64_t passes;
  bool by_weights;
};
void PrintTo(const Setup& setup, std::ostream* out) { *out << setup.name; }

class FilmError : public ::testing::TestWithParam<Setup> {
 protected:
  static constexpr int kSize = 6;
  std::shared_ptr<Film> picture(uint64_t passes, uint64_t seed) const {
    FilmDesc film = film_desc(kSize, kSize);
    film.groups = GetParam().groups;
    film.normalize_by_weights = GetParam().by_weights;
    RenderDesc desc;
    desc.transport.sampler = GetParam().sampler;
    desc.transport.max_edges = 3;
    desc.seed = seed;
    return render(scene_, camera_, film, desc, passes).film;
  }
  ScenePointer scene_ = scenes::room({}).build();
  SensorPointer camera_ = scenes::camera(scenes::room_view(), kSize, kSize);
};

// Over many seeds the mean of the variance layer is the variance of the picture.
TEST_P(FilmError, VarianceLayerIsTheVarianceOfThePicture) {
  constexpr int seeds = 800;
  std::vector<std::vector<float>> colors(seeds), variances(seeds);
  in_parallel(seeds, [&](size_t i) {
    const auto film = picture(GetParam().passes, 5000 + i);
    colors[i] = read(*film);
    variances[i] = read(*film, FilmLayer::Variance);
  });
  const size_t values = colors[0].size();
  std::vector<double> mean(values);
  for (const auto& c : colors)
    for (size_t k = 0; k < values; ++k) mean[k] += c[k] / double(seeds);
  Estimate excess, variance;
  for (size_t i = 0; i < seeds; ++i) {
    double sum = 0, claimed = 0;
    for (size_t k = 0; k < values; ++k) {
      const double d = colors[i][k] - mean[k];
      sum += d * d * seeds / (seeds - 1) - variances[i][k];
      claimed += variances[i][k];
    }
    excess.add(sum);
    variance.add(claimed);
  }
  // The test sees a factor of 1.5, at the least.
  EXPECT_LT(excess.standard_error() * 4.42, 0.5 * variance.mean());
  expect_value(excess, 0, 5, GetParam().name);
}

TEST_P(FilmError, RelativeErrorShrinksWithTheRootOfThePasses) {
  Estimate few, many;
  const uint64_t passes = 2 * uint64_t(GetParam().groups);
  for (uint64_t seed = 0; seed < 12; ++seed) {
    few.add(picture(passes, 100 + seed)->relative_error());
    many.add(picture(passes * 16, 200 + seed)->relative_error());
  }
  const double ratio = few.mean() / many.mean();
  if (GetParam().sampler == SamplerType::Independent)
    EXPECT_NEAR(ratio, 4, 1) << GetParam().name;
  else
    EXPECT_GT(ratio, 3) << GetParam().name;  // stratified points do better
}

INSTANTIATE_TEST_SUITE_P(All, FilmError,
                         ::testing::Values(Setup{"independent, two groups", SamplerType::Independent, 2, 8, false},
                                           Setup{"independent, uneven groups", SamplerType::Independent, 4, 10, false},
                                           Setup{"independent, by weights", SamplerType::Independent, 4, 8, true},
                                           Setup{"Sobol, two groups", SamplerType::Sobol, 2, 8, false},
                                           Setup{"Sobol, eight groups", SamplerType::Sobol, 8, 16, true}));

TEST(FilmErrorOf, OnePassOrOneGroupIsUnknown) {
  FilmDesc desc = film_desc(2, 2);
  const auto error = [&](int groups, int passes) {
    desc.groups = groups;
    Film film(desc, nullptr);
    for (int i = 0; i < passes; ++i) {
      film.add_eye_sample({0.5f, 0.5f}, Rgb(1));
      film.end_pass(uint64_t(i), 0, 2);
      film.commit_pass(uint64_t(i));
    }
    return film.relative_error();
  };
  EXPECT_EQ(error(2, 0), -1);
  EXPECT_EQ(error(2, 1), -1);
  EXPECT_EQ(error(1, 5), -1);
  EXPECT_EQ(error(2, 2), 0);
}

}  // namespace bdpt::film_error_test
