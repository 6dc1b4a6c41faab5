// Films: reading into the host's memory, merging, saving, and all that is refused.
#include "api_scene.h"
#include "temp_folder.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

namespace bdpt_api::api_film_test {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

class ApiFilm : public testing::Test {
 protected:
  World world_;
  bdpt::TempFolder folder_;

  // Passes [first, first + n) into a film of their own.
  Film rendered(uint64_t first, uint64_t n, uint64_t seed = 0) {
    Film film = world_.new_film();
    bdpt_render_desc desc = make<bdpt_render_desc>();
    desc.first_pass = first;
    desc.seed = seed;
    const Render render = world_.render(film.get(), &desc);
    EXPECT_OK(advance(render.get(), n));
    return film;
  }
  std::string saved(const Film& film, const char* name) {
    const std::string path = folder_.file(name);
    EXPECT_OK(bdpt_film_save(film.get(), path.c_str()));
    return path;
  }
  bdpt_result load(const std::string& path) {
    bdpt_film* film = nullptr;
    const bdpt_result result = bdpt_film_load(world_.context.get(), path.c_str(), &film);
    EXPECT_EQ(result == BDPT_OK, film != nullptr);
    bdpt_film_release(film);
    return result;
  }
};

TEST_F(ApiFilm, DescriptionsAreChecked) {
  const auto try_film = [&](const std::function<void(bdpt_film_desc&)>& change) {
    bdpt_film_desc desc = make<bdpt_film_desc>();
    change(desc);
    bdpt_film* film = nullptr;
    const bdpt_result result = bdpt_film_create(world_.sensor.get(), &desc, &film);
    EXPECT_EQ(result == BDPT_OK, film != nullptr);
    bdpt_film_release(film);
    return result;
  };
  const auto refused = [&](const std::function<void(bdpt_film_desc&)>& change) {
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, try_film(change)) << bdpt_last_error();
  };
  for (bdpt_filter filter = 0; filter < 5; ++filter) EXPECT_OK(try_film([&](auto& d) { d.filter = filter; }));
  EXPECT_OK(try_film([](auto& d) { d.groups = 16, d.pyramid_edges = 15; }));
  refused([](auto& d) { d.filter = 5; });
  refused([](auto& d) { d.filter = -1; });
  refused([](auto& d) { d.filter_radius = 0.4f; });
  refused([](auto& d) { d.filter_radius = 9; });
  refused([](auto& d) { d.filter_radius = std::numeric_limits<float>::quiet_NaN(); });
  refused([](auto& d) { d.filter_a = std::numeric_limits<float>::infinity(); });
  refused([](auto& d) { d.filter = BDPT_FILTER_GAUSSIAN, d.filter_a = -1; });
  refused([](auto& d) { d.filter = BDPT_FILTER_MITCHELL, d.filter_b = 100; });
  refused([](auto& d) { d.normalization = 2; });
  refused([](auto& d) { d.groups = 17; });
  refused([](auto& d) { d.pyramid_edges = 16; });
}

TEST_F(ApiFilm, AnEmptyFilmReadsAsZero) {
  for (bdpt_layer layer = BDPT_LAYER_COLOR; layer <= BDPT_LAYER_VARIANCE; ++layer)
    EXPECT_EQ(std::vector<float>(24 * 16 * 3), pixels_of(world_.film.get(), layer));
  const bdpt_film_info info = info_of(world_.film.get());
  EXPECT_EQ(0u, info.passes);
  EXPECT_EQ(0u, info.scene_hash);
  EXPECT_EQ(-1, info.relative_error);
  EXPECT_EQ(2u, info.groups);
  EXPECT_EQ(0.5f, info.filter_radius);
}

TEST_F(ApiFilm, RectanglesStridesAndFlipsReadTheSamePixels) {
  const Film film = rendered(0, 2);
  const std::vector<float> all = pixels_of(film.get());
  constexpr uint32_t x0 = 5, y0 = 3, x1 = 12, y1 = 11;
  constexpr size_t width = (x1 - x0) * 3, rows = y1 - y0;
  for (const size_t stride : {width, width + 1, width + 40})
    for (const uint32_t flip : {0u, 1u}) {
      // Exactly as much as the last pixel needs; what lies between the rows must stay.
      const size_t count = (rows - 1) * stride + width;
      const auto block = std::make_unique<float[]>(count);
      std::fill_n(block.get(), count, -7.0f);
      bdpt_read_desc desc = make<bdpt_read_desc>();
      desc.rect[0] = x0, desc.rect[1] = y0, desc.rect[2] = x1, desc.rect[3] = y1;
      desc.row_stride = stride * sizeof(float);
      desc.flip = flip;
      ASSERT_OK(bdpt_film_read(film.get(), &desc, block.get(), count * sizeof(float)));
      for (size_t row = 0; row < rows; ++row) {
        const size_t from = y0 + (flip ? rows - 1 - row : row);
        for (size_t i = 0; i < width; ++i) ASSERT_EQ(all[(from * 24 + x0) * 3 + i], block[row * stride + i]);
        for (size_t i = width; row + 1 < rows && i < stride; ++i) ASSERT_EQ(-7.0f, block[row * stride + i]);
      }
    }
}

TEST_F(ApiFilm, ReadsThatDoNotFitAreRefused) {
  const Film film = rendered(0, 1);
  std::vector<float> pixels(24 * 16 * 3, -7.0f);
  const uint64_t enough = pixels.size() * sizeof(float);
  const auto refused = [&](const std::function<void(bdpt_read_desc&)>& change, uint64_t capacity) {
    bdpt_read_desc desc = make<bdpt_read_desc>();
    change(desc);
    EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_read(film.get(), &desc, pixels.data(), capacity))
        << bdpt_last_error();
  };
  refused([](auto&) {}, enough - 1);
  refused([](auto&) {}, 0);
  refused([](auto& d) { d.layer = BDPT_LAYER_REJECTED + 1; }, enough);
  refused([](auto& d) { d.layer = BDPT_LAYER_SAMPLES + 1; }, enough);
  refused([](auto& d) { d.layer = -1; }, enough);
  refused([](auto& d) { d.flip = 2; }, enough);
  refused([](auto& d) { d.include_partial = 2; }, enough);
  refused([](auto& d) { d.row_stride = 24 * 12 - 4; }, enough);
  refused([](auto& d) { d.row_stride = 24 * 12 + 2; }, ~uint64_t(0));
  refused([](auto& d) { d.row_stride = 24 * 12 + 4; }, enough);
  refused([](auto& d) { d.row_stride = ~uint64_t(3); }, enough);  // (rows - 1) * stride is beyond 64 bits
  refused([](auto& d) { d.row_stride = uint64_t(1) << 62; }, enough);
  refused([](auto& d) { d.rect[2] = 25, d.rect[3] = 1; }, enough);
  refused([](auto& d) { d.rect[0] = 5, d.rect[2] = 5, d.rect[3] = 1; }, enough);
  refused([](auto& d) { d.rect[0] = ~0u; }, enough);
  refused([](auto& d) { d.layer = BDPT_LAYER_TECHNIQUE, d.s = 1, d.t = 2; }, enough);  // there is no pyramid
  EXPECT_EQ(std::vector<float>(pixels.size(), -7.0f), pixels);
}

TEST_F(ApiFilm, ThePyramidHasItsTechniquesAndNoOthers) {
  bdpt_film_desc desc = make<bdpt_film_desc>();
  desc.pyramid_edges = 3;
  const Film film = make_film(world_.sensor.get(), &desc);
  const Render render = world_.render(film.get());
  ASSERT_OK(advance(render.get(), 2));
  std::vector<float> pixels(24 * 16 * 3);
  for (uint32_t s = 0; s < 6; ++s)
    for (uint32_t t = 0; t < 6; ++t) {
      bdpt_read_desc read = make<bdpt_read_desc>();
      read.layer = BDPT_LAYER_TECHNIQUE, read.s = s, read.t = t;
      const bdpt_result expected = s + t >= 2 && s + t <= 4 ? BDPT_OK : BDPT_ERROR_INVALID_ARGUMENT;
      EXPECT_EQ(expected, bdpt_film_read(film.get(), &read, pixels.data(), pixels.size() * sizeof(float)))
          << s << ',' << t;
    }
  bdpt_read_desc read = make<bdpt_read_desc>();
  read.layer = BDPT_LAYER_TECHNIQUE, read.s = ~0u, read.t = 4;
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT,
            bdpt_film_read(film.get(), &read, pixels.data(), pixels.size() * sizeof(float)));
}

TEST_F(ApiFilm, TheMergeOfRangesIsTheRenderOfAll) {
  const std::string expected = bytes_of(saved(rendered(0, 6), "all"));
  const Film first = rendered(0, 2), second = rendered(2, 3), third = rendered(5, 1);
  const Film merged = world_.new_film();
  EXPECT_OK(bdpt_film_merge(merged.get(), third.get()));
  EXPECT_OK(bdpt_film_merge(merged.get(), first.get()));
  EXPECT_OK(bdpt_film_merge(merged.get(), second.get()));
  EXPECT_EQ(expected, bytes_of(saved(merged, "merged")));
}

TEST_F(ApiFilm, MergesThatDoNotFitChangeNothing) {
  const Film film = rendered(0, 2);
  const std::string before = bytes_of(saved(film, "before"));
  const auto mismatch = [&](const Film& source) {
    EXPECT_EQ(BDPT_ERROR_MISMATCH, bdpt_film_merge(film.get(), source.get())) << bdpt_last_error();
  };
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_merge(film.get(), film.get()));
  mismatch(rendered(1, 1));
  mismatch(rendered(2, 1, 77));
  bdpt_film_desc desc = make<bdpt_film_desc>();
  desc.groups = 3;
  mismatch(make_film(world_.sensor.get(), &desc));
  mismatch(make_film(make_camera(world_.context.get(), camera_desc(10, 10)).get()));
  EXPECT_EQ(before, bytes_of(saved(film, "after")));
}

TEST_F(ApiFilm, AFilmInARenderIsNeitherClearedNorMergedInto) {
  const Film other = rendered(10, 1);
  Render render = world_.render();
  ASSERT_OK(advance(render.get(), 1));
  EXPECT_EQ(BDPT_ERROR_IN_USE, bdpt_film_clear(world_.film.get()));
  EXPECT_EQ(BDPT_ERROR_IN_USE, bdpt_film_merge(world_.film.get(), other.get()));
  bdpt_render* second = nullptr;
  EXPECT_EQ(BDPT_ERROR_IN_USE,
            bdpt_render_create(world_.scene.get(), world_.sensor.get(), world_.film.get(), nullptr, &second));
  EXPECT_EQ(nullptr, second);
  render.reset();
  EXPECT_OK(bdpt_film_merge(world_.film.get(), other.get()));
  EXPECT_OK(bdpt_film_clear(world_.film.get()));
  EXPECT_EQ(0u, info_of(world_.film.get()).passes);
  EXPECT_EQ(std::vector<float>(24 * 16 * 3), pixels_of(world_.film.get()));
}

TEST_F(ApiFilm, ASavedFilmGoesOnWhereItWas) {
  const std::string expected = bytes_of(saved(rendered(0, 5), "all"));
  const std::string half = saved(rendered(0, 2), "half");
  bdpt_film* loaded = nullptr;
  ASSERT_OK(bdpt_film_load(world_.context.get(), half.c_str(), &loaded));
  const Film film(loaded);
  EXPECT_EQ(bytes_of(half), bytes_of(saved(film, "again")));
  const bdpt_film_info info = info_of(film.get());
  EXPECT_EQ(2u, info.passes);
  EXPECT_EQ(2u, info.next_pass);
  EXPECT_NE(0u, info.scene_hash);
  {
    const Render render = world_.render(film.get());
    ASSERT_OK(advance(render.get(), 3));
  }
  EXPECT_EQ(expected, bytes_of(saved(film, "resumed")));
}

TEST_F(ApiFilm, DamagedFilesAreRefused) {
  const std::string good = saved(rendered(0, 1), "good"), bytes = bytes_of(good), bad = folder_.file("bad");
  EXPECT_OK(load(good));
  EXPECT_EQ(BDPT_ERROR_IO, load(folder_.file("none")));
  EXPECT_EQ(BDPT_ERROR_IO, load(folder_.path().string()));
  for (size_t length : {size_t(0), size_t(4), size_t(60), bytes.size() / 2, bytes.size() - 1}) {
    write_bytes(bad, bytes.substr(0, length));
    EXPECT_EQ(BDPT_ERROR_FORMAT, load(bad)) << length << bdpt_last_error();
  }
  write_bytes(bad, bytes + "x");
  EXPECT_EQ(BDPT_ERROR_FORMAT, load(bad));
  for (size_t i = 0; i < bytes.size(); i += i < 128 ? 1 : 997) {
    std::string damaged = bytes;
    damaged[i] = char(damaged[i] ^ 0x40);
    write_bytes(bad, damaged);
    EXPECT_EQ(BDPT_ERROR_FORMAT, load(bad)) << i << ' ' << bdpt_last_error();
  }
}

TEST_F(ApiFilm, AFileThatCannotBeWrittenIsAnErrorAndLeavesNothing) {
  const Film film = rendered(0, 1);
  const size_t before = folder_.count();
  EXPECT_EQ(BDPT_ERROR_IO, bdpt_film_save(film.get(), folder_.file("no/such/folder").c_str()));
  EXPECT_EQ(BDPT_ERROR_IO, bdpt_film_save(film.get(), folder_.path().c_str()));
  EXPECT_EQ(BDPT_ERROR_IO, bdpt_film_save(film.get(), "/proc/film"));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, bdpt_film_save(film.get(), ""));
  EXPECT_EQ(BDPT_ERROR_INVALID_ARGUMENT, load(""));
  EXPECT_EQ(before, folder_.count());
}

}  // namespace bdpt_api::api_film_test
