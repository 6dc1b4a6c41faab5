// Reconstruction filters: their integrals, where they splat, and that none of them changes what a picture shows.
#include "rendering.h"

namespace bdpt::film_filter_test {

using namespace rendering;

struct Named {
  const char* name;
  FilterDesc desc;
  bool unity;  // shifted by whole pixels its values sum to one
};

const std::vector<Named> kFilters = {{"box", {FilterType::Box}, true},
                                     {"wide box", {FilterType::Box, 1.5f}, true},
                                     {"tent", {FilterType::Tent}, true},
                                     {"tent of two", {FilterType::Tent, 2}, true},
                                     {"Gaussian", {FilterType::Gaussian}, false},
                                     {"wide Gaussian", {FilterType::Gaussian, 4, 1}, false},
                                     {"Mitchell", {FilterType::Mitchell}, true},
                                     {"Catmull-Rom", {FilterType::Mitchell, 2, 0, 0.5f}, true},
                                     {"B-spline", {FilterType::Mitchell, 2, 1, 0}, true},
                                     {"narrow Mitchell", {FilterType::Mitchell, 0.7f}, false},
                                     {"Blackman-Harris", {FilterType::BlackmanHarris}, false},
                                     {"widest", {FilterType::Gaussian, 8, 3}, false}};

TEST(FilmFilter, IntegratesToOne) {
  for (const Named& f : kFilters) {
    const Filter filter(f.desc);
    double sum = 0;
    constexpr int n = 200000;
    for (int i = 0; i < n; ++i) sum += filter(filter.radius() * float((2 * i + 1.0) / n - 1));
    EXPECT_NEAR(sum * 2 * filter.radius() / n, 1, 1e-4) << f.name;
  }
}

TEST(FilmFilter, IsEvenAndEndsAtItsRadius) {
  for (const Named& f : kFilters) {
    const Filter filter(f.desc);
    const float r = filter.radius();
    for (float x = 0.01f; x < r; x += 0.07f) EXPECT_FLOAT_EQ(filter(x), filter(-x)) << f.name;
    EXPECT_EQ(filter(r), 0) << f.name;
    EXPECT_EQ(filter(-1.0001f * r), 0) << f.name;
    EXPECT_EQ(filter(3 * r), 0) << f.name;
    EXPECT_GT(filter(0), 0) << f.name;
  }
}

TEST(FilmFilter, WholeShiftsSumToOne) {
  for (const Named& f : kFilters) {
    if (!f.unity) continue;
    const Filter filter(f.desc);
    for (float x = 0; x < 1; x += 0.03f) {
      double sum = 0;
      for (int i = -10; i <= 10; ++i) sum += filter(x + float(i));
      EXPECT_NEAR(sum, 1, 1e-4) << f.name << ' ' << x;
    }
  }
}

// A sample reaches the pixels whose centres are within the radius, each by the filter's product, and no other.
TEST(FilmFilter, SplatsThePixelsItCovers) {
  for (const Named& f : kFilters) {
    FilmDesc desc = film_desc(20, 18, 1);
    desc.filter = f.desc;
    const Filter filter(f.desc);
    for (const FilmPosition& at :
         {FilmPosition(9.3f, 8.8f), FilmPosition(0.2f, 17.6f), FilmPosition(-0.4f, 3), FilmPosition(20.2f, -0.2f)}) {
      Film film(desc, nullptr);
      const PixelRect bounds = film.sample_bounds();
      if (at.x < float(bounds.x0) || at.x >= float(bounds.x1) || at.y < float(bounds.y0) || at.y >= float(bounds.y1))
        continue;
      film.add_eye_sample(at, Rgb(1, 0, 0));
      film.add_light_sample(at, Rgb(0, 1, -1));
      film.add_technique_sample(1, 1, at, Rgb(0, 1, -1));
      film.end_pass(0, 0, 18);
      film.commit_pass(0);
      const std::vector<float> pixels = read(film), layer = read(film, FilmLayer::Technique, 1, 1);
      for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 20; ++x) {
          const float h = filter(at.x - (float(x) + 0.5f)) * filter(at.y - (float(y) + 0.5f));
          const size_t i = 3 * size_t(y * 20 + x);
          EXPECT_NEAR(pixels[i], h, 1e-6) << f.name << ' ' << x << ' ' << y;
          EXPECT_NEAR(pixels[i + 1], h, 1e-6);
          EXPECT_NEAR(pixels[i + 2], -h, 1e-6);
          EXPECT_EQ(layer[i + 1], pixels[i + 1]);
        }
    }
  }
}

TEST(FilmFilter, SamplesAMarginOfItsRadius) {
  for (const Named& f : kFilters) {
    FilmDesc desc = film_desc(7, 5);
    desc.filter = f.desc;
    const PixelRect bounds = Film(desc, nullptr).sample_bounds();
    const Filter filter(f.desc);
    // All that reaches a border pixel's centre, and no more than a pixel beyond.
    EXPECT_LE(float(bounds.x0), 0.5f - filter.radius() + 1e-6f) << f.name;
    EXPECT_GT(float(bounds.x0) + 1, 0.5f - filter.radius()) << f.name;
    EXPECT_EQ(bounds.y0, bounds.x0);
    EXPECT_EQ(bounds.x1, 7 - bounds.x0);
    EXPECT_EQ(bounds.y1, 5 - bounds.y0);
  }
}

// Normalised by weights a constant picture is constant, bit by bit almost; by samples it is so in the mean.
TEST(FilmFilter, KeepsAConstantPicture) {
  scenes::Builder b;
  b.environment(Rgb(2));
  const ScenePointer scene = b.build();
  const SensorPointer camera = scenes::camera({Vec3(0), Vec3(0, 0, -1), 60}, 16, 16);
  for (const Named& f : kFilters) {
    FilmDesc film = film_desc(16, 16);
    film.filter = f.desc;
    RenderDesc desc;
    desc.transport = options_for();
    film.normalize_by_weights = true;
    const bool negative = f.desc.type == FilterType::Mitchell;  // lobes may nearly cancel what a pixel has
    for (float v : read(*render(scene, camera, film, desc, negative ? 16 : 8).film)) EXPECT_NEAR(v, 2, 1e-4) << f.name;
    film.normalize_by_weights = false;
    Estimate mean;
    for (int seed = 0; seed < 32; ++seed) {
      desc.seed = uint64_t(seed);
      mean.add(mean_of(*render(scene, camera, film, desc, 4).film));
    }
    expect_value(mean, 2, kFilters.size(), f.name, 1e-3);
  }
}

// The eye image and the light image see the same picture through the same filter, to the borders.
TEST(FilmFilter, EyeAndLightImageAgree) {
  const ScenePointer scene = scenes::room({}).build();
  const SensorPointer camera = scenes::camera(scenes::room_view(), 16, 16);
  const Named filters[] = {kFilters[2], kFilters[6], kFilters[11]};
  for (const Named& f : filters) {
    FilmDesc film = film_desc(16, 16);
    film.filter = f.desc;
    const auto measure = [&](const TechniqueMask& mask, uint64_t passes, uint64_t first_seed) {
      return block_means(scene, camera, film, options_for(mask, 3),
                         {.passes = passes, .first_seed = first_seed, .side = 4});
    };
    const BlockMeans eye = measure(mask_of([](int s, int t) { return s <= 1 && t >= 2; }), 8, 1);
    const BlockMeans light = measure(mask_of([](int, int t) { return t == 1; }), 16, 2);
    expect_same(eye, light, std::size(filters), f.name);
  }
}

}  // namespace bdpt::film_filter_test
