// Films on disk come back as they were, or not at all.
#include "rendering.h"
#include "temp_folder.h"

#include <fstream>
#include <iterator>
#include <random>

namespace bdpt::film_file_test {

using namespace rendering;

class FilmFile : public ::testing::Test {
 protected:
  static FilmDesc desc() {
    FilmDesc d = film_desc(9, 7, 2);
    d.filter = {FilterType::Gaussian, 1.3f, 0.6f};
    d.normalize_by_weights = true;
    d.groups = 3;
    return d;
  }
  // Passes first, first + 1, ... with random sums.
  static std::shared_ptr<Film> filled(const FilmDesc& d, uint64_t first, uint64_t count, uint64_t seed = 3) {
    auto film = std::make_shared<Film>(d, nullptr);
    film->begin({seed, 11, 12, 63});
    statistics::Uniform uniform(uint32_t(first) + 1);
    for (uint64_t pass = first; pass < first + count; ++pass) {
      for (int i = 0; i < 100; ++i) {
        const FilmPosition at(uniform() * 9, uniform() * 7);
        film->add_eye_sample(at, Rgb(uniform(), uniform() - 0.5f, uniform() * 1e6f));
        film->add_light_sample(at, Rgb(uniform(), uniform(), -uniform()));
        film->add_technique_sample(i % 3, 3 - i % 3, at, Rgb(uniform()));
      }
      film->add_eye_sample({1, 1}, Rgb(std::nanf("")));
      film->end_pass(pass, 0, d.height);
      film->commit_pass(pass);
    }
    return film;
  }
  std::string path() const { return folder_.file("film"); }
  std::string contents() const {
    std::ifstream in(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  void write(const std::string& bytes) const { std::ofstream(path(), std::ios::binary) << bytes; }

  // The code of what loading throws; fails where it does not.
  void expect_refused(const std::string& what) const {
    try {
      Film::load(path(), nullptr);
      ADD_FAILURE() << what << " was read";
    } catch (const Error& e) {
      EXPECT_TRUE(e.code() == ErrorCode::Format || e.code() == ErrorCode::Io) << what << ": " << e.what();
    }
  }

  TempFolder folder_;
};

TEST_F(FilmFile, ComesBackAsItWas) {
  auto film = filled(desc(), 4, 5);
  film->merge(*filled(desc(), 20, 2));
  film->save(path());
  const std::string bytes = contents();
  const std::unique_ptr<Film> back = Film::load(path(), nullptr);
  EXPECT_EQ(back->desc().hash(), film->desc().hash());
  EXPECT_TRUE(back->recipe() == film->recipe());
  EXPECT_TRUE(back->ranges() == film->ranges());
  EXPECT_EQ(back->ranges().size(), 2u);
  EXPECT_EQ(back->rejected(), 7u);
  EXPECT_EQ(back->passes(), 7u);
  for (FilmLayer layer : {FilmLayer::Color, FilmLayer::Eye, FilmLayer::Light, FilmLayer::Variance, FilmLayer::Rejected})
    EXPECT_EQ(read(*back, layer), read(*film, layer));
  EXPECT_EQ(read(*back, FilmLayer::Rejected)[3 * (9 + 1)], 7);
  EXPECT_EQ(read(*back, FilmLayer::Technique, 1, 2), read(*film, FilmLayer::Technique, 1, 2));
  back->save(path());
  EXPECT_TRUE(contents() == bytes);
}

TEST_F(FilmFile, EmptyFilmComesBack) {
  Film(desc(), nullptr).save(path());
  EXPECT_TRUE(Film::load(path(), nullptr)->is_empty());
}

TEST_F(FilmFile, GoesOnAfterLoading) {
  auto whole = filled(desc(), 0, 3);
  whole->merge(*filled(desc(), 3, 3));
  whole->save(path());
  const std::string expected = contents();
  filled(desc(), 0, 3)->save(path());
  const std::unique_ptr<Film> back = Film::load(path(), nullptr);
  back->merge(*filled(desc(), 3, 3));
  back->save(path());
  EXPECT_TRUE(contents() == expected);
}

TEST_F(FilmFile, FlippedBytesAreFound) {
  filled(desc(), 0, 3)->save(path());
  const std::string good = contents();
  std::mt19937 engine(1);
  for (int i = 0; i < 200; ++i) {
    std::string bad = good;
    // Half of them in the header, where they do the most harm.
    const size_t at = engine() % (i % 2 ? good.size() : 140);
    bad[at] = char(bad[at] ^ char(1 + engine() % 255));
    write(bad);
    expect_refused("a flip at " + std::to_string(at));
  }
}

TEST_F(FilmFile, EveryByteOfTheHeaderMatters) {
  filled(desc(), 0, 3)->save(path());
  const std::string good = contents();
  for (size_t at = 0; at < 140; ++at)
    for (unsigned flip : {1u, 0x80u, 0xffu}) {
      std::string bad = good;
      bad[at] = char(bad[at] ^ char(flip));
      write(bad);
      expect_refused("a flip at " + std::to_string(at));
    }
}

TEST_F(FilmFile, TruncationsAndTailsAreFound) {
  filled(desc(), 0, 3)->save(path());
  const std::string good = contents();
  std::mt19937 engine(2);
  for (int i = 0; i < 200; ++i) {
    const size_t size = engine() % (i % 2 ? good.size() : 140);
    write(good.substr(0, size));
    expect_refused("a part of " + std::to_string(size));
  }
  for (size_t tail : {1u, 8u, 1000u}) {
    write(good + std::string(tail, 'x'));
    expect_refused("a tail of " + std::to_string(tail));
  }
  write("");
  expect_refused("an empty file");
  write(std::string(100000, '\0'));
  expect_refused("zeros");
}

TEST_F(FilmFile, OtherFilesAreAnIoError) {
  for (const std::string& name : {folder_.file("none"), folder_.path().string()}) {
    try {
      Film::load(name, nullptr);
      ADD_FAILURE() << name;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::Io) << e.what();
    }
  }
}

ErrorCode code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.code();
  }
  return ErrorCode::Internal;
}

TEST_F(FilmFile, WhatDoesNotFitIsNotMergedAndChangesNothing) {
  auto film = filled(desc(), 0, 3);
  film->save(path());
  const std::string before = contents();
  FilmDesc wider = desc(), filter = desc(), groups = desc(), pyramid = desc(), normalized = desc();
  wider.width = 10;
  filter.filter.a = 0.7f;
  groups.groups = 2;
  pyramid.pyramid_edges = 1;
  normalized.normalize_by_weights = false;
  const std::shared_ptr<Film> misfits[] = {filled(wider, 3, 1),   filled(filter, 3, 1),     filled(groups, 3, 1),
                                           filled(pyramid, 3, 1), filled(normalized, 3, 1), filled(desc(), 3, 1, 4),
                                           filled(desc(), 2, 3),  filled(desc(), 0, 1)};
  for (const auto& other : misfits) EXPECT_EQ(code_of([&] { film->merge(*other); }), ErrorCode::Mismatch);
  EXPECT_EQ(code_of([&] { film->merge(*film); }), ErrorCode::InvalidArgument);
  EXPECT_EQ(code_of([&] { film->begin({3, 12, 12, 63}); }), ErrorCode::Mismatch);
  EXPECT_EQ(code_of([&] { film->begin({3, 11, 13, 63}); }), ErrorCode::Mismatch);
  film->save(path());
  EXPECT_TRUE(contents() == before);
  film->merge(Film(desc(), nullptr));  // an empty film adds nothing
  film->save(path());
  EXPECT_TRUE(contents() == before);
}

TEST_F(FilmFile, ClearedFilmIsAsNew) {
  Film(desc(), nullptr).save(path());
  const std::string fresh = contents();
  auto film = filled(desc(), 0, 3);
  film->clear();
  film->save(path());
  EXPECT_TRUE(contents() == fresh);
}

TEST_F(FilmFile, DiscardedPassLeavesNothing) {
  auto film = filled(desc(), 0, 3);
  film->save(path());
  const std::string before = contents();
  film->set_partial(true);
  film->add_eye_sample({2, 2}, Rgb(5));
  film->add_light_sample({2, 2}, Rgb(5));
  film->add_technique_sample(1, 1, {2, 2}, Rgb(5));
  film->add_eye_sample({2, 2}, Rgb(std::nanf("")));
  film->discard_pass();
  film->end_pass(3, 0, 7);
  film->save(path());
  EXPECT_TRUE(contents() == before);
  EXPECT_EQ(film->rejected(), 3u);
}

}  // namespace bdpt::film_file_test
